#include "bench/bodies.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "evolve/files/genome_file.h"
#include "metamorph/extraction.h"

namespace metamorph::bench {
namespace {

/// A lattice point u (1, 0) + v (1/2, sqrt(3)/2).
using Point = std::pair<int, int>;

int square(Point p) { return p.first * p.first + p.first * p.second + p.second * p.second; }

}  // namespace

core::Body lattice_disc(int cells) {
  std::vector<Point> points;
  constexpr int reach = 24;
  for (int u = -reach; u <= reach; ++u) {
    for (int v = -reach; v <= reach; ++v) points.emplace_back(u, v);
  }
  std::sort(points.begin(), points.end(), [](Point a, Point b) {
    return square(a) != square(b) ? square(a) < square(b) : a < b;
  });
  points.resize(static_cast<std::size_t>(cells));

  core::Body body;
  std::map<Point, core::Index> node;
  for (const auto& [u, v] : points) {
    node[{u, v}] = body.node_count();
    body.x.push_back(u + 0.5 * v);
    body.y.push_back(0.5 * std::numbers::sqrt3 * v);
    body.period.push_back(40);
    body.phase.push_back(
        std::remainder(0.9 * body.x.back() + 0.4 * body.y.back(), 2 * std::numbers::pi));
  }
  const auto add = [&](core::Index a, Point p, Point q) {
    const auto b = node.find(p), c = node.find(q);
    if (b != node.end() && c != node.end()) body.triangles.push_back({a, b->second, c->second});
  };
  for (const auto& [p, a] : node) {
    const auto [u, v] = p;
    add(a, {u + 1, v}, {u, v + 1});
    add(a, {u, v + 1}, {u - 1, v + 1});
  }
  set_rest_from_nodes(body);
  if (!check(body).empty()) throw std::logic_error("no lattice disc of " + std::to_string(cells));
  return body;
}

std::vector<evolve::Genome> evolved_genomes() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(METAMORPH_BENCH_GENOMES)) {
    if (entry.path().filename().string().starts_with("solid-")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<evolve::Genome> genomes;
  for (const auto& file : files) genomes.push_back(evolve::read_genome(file));
  return genomes;
}

std::vector<core::Body> grown_bodies(int stage) {
  std::vector<core::Network> networks;
  for (const evolve::Genome& genome : evolved_genomes()) networks.push_back(compile(genome));
  const int stages[] = {stage};
  std::vector<core::Body> bodies;
  for (const auto& embryos : core::develop(networks, core::DevelopmentRules{}, stages, 1)) {
    core::Extraction extraction = core::extract_body(embryos.front());
    if (extraction.status == core::Status::ok) bodies.push_back(std::move(extraction.body));
  }
  return bodies;
}

core::Scene plain(core::Scene scene) {
  scene.self_collision = false;
  scene.settle_max_steps = 0;
  return scene;
}

double water_step_flop(const core::Body& body) {
  const auto edges = static_cast<double>(core::outline_of(body.triangles).size());
  const double nodes = body.node_count();
  const double slots = 2.0 * static_cast<double>(body.springs.size());
  const double corners = 3.0 * static_cast<double>(body.triangles.size());
  return 27 * slots + 15 * corners + 29 * 2 * edges + 19 * nodes;
}

}  // namespace metamorph::bench
