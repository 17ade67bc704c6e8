#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "evolve/genetics/genome.h"
#include "evolve/genetics/population.h"
#include "metamorph/body.h"
#include "metamorph/development.h"
#include "metamorph/extraction.h"
#include "metamorph/locomotion.h"
#include "metamorph/random.h"
#include "metamorph/scene.h"
#include "metamorph/status.h"
#include "tests/tolerance.h"

// Can evolution earn distance from numerical error? Searches that select for nothing else: bodies
// grown from genomes and bred as in a run, scored by what the defaults (their step, float) give
// them and a quarter of the step in double precision does not.
//
// Such a search finds bodies that stand on a knife's edge: one contact more or less, of a body with
// the ground or with itself, decides between two gaits, and the error of a step tips the scale as
// would any other nudge. That is luck, not income: it goes either way. What would be income is
// distance that the error of the step gives to a body wherever it is nudged to. So the best earners
// are measured again from starts that no body could tell apart.

namespace metamorph::tests {
namespace {

constexpr double nudge = 0.05;  ///< d

core::Body nudged(core::Body body, std::uint32_t start) {
  evolve::RandomStream random(evolve::Purpose::test, 11, 0, start);
  for (auto* coordinates : {&body.x, &body.y})
    for (double& value : *coordinates) value += nudge * (2 * random.uniform() - 1);
  return body;
}

/// What the defaults say of a body, and what of that a quarter of the step denies: means over
/// starts, those left out that fail at either step.
struct Claim {
  double distance = 0;  ///< at the default step, in float
  double earned = 0;    ///< of it, not there at a quarter of the step, in double
  double error = 0;     ///< standard error of `earned`
  int starts = 0;
  int unconfirmed = 0;  ///< starts that failed at the quarter step only
};

Claim claim_of(const core::Outcome* coarse, const core::Outcome* fine, std::size_t starts) {
  Claim claim;
  std::vector<double> difference;
  for (std::size_t i = 0; i < starts; ++i) {
    if (core::is_failure(coarse[i].status)) continue;
    if (core::is_failure(fine[i].status)) {
      ++claim.unconfirmed;
      continue;
    }
    claim.distance += coarse[i].distance;
    difference.push_back(coarse[i].distance - fine[i].distance);
  }
  const double n = static_cast<double>(difference.size());
  if (n == 0) return claim;
  claim.starts = static_cast<int>(n);
  claim.distance /= n;
  for (const double d : difference) claim.earned += d / n;
  for (const double d : difference) claim.error += (d - claim.earned) * (d - claim.earned);
  claim.error = n > 1 ? std::sqrt(claim.error / (n - 1) / n) : 0;
  return claim;
}

/// Claims of all bodies, in one batch. Start 0 is the body itself.
std::vector<Claim> claims(const std::vector<core::Body>& bodies, const core::Scene& scene,
                          std::uint32_t first_start, std::uint32_t starts) {
  std::vector<core::Body> started;
  for (const core::Body& body : bodies)
    for (std::uint32_t s = first_start; s < first_start + starts; ++s)
      started.push_back(s == 0 ? body : nudged(body, s));
  core::Scene quarter = scene;
  quarter.step /= 4;
  quarter.settle_step /= 4;
  std::vector<core::LocomotionTask> coarse_tasks, fine_tasks;
  for (const core::Body& body : started) {
    coarse_tasks.push_back({&body, &scene});
    fine_tasks.push_back({&body, &quarter});
  }
  const auto coarse = core::simulate(coarse_tasks, {});
  const auto fine = core::simulate(fine_tasks, {.precision = core::Precision::float64});
  std::vector<Claim> result;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    result.push_back(claim_of(&coarse[b * starts], &fine[b * starts], starts));
  return result;
}

struct Hunt {
  std::string name;
  core::Scene scene;
  std::uint32_t starts = 1;  ///< that a body is scored by
  int population = 40;
  int generations = 20;
};

std::ostream& operator<<(std::ostream& out, const Hunt& hunt) { return out << hunt.name; }

struct Catch {
  core::Body body;
  Claim claim;
};

std::string told(const core::Body& body, const Claim& claim) {
  return std::to_string(body.node_count()) + " cells, " + std::to_string(claim.distance) +
         " d, unfounded " + std::to_string(claim.earned) + " +- " + std::to_string(claim.error) +
         " of " + std::to_string(claim.starts) + " starts, unconfirmed " +
         std::to_string(claim.unconfirmed) + "\n";
}

/// All bodies that the hunt came across, each once, the highest earner first.
std::vector<Catch> caught(const Hunt& hunt, std::uint64_t seed) {
  evolve::NeatSettings settings;
  settings.population = hunt.population;
  evolve::PopulationState state = evolve::first_generation(settings, seed);
  core::DevelopmentRules rules;
  rules.steps = 600;
  const std::vector<int> stages = {rules.steps};
  std::vector<Catch> all;
  for (int generation = 0; generation < hunt.generations; ++generation) {
    std::vector<core::Network> networks;
    for (const evolve::Genome& genome : state.genomes) networks.push_back(compile(genome));
    std::vector<core::Body> bodies;
    std::vector<std::size_t> owner;
    const auto embryos = core::develop(networks, rules, stages, 0);
    for (std::size_t i = 0; i < embryos.size(); ++i) {
      core::Extraction extraction = core::extract_body(embryos[i].front());
      if (extraction.status != core::Status::ok) continue;
      bodies.push_back(std::move(extraction.body));
      owner.push_back(i);
    }
    const std::vector<Claim> found = claims(bodies, hunt.scene, 0, hunt.starts);
    std::vector<double> fitness(state.genomes.size());
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      fitness[owner[b]] = std::max(found[b].earned, 0.0);
      all.push_back({std::move(bodies[b]), found[b]});
    }
    evolve::next_generation(state, settings, fitness, false, 0);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Catch& a, const Catch& b) { return a.claim.earned > b.claim.earned; });
  const auto same = [](const Catch& a, const Catch& b) {
    return a.claim.earned == b.claim.earned && a.claim.distance == b.claim.distance;
  };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

/// The share of the way of the best earners that is unfounded wherever they start.
struct Income {
  double share = 0, error = 0;
  std::string told;
};

Income income(const Hunt& hunt) {
  double earned = 0, variance = 0, way = 0;
  Income result;
  for (const std::uint64_t seed : {1, 2}) {
    std::vector<Catch> best = caught(hunt, seed);
    best.resize(std::min<std::size_t>(best.size(), 6));
    std::vector<core::Body> bodies;
    for (const Catch& one : best) bodies.push_back(one.body);
    const std::vector<Claim> again = claims(bodies, hunt.scene, 100, 24);
    for (std::size_t i = 0; i < best.size(); ++i) {
      result.told +=
          "found " + told(bodies[i], best[i].claim) + "again " + told(bodies[i], again[i]);
      earned += again[i].earned;
      variance += again[i].error * again[i].error;
      way += again[i].distance;
    }
  }
  result.share = earned / way;
  result.error = std::sqrt(variance) / way;
  return result;
}

class EarnedDistance : public testing::TestWithParam<std::pair<Hunt, double>> {};

core::Scene without_self_collision(core::Scene scene) {
  scene.self_collision = false;
  return scene;
}

/// How much may be systematic. In water the error of the phase, (w h)^2/24 with w^2 = 10 k/m of the
/// fastest mode at h = 0.2: 1.7 %. On land contact and friction switch within steps, and
/// a twentieth is allowed. (A defect of first order, dampers that took what friction holds for
/// moving, gave these two hunts 12 % +- 2 % on land; its own test is in
/// tests/kernels/reference_ground_test.cpp.)
INSTANTIATE_TEST_SUITE_P(
    Hunts, EarnedDistance,
    testing::Values(std::pair{Hunt{"Water", core::water_scene()}, 0.017},
                    std::pair{Hunt{"WaterWithoutSelfCollision",
                                   without_self_collision(core::water_scene())},
                              0.017},
                    std::pair{Hunt{"Land", core::land_scene(), 3, 24, 8}, 0.05}),
    [](const auto& param) { return param.param.first.name; });

TEST_P(EarnedDistance, IsNotToBeHadFromNumericalError) {
  const auto& [hunt, systematic] = GetParam();
  const Income found = income(hunt);
  RecordProperty("share", std::to_string(found.share) + " +- " + std::to_string(found.error));
  // Errors that cost distance are no income.
  EXPECT_TRUE(within(std::max(found.share, 0.0), systematic + 3 * found.error))
      << "share " << found.share << " +- " << found.error << "\n"
      << found.told;
}

}  // namespace
}  // namespace metamorph::tests
