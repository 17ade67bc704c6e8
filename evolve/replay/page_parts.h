#pragma once

#include <string_view>

// The page's own sources, put in by the build (embed.cmake).

namespace metamorph::evolve {

extern const std::string_view page_html;
extern const std::string_view page_css;
extern const std::string_view page_js;

}  // namespace metamorph::evolve
