#pragma once

#include <string_view>

namespace metamorph::core {

/// One value of an enum, and what files and options call it. The table of an enum stands beside it;
/// the first entry is the default.
template <class Enum>
struct Named {
  Enum value;
  std::string_view name;
};

}  // namespace metamorph::core
