#pragma once

// Developments of many genomes, each renewal's links checked against a full triangulation.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <vector>

#include "core/development/link_check.h"
#include "evolve/files/genome_file.h"
#include "evolve/genetics/innovations.h"
#include "evolve/genetics/mutation.h"
#include "evolve/genetics/seed_genome.h"
#include "metamorph/development.h"

namespace metamorph::evolve::testing {

/// Generates genomes without end.
class Genomes {
 public:
  virtual ~Genomes() = default;
  virtual Genome next() = 0;
};

class RandomGenomes : public Genomes {
 public:
  Genome next() override {
    RandomStream random(Purpose::test, 91, 0, individual_++);
    return seed_genome(NeatSettings{}, random);
  }

 private:
  std::uint32_t individual_ = 0;
};

/// Evolved ones, in turn, each changed by up to eight mutations of all kinds.
class MutatedGenomes : public Genomes {
 public:
  MutatedGenomes() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(METAMORPH_BENCH_GENOMES)) {
      files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    for (const auto& file : files) evolved_.push_back(read_genome(file));
  }

  Genome next() override {
    RandomStream random(Purpose::test, 92, 0, individual_);
    Genome genome = evolved_.at(individual_ % evolved_.size());
    const std::size_t mutations = (individual_ / evolved_.size()) % 9;
    ++individual_;
    int next_innovation = 1 << 20, next_node = 1 << 20;
    Innovations innovations(next_innovation, next_node);
    for (std::size_t m = 0; m < mutations; ++m) {
      StructuralChange change;
      mutate(genome, change, NeatSettings{}, random);
      innovations.apply(change, NeatSettings{}, genome);
    }
    return genome;
  }

 private:
  std::uint32_t individual_ = 0;
  std::vector<Genome> evolved_;
};

/// Develops genomes, checking every renewal, until as many have grown to a body's eight cells.
inline void check_developments(Genomes& genomes, int wanted) {
  const core::DevelopmentRules rules;
  const std::vector<int> stages = {rules.steps / 2, rules.steps};
  core::LinkCheck total;
  int grown = 0, developments = 0;
  while (grown < wanted) {
    std::vector<core::Network> networks;
    for (int i = 0; i < 32; ++i) networks.push_back(compile(genomes.next()));
    const auto checks = core::check_links(networks, rules, stages, 0);
    const auto embryos = core::develop(networks, rules, stages, 0);
    for (std::size_t i = 0; i < networks.size(); ++i, ++developments) {
      ASSERT_TRUE(checks[i].ok()) << "genome " << developments << ": "
                                  << difference_text(checks[i]);
      total.renewals += checks[i].renewals;
      total.links += checks[i].links;
      grown += std::max(embryos[i][0].cell_count(), embryos[i][1].cell_count()) >= 8;
    }
  }
  // Every ten steps of each that lives to one of the stages.
  EXPECT_GE(total.renewals, 61 * wanted);
  EXPECT_GT(total.links, 10 * total.renewals);
  std::cout << developments << " developments (" << grown << " grown), " << total.renewals
            << " renewals, " << total.links << " links\n";
}

}  // namespace metamorph::evolve::testing
