// The list of self-collision misses no pair that touches, whatever the motion: against every
// outline node and every outline edge.

#include "core/collision_list_detail.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/random.h"
#include "kernels/reference/self_collision.h"
#include "tests/bodies.h"

namespace metamorph::core {
namespace {

using Pair = std::array<std::uint32_t, 3>;  // first and second lane of the edge, lane of the node

/// One body, its list, and brute force over the same positions.
template <class T>
class Watched {
 public:
  explicit Watched(Body body)
      : body_(std::move(body)), task_{&body_, &scene_}, batch_({&task_, 1}, false, 1) {
    view_ = batch_.view(0, state_);
    const auto nodes = batch_.outline_nodes(0);
    for (std::uint32_t n = 0; n < nodes.size(); ++n) nodes_.push_back(static_cast<int>(n));
    for (const auto& [a, b] : batch_.outline_edges(0)) {
      edges_.push_back({static_cast<int>(a), static_cast<int>(b)});
    }
    list_.reset(body_, scene_, nodes, batch_.outline_edges(0));
    std::vector<double> x, y;
    for (const Index node : nodes) {
      x.push_back(body_.x[static_cast<std::size_t>(node)]);
      y.push_back(body_.y[static_cast<std::size_t>(node)]);
    }
    threshold_.resize(nodes_.size() * edges_.size());
    kernels::reference::set_collision_thresholds(nodes_, edges_, scene_.collision_gap, x, y,
                                                 threshold_);
  }

  /// Moves every node to to(lane, x, y); says so as the step does, largest speed first.
  template <class Motion>
  void move(Motion&& to) {
    constexpr int width = kernels::Lanes<T>::width;
    std::array<T, width> speed2{};
    const T h = T(0.25);
    for (int l = 0; l < view_.nodes; ++l) {
      kernels::NodeRecord<T>& record = view_.now[l];
      const double from_x = static_cast<double>(record.x), from_y = static_cast<double>(record.y);
      const auto [x, y] = to(l, from_x, from_y);
      const T vx = static_cast<T>((x - from_x) / h), vy = static_cast<T>((y - from_y) / h);
      record.x = std::fma(h, vx, record.x);
      record.y = std::fma(h, vy, record.y);
      T& most = speed2[static_cast<std::size_t>(l % width)];
      most = std::max(most, vx * vx + vy * vy);
    }
    alignas(64) std::array<T, width> aligned = speed2;
    list_.advance(kernels::Lanes<T>::load(aligned.data()), h);
  }

  /// Takes a step of `way` with a node and of as much with an edge, straight towards each other.
  /// All others stay. Returns how far apart they are.
  double close_in(std::size_t n, std::size_t e, double way) {
    const auto x = [&](int lane) { return static_cast<double>(view_.now[lane].x); };
    const auto y = [&](int lane) { return static_cast<double>(view_.now[lane].y); };
    std::vector<double> xs, ys;
    for (const int lane : nodes_) xs.push_back(x(lane)), ys.push_back(y(lane));
    const auto point = kernels::reference::closest_point(nodes_[n], edges_[e], xs, ys);
    const double dx = way * point.dx / point.gap, dy = way * point.dy / point.gap;
    move([&, node = nodes_[n], edge = edges_[e]](int lane, double px, double py) {
      const double share = lane == node ? -1 : kernels::reference::has_end(edge, lane) ? 1 : 0;
      return std::pair{px + share * dx, py + share * dy};
    });
    return point.gap;
  }

  bool may_collide(std::size_t n, std::size_t e) const {
    return threshold_[n * edges_.size() + e] > 0;
  }
  std::size_t nodes() const { return nodes_.size(); }
  std::size_t edges() const { return edges_.size(); }

  /// Checks the list against brute force; returns how many pairs touch.
  int check() {
    const kernels::CollisionPairs<T> pairs = list_.pairs(view_.now, view_.inverse_mass);
    std::vector<double> x, y;
    for (const int n : nodes_) {
      x.push_back(static_cast<double>(view_.now[n].x));
      y.push_back(static_cast<double>(view_.now[n].y));
    }
    // What rounding the coordinates and the arithmetic on them can change of a distance.
    double size = 1;
    for (std::size_t n = 0; n < x.size(); ++n)
      size = std::max({size, std::abs(x[n]), std::abs(y[n])});
    const double doubt = 32 * static_cast<double>(std::numeric_limits<T>::epsilon()) * size;

    EXPECT_EQ(pairs.count % kernels::Lanes<T>::width, 0);
    std::vector<Pair> listed;
    std::vector<T> thresholds;
    for (int i = 0; i < pairs.count; ++i) {
      if (pairs.threshold[i] == T(0)) continue;
      constexpr std::uint32_t one = kernels::record_offset<T>(1);
      listed.push_back({pairs.first[i] / one, pairs.second[i] / one, pairs.node[i] / one});
      thresholds.push_back(pairs.threshold[i]);
    }
    int touching = 0;
    std::size_t at = 0;  // in the list, whose order is by edge, then node
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const double threshold = threshold_[n * edges_.size() + e];
        const double gap = kernels::reference::closest_point(nodes_[n], edges_[e], x, y).gap;
        const Pair pair = {static_cast<std::uint32_t>(edges_[e][0]),
                           static_cast<std::uint32_t>(edges_[e][1]), static_cast<std::uint32_t>(n)};
        if (at < listed.size() && listed[at] == pair) {
          EXPECT_GT(threshold, 0) << "neighbours of edge " << e << ", node " << n;
          EXPECT_NEAR(static_cast<double>(thresholds[at]), threshold, doubt);
          ++at;
        } else if (threshold > 0) {
          EXPECT_GT(gap, threshold - doubt) << "missed edge " << e << ", node " << n;
        }
        touching += gap < threshold;
      }
    }
    EXPECT_EQ(at, listed.size()) << "listed twice, or out of order";
    return touching;
  }

 private:
  Scene scene_;
  Body body_;
  LocomotionTask task_;
  BodyBatch<T> batch_;
  BodyState<T> state_;
  kernels::BodyView<T> view_{};
  CollisionList<T> list_;
  std::vector<int> nodes_;
  std::vector<kernels::reference::Edge> edges_;
  std::vector<double> threshold_;  // [nodes x edges]
};

/// A motion by one small step.
struct Drive {
  double x, y, angle;   // rigid: drift and turn about the origin
  double squeeze;       // towards the line y = 0
  double wave, length;  // sideways, a sine along x

  std::pair<double, double> operator()(int, double px, double py) const {
    py += wave * std::sin(px / length);
    py *= 1 - squeeze;
    return {std::cos(angle) * px - std::sin(angle) * py + x,
            std::sin(angle) * px + std::cos(angle) * py + y};
  }
};

template <class T>
void drive_about() {
  const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1000);
  RandomStream random(Purpose::test, seed, 0, 0);
  Watched<T> body(seed % 2 == 0 ? tests::blob_body(20 + static_cast<int>(seed % 7) * 20, seed)
                                : tests::ring_body(3, 7));
  const auto draw = [&](double most) { return most * random.triangular(); };
  for (int phase = 0; phase < 8; ++phase) {
    const bool rigid = random.uniform() < 0.3, slow = random.uniform() < 0.5;
    const double pace = slow ? 0.01 : 0.15;
    const Drive drive = {draw(5 * pace),         draw(5 * pace),         draw(pace),
                         rigid ? 0 : draw(pace), rigid ? 0 : draw(pace), 1 + 4 * random.uniform()};
    for (int n = 0; n < 25; ++n) {
      body.move(drive);
      body.check();
    }
    // Every node somewhere else at once.
    if (random.uniform() < 0.2) {
      body.move([&](int, double x, double y) { return std::pair{x + draw(3), y + draw(3)}; });
      body.check();
    }
  }
  RC_ASSERT(!::testing::Test::HasFailure());
}

RC_GTEST_PROP(CollisionList, MissesNoPairFloat, ()) { drive_about<float>(); }
RC_GTEST_PROP(CollisionList, MissesNoPairDouble, ()) { drive_about<double>(); }

// The worst that two can do: nothing else moves, and they go for each other.
template <class T>
void close_in_on_a_pair() {
  const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1000);
  RandomStream random(Purpose::test, seed, 1, 0);
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(n));
  };
  Watched<T> body(tests::blob_body(60, seed));
  body.check();
  for (int attempt = 0; attempt < 5; ++attempt) {
    const std::size_t n = below(body.nodes()), e = below(body.edges());
    const double way = 0.002 + 0.1 * random.uniform();
    if (!body.may_collide(n, e)) continue;
    while (body.close_in(n, e, way) > 0.25 + 2 * way) body.check();
    body.check();
  }
  RC_ASSERT(!::testing::Test::HasFailure());
}

RC_GTEST_PROP(CollisionList, MissesNoPairThatClosesInFloat, ()) { close_in_on_a_pair<float>(); }
RC_GTEST_PROP(CollisionList, MissesNoPairThatClosesInDouble, ()) { close_in_on_a_pair<double>(); }

// Coordinates between 512 and 1024 are multiples of 2^-14: a step of a little over half of that is
// rounded to nearly twice its length, every time.
TEST(CollisionList, MissesNoPairWhenStepsAreRounded) {
  const double step = 0.51 * std::ldexp(1.0, -14);
  for (const double start : {0.0, 0.3, 0.6}) {
    Watched<float> body(tests::ring_body(3, 7));
    const auto towards_middle = [](double y, double way) {
      return std::abs(y - 1000) < 0.1 ? y : y - std::copysign(way, y - 1000);
    };
    body.move([&](int, double x, double y) {
      return std::pair{x + 1000, towards_middle(y + 1000, start)};
    });
    EXPECT_EQ(body.check(), 0);
    int touching = 0;
    for (int n = 0; n < 200000 && touching < 1000; ++n) {
      body.move([&](int, double x, double y) { return std::pair{x, towards_middle(y, step)}; });
      if (n % 16 == 0) touching += body.check();
    }
    EXPECT_GE(touching, 1000);  // far beyond what rounding leaves in doubt
  }
}

// Squeezed flat and released: pairs come and go.
TEST(CollisionList, FollowsAFold) {
  Watched<double> body(tests::ring_body(3, 7));
  EXPECT_EQ(body.check(), 0);
  int touching = 0;
  for (int n = 0; n < 60; ++n) {
    body.move([](int, double x, double y) { return std::pair{x, 0.93 * y}; });
    touching = body.check();
  }
  EXPECT_GT(touching, 0);
  for (int n = 0; n < 60; ++n) {
    body.move([](int, double x, double y) { return std::pair{x, y / 0.93}; });
    touching = body.check();
  }
  EXPECT_EQ(touching, 0);
}

}  // namespace
}  // namespace metamorph::core
