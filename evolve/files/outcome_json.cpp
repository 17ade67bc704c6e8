#include "evolve/files/outcome_json.h"

#include <nlohmann/json.hpp>
#include <type_traits>

#include "metamorph/outcome_fields.h"

namespace metamorph::evolve {

std::string outcome_json(const std::vector<std::pair<std::string, std::string>>& labels,
                         const core::Outcome& outcome) {
  nlohmann::ordered_json object;
  for (const auto& [key, value] : labels) object[key] = value;
  core::for_each_field([&](const auto& field) {
    if (!field.applies(outcome)) return;
    const auto& value = outcome.*field.member;
    const std::string key(field.name);
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, core::Status>) {
      object[key] = core::name(value);
    } else {
      object[key] = value;
    }
  });
  return object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace metamorph::evolve
