#pragma once

#include <concepts>
#include <nlohmann/json.hpp>

#include "evolve/genetics/population.h"

namespace metamorph::evolve {

/// Every field, exactly; for checkpoints.
nlohmann::json to_json(const Genome& genome);
nlohmann::json to_json(const PopulationState& population);

/// Reads a whole number. JSON itself would take any number for one, beyond every range as well.
/// Throws nlohmann's exceptions if it is none.
template <std::integral Integer>
void read_integer(const nlohmann::json& json, Integer& value) {
  value = static_cast<Integer>(json.get_ref<const nlohmann::json::number_integer_t&>());
}

/// The inverse; throw nlohmann's exceptions if a field is missing or of another type.
Genome genome_of(const nlohmann::json& json);
PopulationState population_of(const nlohmann::json& json);

}  // namespace metamorph::evolve
