#include "evolve/search/population_json.h"

#include <nlohmann/json.hpp>

namespace metamorph::evolve {
namespace {

using Json = nlohmann::json;

// The bindings name every field: a new one does not compile before it is thought of here.

Json to_json(const Individual& individual) {
  const auto& [id, parent_a, parent_b, species, origin] = individual;
  return {id, parent_a, parent_b, species, static_cast<int>(origin)};
}

int integer_of(const Json& json) {
  int value = 0;
  read_integer(json, value);
  return value;
}

Individual individual_of(const Json& json) {
  Individual individual;
  auto& [id, parent_a, parent_b, species, origin] = individual;
  read_integer(json.at(0), id);
  read_integer(json.at(1), parent_a);
  read_integer(json.at(2), parent_b);
  read_integer(json.at(3), species);
  origin = static_cast<Origin>(integer_of(json.at(4)));
  return individual;
}

Json to_json(const Species& of) {
  const auto& [id, representative, age, best_ever, stagnant, size] = of;
  return {id, metamorph::evolve::to_json(representative), age, best_ever, stagnant, size};
}

Species species_of(const Json& json) {
  Species result;
  auto& [id, representative, age, best_ever, stagnant, size] = result;
  read_integer(json.at(0), id);
  representative = genome_of(json.at(1));
  read_integer(json.at(2), age);
  json.at(3).get_to(best_ever);
  read_integer(json.at(4), stagnant);
  read_integer(json.at(5), size);
  return result;
}

template <class List>
Json list_of(const List& list) {
  Json json = Json::array();
  for (const auto& element : list) json.push_back(to_json(element));
  return json;
}

template <class T, class Read>
void read_list(const Json& json, std::vector<T>& list, Read read) {
  for (const Json& element : json.get_ref<const Json::array_t&>()) list.push_back(read(element));
}

}  // namespace

Json to_json(const Genome& genome) {
  // Flat lists, a value after the other: a tenth of the objects.
  const auto& [nodes, links] = genome;
  Json::array_t node_list, link_list, stage_list;
  node_list.reserve(2 * nodes.size());
  link_list.reserve(4 * links.size());
  for (const auto& [id, kind] : nodes) {
    node_list.emplace_back(id);
    node_list.emplace_back(static_cast<int>(kind));
  }
  for (const auto& [innovation, from, to, weight, stages] : links) {
    stage_list.emplace_back(stages.first);
    stage_list.emplace_back(stages.last);
    link_list.emplace_back(innovation);
    link_list.emplace_back(from);
    link_list.emplace_back(to);
    link_list.emplace_back(weight);
  }
  Json json = {{"nodes", std::move(node_list)}, {"links", std::move(link_list)}};
  if (is_separated(genome)) json["stages"] = std::move(stage_list);
  return json;
}

Genome genome_of(const Json& json) {
  Genome genome;
  const Json& nodes = json.at("nodes");  // a list that ends too early is JSON's exception
  for (std::size_t i = 0; i < nodes.size(); i += 2) {
    genome.nodes.push_back(
        {integer_of(nodes.at(i)), static_cast<NodeKind>(integer_of(nodes.at(i + 1)))});
  }
  const Json& links = json.at("links");
  for (std::size_t i = 0; i < links.size(); i += 4) {
    genome.links.push_back({integer_of(links.at(i)), integer_of(links.at(i + 1)),
                            integer_of(links.at(i + 2)), links.at(i + 3).get<double>()});
  }
  if (const auto stages = json.find("stages"); stages != json.end()) {
    for (std::size_t i = 0; i < genome.links.size(); ++i) {
      genome.links[i].stages = {integer_of(stages->at(2 * i)), integer_of(stages->at(2 * i + 1))};
    }
  }
  return genome;
}

Json to_json(const PopulationState& population) {
  const auto& [seed, generation, genomes, individuals, species, next_individual, next_species,
               next_innovation, next_node, compatibility_threshold] = population;
  return {{"seed", seed},
          {"generation", generation},
          {"genomes", list_of(genomes)},
          {"individuals", list_of(individuals)},
          {"species", list_of(species)},
          {"next_individual", next_individual},
          {"next_species", next_species},
          {"next_innovation", next_innovation},
          {"next_node", next_node},
          {"compatibility_threshold", compatibility_threshold}};
}

PopulationState population_of(const Json& json) {
  PopulationState population;
  auto& [seed, generation, genomes, individuals, species, next_individual, next_species,
         next_innovation, next_node, compatibility_threshold] = population;
  read_integer(json.at("seed"), seed);
  read_integer(json.at("generation"), generation);
  read_list(json.at("genomes"), genomes, genome_of);
  read_list(json.at("individuals"), individuals, individual_of);
  read_list(json.at("species"), species, species_of);
  read_integer(json.at("next_individual"), next_individual);
  read_integer(json.at("next_species"), next_species);
  read_integer(json.at("next_innovation"), next_innovation);
  read_integer(json.at("next_node"), next_node);
  json.at("compatibility_threshold").get_to(compatibility_threshold);
  return population;
}

}  // namespace metamorph::evolve
