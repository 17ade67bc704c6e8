#include "metamorph/status.h"

namespace metamorph::core {

std::string_view name(Status status) {
  static constexpr std::array<std::string_view, status_count> names = {
      "ok",           "not_settled",  "empty",           "no_body",        "bad_input",
      "bad_geometry", "bad_topology", "bad_development", "step_too_large", "inverted",
      "crossed",      "collapsed",    "speed",           "non_finite"};
  return names[static_cast<std::size_t>(status)];
}

}  // namespace metamorph::core
