#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "metamorph/body.h"

namespace metamorph::bench {

/// A body to measure on, and where it comes from.
struct Specimen {
  std::string name;
  bool evolved = false;
  core::Body body;
};

/// Bodies grown from genomes: larva (600 steps) and adult (1200) of every genome file, then
/// `random` bodies of random genomes, evenly spread over all sizes that occur.
std::vector<Specimen> grow_specimens(const std::vector<std::filesystem::path>& genomes,
                                     std::size_t random);

}  // namespace metamorph::bench
