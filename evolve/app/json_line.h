#pragma once

#include <string>

namespace metamorph::evolve {

/// JSON on one line; what is no UTF-8 in its strings, as in a record that was damaged, is replaced.
template <class Json>
std::string json_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace metamorph::evolve
