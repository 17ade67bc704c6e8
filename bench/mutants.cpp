// What mutations make of an evolved genome: of so many children by each kind, how many are better
// than it, how many dead, and how good the best are.
//
//   build/release/bench/mutants EXPERIMENT.toml GENOME.json CHILDREN [KEY=VALUE ...]
//
// The genome is what `metamorph export RUN --champion best` writes; keys as `--set` has them:
// several starts per trial keep luck out. All are evaluated as if in generation 0.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "evolve/experiment/experiment_file.h"
#include "evolve/files/genome_file.h"
#include "metamorph/evaluator.h"
#include "metamorph/variation.h"

namespace {

using namespace metamorph::evolve;

struct Kind {
  const char* name;
  NeatSettings settings;
};

std::vector<Kind> kinds(const NeatSettings& base) {
  NeatSettings none = base;
  none.mutate_weights = none.add_link = none.add_node = none.remove_link = 0;
  std::vector<Kind> result;
  const auto add = [&](const char* name, auto change) {
    result.push_back({name, none});
    change(result.back().settings);
  };
  const auto weights = [](double least, double change) {
    return [=](NeatSettings& s) {
      s.mutate_weights = 1;
      s.severe = 0;
      s.moved_share = least;
      s.weight_change = change;
    };
  };
  add("weights, all links", weights(1, 1));
  add("weights, all links, a twentieth as far", weights(1, 0.05));
  add("weights, log share", weights(0, 1));
  add("weights, log share, a quarter as far", weights(0, 0.25));
  add("weights, log share, a twentieth as far", weights(0, 0.05));
  add("redraw, all links",
      [](NeatSettings& s) { s.mutate_weights = s.severe = s.redrawn_share = 1; });
  add("redraw, log share", [](NeatSettings& s) {
    s.mutate_weights = s.severe = 1;
    s.redrawn_share = 0;
  });
  add("add link", [](NeatSettings& s) { s.add_link = 1; });
  add("add node, weight 1", [](NeatSettings& s) { s.add_node = s.node_weight = 1; });
  add("add node, weight 2", [](NeatSettings& s) {
    s.add_node = 1;
    s.node_weight = 2;
  });
  add("remove link", [](NeatSettings& s) { s.remove_link = 1; });
  return result;
}

std::vector<Evaluated> evaluate(Evaluator& evaluator, const std::vector<Genome>& genomes) {
  std::vector<metamorph::core::Network> networks;
  const ControlShape shape = shape_of(evaluator.rules().development);
  for (const Genome& genome : genomes) networks.push_back(compile(genome, shape));
  const std::vector<std::uint8_t> all(evaluator.rules().trials.size(), 1);
  return evaluator.evaluate(networks, all, 0);
}

double merit(const Evaluated& one) { return geometric_mean(evaluation_of(one)); }

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

int run(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: {} EXPERIMENT.toml GENOME.json CHILDREN [KEY=VALUE ...]\n", argv[0]);
    return 2;
  }
  std::vector<Override> overrides;
  for (int i = 4; i < argc; ++i) overrides.push_back(parse_override(argv[i]));
  const Experiment experiment = read_experiment(argv[1], overrides);
  const Genome genome = read_genome(argv[2], experiment.development);
  const int children = std::atoi(argv[3]);
  Evaluator evaluator(rules_of(experiment));
  const Evaluated original = evaluate(evaluator, {genome}).front();
  const double own = merit(original);
  fmt::print("eq 6 of the genome: {:.2f} d, {} links; {} children of each kind\n\n", own,
             genome.links.size(), children);
  fmt::print("| kind | better | by a tenth | dead | median | best |");
  for (const Trial& trial : experiment.trials) {
    fmt::print(" {0}: same cells | {0}: median share of the distance |", trial.name);
  }
  fmt::print("\n|---|---|---|---|---|---|");
  for (std::size_t t = 0; t < experiment.trials.size(); ++t) fmt::print("---|---|");
  fmt::print("\n");
  std::uint32_t number = 0;
  for (const Kind& kind : kinds(experiment.neat)) {
    std::vector<Genome> mutants(static_cast<std::size_t>(children), genome);
    for (Genome& mutant : mutants) {
      RandomStream stream(Purpose::mutation, experiment.seed, 0, number++);
      StructuralChange change;
      mutate(mutant, change, kind.settings, stream);
      int next_innovation = genome.links.back().innovation + 1;
      int next_node = std::max(genome.nodes.back().id + 1, first_hidden);
      Innovations(next_innovation, next_node).apply(change, kind.settings, mutant);
    }
    const std::vector<Evaluated> evaluated = evaluate(evaluator, mutants);
    std::vector<double> all;
    for (const Evaluated& one : evaluated) all.push_back(merit(one));
    std::sort(all.begin(), all.end());
    const auto share = [&](auto is) {
      return 100.0 * static_cast<double>(std::count_if(all.begin(), all.end(), is)) /
             static_cast<double>(all.size());
    };
    fmt::print("| {} | {:.1f} % | {:.1f} % | {:.1f} % | {:.1f} | {:.1f} |", kind.name,
               share([&](double m) { return m > own; }),
               share([&](double m) { return m > 1.1 * own; }),
               share([](double m) { return m == 0; }), all[all.size() / 2], all.back());
    for (std::size_t t = 0; t < experiment.trials.size(); ++t) {
      int same = 0;
      std::vector<double> shares;
      for (const Evaluated& one : evaluated) {
        same += one.stages[t].cells == original.stages[t].cells ? 1 : 0;
        shares.push_back(one.trials[t].distance / original.trials[t].distance);
      }
      fmt::print(" {:.0f} % | {:.2f} |", 100.0 * same / children, median(shares));
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
