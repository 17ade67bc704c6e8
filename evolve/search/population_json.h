#pragma once

#include <nlohmann/json_fwd.hpp>

#include "evolve/genetics/population.h"

namespace metamorph::evolve {

/// Every field, exactly; for checkpoints.
nlohmann::json to_json(const Genome& genome);
nlohmann::json to_json(const PopulationState& population);

/// The inverse; throw nlohmann's exceptions if a field is missing or of another type.
Genome genome_of(const nlohmann::json& json);
PopulationState population_of(const nlohmann::json& json);

}  // namespace metamorph::evolve
