#include "evolve/files/outcome_json.h"

#include <nlohmann/json.hpp>

namespace metamorph::evolve {

std::string outcome_json(const std::vector<std::pair<std::string, std::string>>& labels,
                         const core::Outcome& outcome) {
  nlohmann::ordered_json object;
  for (const auto& [key, value] : labels) object[key] = value;
  object["status"] = core::name(outcome.status);
  object["distance"] = outcome.distance;
  object["mean_position"] = outcome.mean_position;
  object["cells"] = outcome.cells;
  object["springs"] = outcome.springs;
  object["triangles"] = outcome.triangles;
  object["steps"] = outcome.steps;
  object["step"] = outcome.step;
  if (outcome.settle_step > 0) object["settle_step"] = outcome.settle_step;
  object["settle_time"] = outcome.settle_time;
  object["min_area_ratio"] = outcome.min_area_ratio;
  object["max_speed"] = outcome.max_speed;
  object["longest_spring"] = outcome.longest_spring;
  object["long_spring_share"] = outcome.long_spring_share;
  if (core::is_failure(outcome.status)) {
    object["failed_step"] = outcome.failed_step;
    object["failed_index"] = outcome.failed_index;
    object["failed_value"] = outcome.failed_value;
  }
  return object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace metamorph::evolve
