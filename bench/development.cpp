// Development and its parts, on one thread: whole developments of evolved genomes, the renewal of
// neighbours against triangulating anew, control networks, cell mechanics, extraction of bodies.

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bench/bodies.h"
#include "bench/measure.h"
#include "core/development/delaunay.h"
#include "core/development/links.h"
#include "core/development/neighbourhood.h"
#include "core/development/triangulation_repair.h"
#include "core/locomotion/body_batch.h"
#include "kernels/cell_mechanics.h"
#include "kernels/network_inference.h"
#include "metamorph/development.h"
#include "metamorph/extraction.h"

namespace metamorph::bench {
namespace {

using core::Embryo;
using core::Index;

double mean_cells(const std::vector<std::vector<Embryo>>& embryos) {
  double cells = 0;
  for (const auto& stages : embryos) cells += stages.back().cell_count();
  return cells / static_cast<double>(embryos.size());
}

std::vector<core::Network> evolved_networks() {
  std::vector<core::Network> networks;
  for (const evolve::Genome& genome : evolved_genomes()) networks.push_back(compile(genome));
  return networks;
}

void develop(benchmark::State& state, const std::vector<int>& stages) {
  const auto networks = evolved_networks();
  std::vector<std::vector<Embryo>> embryos;
  const HardwareCounters counters;
  for (auto _ : state) embryos = core::develop(networks, core::DevelopmentRules{}, stages, 1);
  report(state, counters, static_cast<double>(networks.size()), "development");
  state.counters["cells"] = mean_cells(embryos);
}

/// The positions of one development at every renewal, and who was who in the one before.
struct Renewal {
  std::vector<double> x, y;
  std::vector<Index> previous;
  std::vector<std::array<Index, 2>> links;
};

std::vector<std::vector<Renewal>> renewals() {
  const core::DevelopmentRules rules;
  std::vector<int> stages;
  for (int step = 0; step <= rules.steps; step += rules.renew_interval) stages.push_back(step);
  std::vector<std::vector<Renewal>> result;
  for (const auto& embryos : core::develop(evolved_networks(), rules, stages, 1)) {
    std::vector<Renewal>& course = result.emplace_back();
    std::map<int, Index> place;  // of a cell's id, in the embryo before
    for (const Embryo& embryo : embryos) {
      Renewal& renewal = course.emplace_back(Renewal{embryo.x, embryo.y, {}, embryo.links});
      std::map<int, Index> now;
      for (Index i = 0; i < embryo.cell_count(); ++i) {
        const int id = embryo.id[static_cast<std::size_t>(i)];
        const auto before = place.find(id);
        renewal.previous.push_back(before == place.end() ? -1 : before->second);
        now[id] = i;
      }
      place = std::move(now);
    }
  }
  return result;
}

double count(const std::vector<std::vector<Renewal>>& courses) {
  double sum = 0;
  for (const auto& course : courses) sum += static_cast<double>(course.size());
  return sum;
}

/// Edges, listed in order, by repairing the triangulation before.
void repair(benchmark::State& state) {
  const auto courses = renewals();
  core::TriangulationRepair triangulation;
  const HardwareCounters counters;
  for (auto _ : state) {
    for (const auto& course : courses) {
      triangulation.clear();
      for (const Renewal& renewal : course) {
        triangulation.update(renewal.x, renewal.y, renewal.previous);
        benchmark::DoNotOptimize(triangulation.edges());
      }
    }
  }
  report(state, counters, count(courses), "renewal");
  state.counters["anew"] = static_cast<double>(triangulation.rebuilds()) /
                           static_cast<double>(state.iterations()) / count(courses);
}

/// Edges by CGAL, from nothing.
void triangulate(benchmark::State& state) {
  const auto courses = renewals();
  core::Triangulation triangulation;
  const HardwareCounters counters;
  for (auto _ : state) {
    for (const auto& course : courses) {
      for (const Renewal& renewal : course) {
        core::triangulate(renewal.x, renewal.y, triangulation);
      }
    }
  }
  report(state, counters, count(courses), "renewal");
}

/// Everything that development does to renew its neighbours; the links must be those of a full
/// triangulation every time.
void renew(benchmark::State& state) {
  const auto courses = renewals();
  const double limit = core::DevelopmentRules{}.link_limit;
  core::Neighbourhood neighbourhood(sizeof(kernels::NodeRecord<float>));
  const HardwareCounters counters;
  for (auto _ : state) {
    for (const auto& course : courses) {
      neighbourhood.clear();
      for (const Renewal& renewal : course) {
        neighbourhood.renew(renewal.x, renewal.y, renewal.previous, limit);
      }
    }
  }
  report(state, counters, count(courses), "renewal");

  core::Triangulation triangulation;
  core::LinkSelection selection;
  std::vector<std::array<Index, 2>> links;
  for (const auto& course : courses) {
    neighbourhood.clear();
    for (const Renewal& renewal : course) {
      neighbourhood.renew(renewal.x, renewal.y, renewal.previous, limit);
      core::triangulate(renewal.x, renewal.y, triangulation);
      selection.select(renewal.x, renewal.y, limit, triangulation.edges, links);
      if (neighbourhood.links() != links) state.SkipWithError("other links than CGAL's");
    }
  }
}

/// Links from a new triangulation every time.
void renew_anew(benchmark::State& state) {
  const auto courses = renewals();
  const double limit = core::DevelopmentRules{}.link_limit;
  core::Triangulation triangulation;
  core::LinkSelection selection;
  std::vector<std::array<Index, 2>> links;
  const HardwareCounters counters;
  for (auto _ : state) {
    for (const auto& course : courses) {
      for (const Renewal& renewal : course) {
        core::triangulate(renewal.x, renewal.y, triangulation);
        selection.select(renewal.x, renewal.y, limit, triangulation.edges, links);
      }
    }
  }
  report(state, counters, count(courses), "renewal");
}

template <class T>
void infer(benchmark::State& state) {
  const auto networks = evolved_networks();
  const int cells = static_cast<int>(state.range(0));
  std::vector<std::vector<T>> values;
  double links = 0;
  for (const core::Network& network : networks) {
    const int slots = network.inputs + network.node_count();
    values.emplace_back(static_cast<std::size_t>(kernels::network_value_size(slots, cells)),
                        T(0.3));
    links += static_cast<double>(network.source.size());
  }
  const HardwareCounters counters;
  for (auto _ : state) {
    for (std::size_t i = 0; i < networks.size(); ++i) {
      const core::Network& network = networks[i];
      kernels::infer_network<T>({network.inputs, network.node_count(), network.first_link.data(),
                                 network.source.data(), network.weight.data()},
                                cells, values[i].data());
    }
    benchmark::ClobberMemory();
  }
  report(state, counters, static_cast<double>(networks.size()) * cells, "network-cell");
  report_flop(state, 2 * links * cells);
  state.counters["links"] = links / static_cast<double>(networks.size());
}

template <class T>
void mechanics(benchmark::State& state) {
  const core::DevelopmentRules rules;
  const int stages[] = {rules.steps};
  const Embryo embryo = core::develop(evolved_networks(), rules, stages, 1).back().back();
  core::Neighbourhood neighbourhood(sizeof(kernels::NodeRecord<T>));
  neighbourhood.renew(embryo.x, embryo.y,
                      std::vector<Index>(static_cast<std::size_t>(embryo.cell_count()), -1),
                      rules.link_limit);
  const std::size_t padded =
      static_cast<std::size_t>(neighbourhood.rings().groups) * kernels::cell_lanes;
  core::Aligned<kernels::NodeRecord<T>> cells(padded), next(padded);
  for (std::size_t i = 0; i < embryo.x.size(); ++i) {
    cells[i] = {static_cast<T>(embryo.x[i]), static_cast<T>(embryo.y[i]), T(0), T(0)};
  }
  const kernels::CellMechanics<T> coefficients = {
      static_cast<T>(rules.step), static_cast<T>(rules.stiffness), static_cast<T>(rules.damping),
      static_cast<T>(rules.drag)};
  constexpr int steps = 100;
  const HardwareCounters counters;
  for (auto _ : state) {
    for (int n = 0; n < steps; ++n) {
      kernels::step_cells(coefficients, neighbourhood.rings(), cells.data(), next.data());
      cells.swap(next);
    }
    benchmark::ClobberMemory();
  }
  report(state, counters, steps * static_cast<double>(neighbourhood.links().size()), "link-step");
  state.counters["cells"] = embryo.cell_count();
}

void extract(benchmark::State& state, int stage) {
  const int stages[] = {stage};
  const auto embryos = core::develop(evolved_networks(), core::DevelopmentRules{}, stages, 1);
  const HardwareCounters counters;
  for (auto _ : state) {
    for (const auto& embryo : embryos) {
      benchmark::DoNotOptimize(core::extract_body(embryo.front()));
    }
  }
  report(state, counters, static_cast<double>(embryos.size()), "body");
  state.counters["cells"] = mean_cells(embryos);
}

BENCHMARK_CAPTURE(develop, whole, {1200})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(develop, larva_and_adult, {600, 1200})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(develop, larva, {600})->Unit(benchmark::kMillisecond);
BENCHMARK(repair)->Unit(benchmark::kMillisecond);
BENCHMARK(triangulate)->Unit(benchmark::kMillisecond);
BENCHMARK(renew)->Unit(benchmark::kMillisecond);
BENCHMARK(renew_anew)->Unit(benchmark::kMillisecond);
BENCHMARK(infer<float>)->Arg(64)->Arg(256)->Unit(benchmark::kMicrosecond);
BENCHMARK(infer<double>)->Arg(256)->Unit(benchmark::kMicrosecond);
BENCHMARK(mechanics<float>)->Unit(benchmark::kMicrosecond);
BENCHMARK(mechanics<double>)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(extract, larva, 600)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(extract, adult, 1200)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace metamorph::bench

BENCHMARK_MAIN();
