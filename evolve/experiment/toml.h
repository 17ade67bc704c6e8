#pragma once

// toml++ with its assertions out. Some of them do not hold for texts that are no TOML
// ("[[trials]]["), of which the lines after them tell well: they would end the program in a build
// with assertions, and let a compiler believe them in one without.

#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
