#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "core/body/edge_uses.h"
#include "core/body/outline_crossing.h"
#include "core/body/parts.h"
#include "metamorph/body.h"

namespace metamorph::core {
namespace {

constexpr double smallest_length = 1e-3;  ///< d
constexpr double smallest_area = 1e-3;    ///< d^2
constexpr double farthest = 1e6;          ///< d

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::string text(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return std::string(buffer, end);
}

std::string text(Index value) { return std::to_string(value); }

template <std::size_t n>
std::string text(const std::array<Index, n>& indices) {
  std::string result;
  for (const Index i : indices) result.append(result.empty() ? "[" : ", ").append(text(i));
  return result.append("]");
}

std::string element(const char* field, std::size_t index) {
  return std::string(field).append("[").append(std::to_string(index)).append("]");
}

std::string text(const OutlineCrossing& crossing) {
  switch (crossing.meeting) {
    case Meeting::crossing:
      return "cross";
    case Meeting::touching:
      return "node " + text(crossing.node) + " lies on both";
    case Meeting::pinch:
      break;
  }
  return "the parts that meet at node " + text(crossing.node) + " overlap";
}

/// Collects the faults of one body. Every check assumes what the checks before it made sure.
class Checker {
 public:
  explicit Checker(const Body& body) : body_(body) {}

  std::vector<BodyFault> run() {
    check_sizes();
    if (!faults_.empty()) return std::move(faults_);
    check_indices();
    const bool indices_good = faults_.empty();
    check_values();
    if (!indices_good) return std::move(faults_);
    check_springs();
    bool mesh_good = check_mesh();
    if (mesh_good) {
      check_parts();
      mesh_good = check_fans();
    }
    if (positions_good_ && check_geometry() && mesh_good) check_overlap();
    return std::move(faults_);
  }

 private:
  void fault(Status status, const std::string& where, const std::string& value,
             const std::string& expected) {
    faults_.push_back({status, where + ": " + value + ": expected " + expected});
  }

  std::string position(std::size_t node) const {
    return std::string("[")
        .append(text(body_.x[node]))
        .append(", ")
        .append(text(body_.y[node]))
        .append("]");
  }

  void check_sizes() {
    const std::size_t nodes = body_.x.size();
    const auto size = [&](const char* field, std::size_t is, std::size_t should, const char* of) {
      if (is == should) return;
      fault(Status::bad_input, field, std::to_string(is) + " values",
            std::to_string(should) + ", one per " + of);
    };
    if (nodes < 3) fault(Status::bad_input, "nodes", std::to_string(nodes), "at least 3");
    if (body_.triangles.empty()) fault(Status::bad_input, "triangles", "0", "at least 1");
    size("y", body_.y.size(), nodes, "node");
    size("period", body_.period.size(), nodes, "node");
    size("phase", body_.phase.size(), nodes, "node");
    if (!body_.cell.empty()) size("cell", body_.cell.size(), nodes, "node");
    size("rest_length", body_.rest_length.size(), body_.springs.size(), "spring");
    size("rest_area", body_.rest_area.size(), body_.triangles.size(), "triangle");
  }

  template <std::size_t n>
  void check_indices_of(const char* field, const std::vector<std::array<Index, n>>& items) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      std::array<Index, n> sorted = items[i];
      std::sort(sorted.begin(), sorted.end());
      if (sorted.front() < 0 || sorted.back() >= body_.node_count()) {
        fault(Status::bad_input, element(field, i), text(items[i]),
              "node numbers from 0 to " + std::to_string(body_.node_count() - 1));
      } else if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
        fault(Status::bad_topology, element(field, i), text(items[i]), "different nodes");
      }
    }
  }

  void check_indices() {
    check_indices_of("triangles", body_.triangles);
    check_indices_of("springs", body_.springs);
  }

  void check_values() {
    for (std::size_t i = 0; i < body_.x.size(); ++i) {
      if (!std::isfinite(body_.x[i]) || !std::isfinite(body_.y[i])) {
        positions_good_ = false;
        fault(Status::bad_input, element("nodes", i), position(i), "finite numbers");
      } else if (std::abs(body_.x[i]) > farthest || std::abs(body_.y[i]) > farthest) {
        positions_good_ = false;
        fault(Status::bad_input, element("nodes", i), position(i), "within 1e6 of the origin");
      }
      if (!(std::isfinite(body_.period[i]) && body_.period[i] >= smallest_period)) {
        fault(Status::bad_input, element("period", i), text(body_.period[i]),
              "a finite number >= " + text(smallest_period));
      }
      if (!std::isfinite(body_.phase[i])) {
        fault(Status::bad_input, element("phase", i), text(body_.phase[i]), "a finite number");
      }
    }
    for (std::size_t i = 0; i < body_.rest_length.size(); ++i) {
      if (!std::isfinite(body_.rest_length[i])) {
        fault(Status::bad_input, element("rest_length", i), text(body_.rest_length[i]),
              "a finite number");
      }
    }
    for (std::size_t i = 0; i < body_.rest_area.size(); ++i) {
      if (!std::isfinite(body_.rest_area[i])) {
        fault(Status::bad_input, element("rest_area", i), text(body_.rest_area[i]),
              "a finite number");
      }
    }
  }

  void check_springs() {
    const std::vector<std::array<Index, 2>> edges = edges_of(body_.triangles);
    if (body_.springs == edges) return;
    const std::size_t before = faults_.size();
    std::vector<std::array<Index, 2>> springs = body_.springs;
    std::sort(springs.begin(), springs.end());
    for (std::size_t i = 0; i < body_.springs.size(); ++i) {
      if (!std::binary_search(edges.begin(), edges.end(), body_.springs[i])) {
        fault(Status::bad_topology, element("springs", i), text(body_.springs[i]),
              "the edge of a triangle, lower node first");
      }
    }
    for (const auto& edge : edges) {
      if (!std::binary_search(springs.begin(), springs.end(), edge)) {
        fault(Status::bad_topology, "springs", "no " + text(edge), "every edge of a triangle");
      }
    }
    if (faults_.size() == before) {
      fault(Status::bad_topology, "springs", "out of order or repeated",
            "every edge once, ascending");
    }
  }

  /// Every edge has one triangle, or two that lie on different sides of it.
  bool check_mesh() {
    const std::size_t before = faults_.size();
    uses_ = sorted_edge_uses(body_.triangles);
    for (std::size_t u = 0, next = 0; u < uses_.size(); u = next) {
      next = end_of_edge(uses_, u);
      const std::array<Index, 2> edge = {uses_[u].low, uses_[u].high};
      if (next - u > 2) {
        fault(Status::bad_topology, "edge " + text(edge), std::to_string(next - u) + " triangles",
              "at most 2");
      } else if (next - u == 2 && forward(uses_[u]) == forward(uses_[u + 1])) {
        fault(Status::bad_topology, "edge " + text(edge),
              "triangles " + std::to_string(uses_[u].triangle) + " and " +
                  std::to_string(uses_[u + 1].triangle) + " lie on one side of it",
              "one on either side");
      }
    }
    return faults_.size() == before;
  }

  bool forward(const EdgeUse& use) const {
    return body_.triangles[at(use.triangle)][at(use.side)] == use.low;
  }

  /// No node without triangle, all triangles connected through edges.
  void check_parts() {
    std::vector<bool> used(body_.x.size(), false);
    for (const auto& triangle : body_.triangles) {
      for (const Index node : triangle) used[at(node)] = true;
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (!used[i]) {
        fault(Status::bad_topology, element("nodes", i), "isolated", "a triangle that has it");
      }
    }

    Parts triangles(body_.triangles.size());
    for (std::size_t u = 0; u + 1 < uses_.size(); ++u) {
      if (!uses_[u].same_edge(uses_[u + 1])) continue;
      triangles.join(at(uses_[u].triangle), at(uses_[u + 1].triangle));
    }
    std::size_t parts = 0;
    std::size_t second = 0;
    for (std::size_t t = 0; t < body_.triangles.size(); ++t) {
      if (triangles.is_first(t) && ++parts == 2) second = t;
    }
    if (parts > 1) {
      fault(Status::bad_topology, element("triangles", second),
            "in the second of " + std::to_string(parts) + " parts that share no edge",
            "one edge-connected part");
    }
  }

  /// Around a node lies one closed fan of triangles, or open ones: beside a closed fan there is no
  /// room for another.
  bool check_fans() {
    const std::size_t before = faults_.size();
    Parts corners(3 * body_.triangles.size());
    std::vector<int> fans(body_.x.size()), edges(body_.x.size());
    const auto corner = [&](const EdgeUse& use, Index node) {
      const auto& triangle = body_.triangles[at(use.triangle)];
      const auto place = std::find(triangle.begin(), triangle.end(), node) - triangle.begin();
      return 3 * at(use.triangle) + static_cast<std::size_t>(place);
    };
    for (std::size_t u = 0, next = 0; u < uses_.size(); u = next) {
      next = end_of_edge(uses_, u);
      for (const Index node : {uses_[u].low, uses_[u].high}) {
        if (next - u == 2) {
          corners.join(corner(uses_[u], node), corner(uses_[u + 1], node));
        } else {
          ++edges[at(node)];
        }
      }
    }
    for (std::size_t t = 0; t < body_.triangles.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        fans[at(body_.triangles[t][c])] += corners.is_first(3 * t + c) ? 1 : 0;
      }
    }
    for (std::size_t n = 0; n < fans.size(); ++n) {
      const int open = edges[n] / 2;  // each ends in two outline edges
      if (fans[n] > std::max(open, 1)) {
        fault(Status::bad_topology, element("nodes", n),
              std::to_string(fans[n]) + " fans of triangles around it, " +
                  std::to_string(fans[n] - open) + " of them closed",
              "one closed fan, or open ones only");
      }
    }
    return faults_.size() == before;
  }

  /// True if every triangle is counter-clockwise.
  bool check_geometry() {
    check_coincident();
    bool turned_well = true;
    for (std::size_t i = 0; i < body_.springs.size(); ++i) {
      const double rest = body_.rest_length[i];
      if (rest < smallest_length && rest != length(body_, body_.springs[i])) {
        fault(Status::bad_geometry, element("rest_length", i), text(rest),
              "at least " + text(smallest_length));
      }
    }
    for (std::size_t t = 0; t < body_.triangles.size(); ++t) {
      const double area = signed_area(body_, body_.triangles[t]);
      if (!(area > 0)) {
        turned_well = false;
        fault(Status::bad_geometry, element("triangles", t),
              text(body_.triangles[t]) + " with area " + text(area),
              "counter-clockwise nodes, area > 0");
      }
      // A sliver as development may leave it is harmless (it exerts no pressure); one that is
      // asked for is a mistake.
      const double rest = body_.rest_area[t];
      if (std::isfinite(rest) && rest < smallest_area && rest != area) {
        fault(Status::bad_geometry, element("rest_area", t), text(rest),
              "at least " + text(smallest_area));
      }
    }
    return turned_well;
  }

  void check_coincident() {
    std::vector<std::size_t> order(body_.x.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return body_.x[a] != body_.x[b] ? body_.x[a] < body_.x[b] : a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        const double dx = body_.x[order[j]] - body_.x[order[i]];
        if (dx >= smallest_length) break;
        const double dy = body_.y[order[j]] - body_.y[order[i]];
        if (dx * dx + dy * dy >= smallest_length * smallest_length) continue;
        const auto [low, high] = std::minmax(order[i], order[j]);
        fault(Status::bad_geometry, element("nodes", high), position(high),
              "at least " + text(smallest_length) + " from node " + std::to_string(low));
      }
    }
  }

  /// The body covers no point of the plane twice. Its outline alone would tell; that triangles turn
  /// more than once around a node is looked at to name the node.
  void check_overlap() {
    check_turns();
    std::vector<std::array<Index, 2>> outline;
    for (std::size_t u = 0, next = 0; u < uses_.size(); u = next) {
      next = end_of_edge(uses_, u);
      if (next - u > 1) continue;
      const Index low = uses_[u].low, high = uses_[u].high;
      outline.push_back(forward(uses_[u]) ? std::array{low, high} : std::array{high, low});
    }
    if (const auto found = first_crossing(body_.x, body_.y, outline)) {
      const std::string first = text(outline[at(found->edges[0])]);
      const std::string second = text(outline[at(found->edges[1])]);
      fault(Status::bad_geometry, "outline edges " + first + " and " + second, text(*found),
            "an outline that neither crosses nor touches itself");
    } else if (const auto edge = first_overlap(body_.x, body_.y, outline)) {
      fault(Status::bad_geometry, "outline edge " + text(outline[at(*edge)]),
            "within or around another part of the body", "parts that do not overlap");
    }
  }

  /// Triangles around a node turn around it as often as their corners pass the direction of +x.
  void check_turns() {
    std::vector<int> turns(body_.x.size(), 0);
    for (const auto& triangle : body_.triangles) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t node = at(triangle[c]);
        const bool passes =
            !is_above(at(triangle[(c + 1) % 3]), node) && is_above(at(triangle[(c + 2) % 3]), node);
        turns[node] += passes ? 1 : 0;
      }
    }
    for (std::size_t n = 0; n < turns.size(); ++n) {
      if (turns[n] > 1) {
        fault(Status::bad_geometry, element("nodes", n), "its triangles lie on each other",
              "triangles that turn around it once");
      }
    }
  }

  /// In the half of directions from +x (included) to -x (excluded).
  bool is_above(std::size_t other, std::size_t node) const {
    return body_.y[other] > body_.y[node] ||
           (body_.y[other] == body_.y[node] && body_.x[other] > body_.x[node]);
  }

  const Body& body_;
  std::vector<BodyFault> faults_;
  std::vector<EdgeUse> uses_;
  bool positions_good_ = true;
};

}  // namespace

std::vector<BodyFault> check(const Body& body) { return Checker(body).run(); }

Status status_of(const std::vector<BodyFault>& faults) {
  Status status = Status::ok;
  for (const BodyFault& fault : faults) {
    status = status == Status::ok ? fault.status : std::min(status, fault.status);
  }
  return status;
}

}  // namespace metamorph::core
