// The list of self-collision misses no pair that touches, whatever the motion: against every
// outline node and every outline edge.

#include "core/locomotion/collision_list.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "core/locomotion/solid_pairs.h"
#include "kernels/reference/self_collision.h"
#include "metamorph/random.h"
#include "tests/bodies.h"

namespace metamorph::core {
namespace {

/// A pair as lanes.
struct Pair {
  std::array<std::uint32_t, 3> lanes;  ///< first and second of the edge, then of the node
  double threshold;
};

/// One body, its list, and brute force over the same positions.
template <class T>
class Watched {
 public:
  explicit Watched(Body body, const Scene& scene = {})
      : scene_(scene),
        body_(std::move(body)),
        task_{&body_, &scene_},
        batch_({&task_, 1}, false, 1) {
    shape_ = batch_.shape(0);
    state_ = batch_.start(0, buffers_);
    list_.reset(body_, scene_, batch_, 0);
    std::vector<std::uint32_t> lane_of(body_.x.size());
    const auto nodes = batch_.node_of_lane(0);
    for (std::uint32_t l = 0; l < nodes.size(); ++l)
      if (nodes[l] >= 0) lane_of[static_cast<std::size_t>(nodes[l])] = l;
    const auto lane = [&](Index node) { return lane_of[static_cast<std::size_t>(node)]; };
    for (const SolidPair& pair : solid_pairs(body_, scene_)) {
      pairs_.push_back({{lane(pair.edge[0]), lane(pair.edge[1]), lane(pair.node)}, pair.threshold});
    }
  }

  /// Moves every node to to(lane, x, y); says so as the step does, largest speed first.
  template <class Motion>
  void move(Motion&& to) {
    step(to);
    end_step();
  }

  /// The same, with a list that reaches as far as two nodes of the step can come, as what stops
  /// approaches asks for. Returns how many pairs come within their least gap on the way, all of
  /// which must be listed.
  template <class Motion>
  int move_within_reach(Motion&& to) {
    const double reach = 2 * step(to);
    check(reach);
    std::set<std::array<std::uint32_t, 3>> listed;
    for (const Pair& pair : list(reach)) listed.insert(pair.lanes);
    int met = 0;
    const double doubt = this->doubt();
    for (const Pair& pair : pairs_) {
      double gap = std::numeric_limits<double>::infinity();
      for (int k = 0; k <= 8; ++k) gap = std::min(gap, gap_at(pair, k / 8.0));
      if (gap > std::min(scene_.collision_least_gap, pair.threshold / 2) - doubt) continue;
      ++met;
      EXPECT_EQ(listed.count(pair.lanes), 1u) << "missed, gap " << gap << " on the way";
    }
    end_step();
    check();
    return met;
  }

  /// The motion of a node by `way` and of an edge by as much, straight towards each other; all
  /// others stay.
  static auto towards_each_other(const Pair& pair, const kernels::reference::ClosestPoint& point,
                                 double way) {
    const double dx = way * point.dx / point.gap, dy = way * point.dy / point.gap;
    return [lanes = pair.lanes, dx, dy](int lane, double px, double py) {
      const auto l = static_cast<std::uint32_t>(lane);
      const double share = l == lanes[2] ? -1 : l == lanes[0] || l == lanes[1] ? 1 : 0;
      return std::pair{px + share * dx, py + share * dy};
    };
  }

  /// Takes a step of `way` with a node and of as much with an edge, straight towards each other.
  /// All others stay. Returns how far apart they are.
  double close_in(const Pair& pair, double way) {
    const auto point = closest_point(pair, 0);
    move(towards_each_other(pair, point, way));
    return point.gap;
  }

  /// The same in one step with a list that reaches so far. Returns how far apart they were.
  double rush_in(const Pair& pair, double way) {
    const auto point = closest_point(pair, 0);
    if (point.gap < 2 * way + 1) return 0;
    move_within_reach(towards_each_other(pair, point, way));
    return point.gap;
  }

  const std::vector<Pair>& pairs() const { return pairs_; }

  /// Checks the list against brute force; returns how many pairs touch.
  int check(double reach = 0) {
    const std::vector<Pair> listed = list(reach);
    const double doubt = this->doubt();
    int touching = 0;
    std::size_t at = 0;  // in the list, whose order is that of solid_pairs()
    for (const Pair& pair : pairs_) {
      const double least = std::min(scene_.collision_least_gap, pair.threshold / 2);
      const double far = std::max(pair.threshold, least + reach);
      const double gap = gap_at(pair, 0, far);
      if (at < listed.size() && listed[at].lanes == pair.lanes) {
        EXPECT_NEAR(listed[at].threshold, pair.threshold, doubt);
        ++at;
      } else if (gap <= far - doubt) {
        ADD_FAILURE() << "missed edge " << pair.lanes[0] << " " << pair.lanes[1] << ", node "
                      << pair.lanes[2] << ", gap " << gap;
      }
      touching += gap < pair.threshold;
    }
    EXPECT_EQ(at, listed.size()) << "listed twice, out of order, or no pair";
    return touching;
  }

  /// How many pairs the list holds.
  std::size_t listed() { return list().size(); }

 private:
  /// From now to next; returns the longest way of a node.
  template <class Motion>
  double step(Motion&& to) {
    const T h = time_;
    speed2_.fill(T(0));
    T fastest2 = 0;
    for (int l = 0; l < shape_.nodes; ++l) {
      const kernels::NodeRecord<T> record = state_.now[l];
      const double from_x = static_cast<double>(record.x), from_y = static_cast<double>(record.y);
      const auto [x, y] = to(l, from_x, from_y);
      const T vx = static_cast<T>((x - from_x) / h), vy = static_cast<T>((y - from_y) / h);
      state_.next[l] = record;
      state_.next[l].x = std::fma(h, vx, record.x);
      state_.next[l].y = std::fma(h, vy, record.y);
      T& most = speed2_[static_cast<std::size_t>(l) % speed2_.size()];
      most = std::max(most, vx * vx + vy * vy);
      fastest2 = std::max(fastest2, most);
    }
    return static_cast<double>(h * std::sqrt(fastest2));
  }

  void end_step() {
    list_.advance(kernels::Lanes<T>::load(speed2_.data()), time_);
    std::swap(state_.now, state_.next);
  }

  std::vector<Pair> list(double reach = 0) {
    const kernels::CollisionPairs<T> pairs =
        list_.pairs(state_.now, shape_.inverse_mass, static_cast<T>(reach));
    EXPECT_EQ(pairs.count % kernels::Lanes<T>::width, 0);
    std::vector<Pair> listed;
    for (int i = 0; i < pairs.count; ++i) {
      if (pairs.threshold[i] == T(0)) continue;
      constexpr std::uint32_t one = kernels::record_offset<T>(1);
      listed.push_back({{pairs.first[i] / one, pairs.second[i] / one, pairs.node[i] / one},
                        static_cast<double>(pairs.threshold[i])});
    }
    return listed;
  }

  /// On the straight way from now (0) to next (1).
  kernels::reference::ClosestPoint closest_point(const Pair& pair, double share) const {
    std::array<double, 3> x{}, y{};
    for (std::size_t k = 0; k < 3; ++k) {
      const kernels::NodeRecord<T>&from = state_.now[pair.lanes[k]],
            &to = state_.next[pair.lanes[k]];
      x[k] = static_cast<double>(from.x);
      y[k] = static_cast<double>(from.y);
      if (share == 0) continue;
      x[k] += share * static_cast<double>(to.x - from.x);
      y[k] += share * static_cast<double>(to.y - from.y);
    }
    return kernels::reference::closest_point(2, {0, 1}, x, y);
  }
  /// Of pairs that are farther apart than `far` now how far at least.
  double gap_at(const Pair& pair, double share, double far = 1) const {
    if (share == 0) {
      const auto record = [&](std::size_t k) { return state_.now[pair.lanes[k]]; };
      const auto apart = [](const auto& a, const auto& b) {
        const double x = static_cast<double>(a.x - b.x), y = static_cast<double>(a.y - b.y);
        return std::sqrt(x * x + y * y);
      };
      const double least = apart(record(0), record(2)) - apart(record(0), record(1));
      if (least > far) return least;
    }
    return closest_point(pair, share).gap;
  }

  /// What rounding the coordinates and the arithmetic on them can change of a distance.
  double doubt() const {
    double size = 1;
    for (int l = 0; l < shape_.nodes; ++l)
      size = std::max({size, std::abs(static_cast<double>(state_.now[l].x)),
                       std::abs(static_cast<double>(state_.now[l].y))});
    return 32 * static_cast<double>(std::numeric_limits<T>::epsilon()) * size;
  }

 private:
  Scene scene_;
  Body body_;
  LocomotionTask task_;
  BodyBatch<T> batch_;
  StateBuffers<T> buffers_;
  kernels::BodyShape<T> shape_{};
  kernels::BodyState<T> state_{};
  static constexpr T time_ = T(0.25);  ///< of a step
  alignas(64) std::array<T, kernels::Lanes<T>::width> speed2_{};
  CollisionList<T> list_;
  std::vector<Pair> pairs_;  // all there are
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
  evolve::RandomStream random(evolve::Purpose::test, seed, 0, 0);
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
  evolve::RandomStream random(evolve::Purpose::test, seed, 1, 0);
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(n));
  };
  const Scene scene;
  Watched<T> body(tests::blob_body(60, seed), scene);
  body.check();
  for (int attempt = 0; attempt < 5; ++attempt) {
    const Pair pair = body.pairs()[below(body.pairs().size())];
    const double way = 0.002 + 0.1 * random.uniform();
    if (pair.threshold < scene.collision_gap) continue;  // neighbours
    while (body.close_in(pair, way) > 0.25 + 2 * way) body.check();
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

// Steps so long that pairs meet on the way that a list made for half a skin would not hold; up to
// 1.4 d, far beyond what a run survives.
template <class T>
void rush() {
  const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1000);
  evolve::RandomStream random(evolve::Purpose::test, seed, 3, 0);
  Watched<T> body(seed % 2 == 0 ? tests::blob_body(40, seed) : tests::ring_body(3, 7));
  for (int n = 0; n < 12; ++n) {
    // Nearly always slow, so that the list has been made for slow ones.
    const double pace = random.uniform() < 0.7 ? 0.02 : 0.1 + 0.9 * random.uniform();
    const auto draw = [&] { return pace * random.triangular(); };
    body.move_within_reach(
        [&](int, double x, double y) { return std::pair{x + draw(), y + draw()}; });
  }
  RC_ASSERT(!::testing::Test::HasFailure());
}

RC_GTEST_PROP(CollisionList, HoldsWhatFastStepsMeetOnTheirWayInFloat, ()) { rush<float>(); }
RC_GTEST_PROP(CollisionList, HoldsWhatFastStepsMeetOnTheirWayInDouble, ()) { rush<double>(); }

TEST(CollisionList, ForgetsNoFastStepThatItWasRenewedIn) {
  // After a step longer than half a skin, a pair goes on towards each other in short ones.
  const Scene scene;
  for (const double fast : {0.26, 0.4, 0.8}) {
    const Watched<double> body(tests::ring_body(3, 7), scene);
    for (std::size_t p = 0; p < body.pairs().size(); p += 389) {
      const Pair pair = body.pairs()[p];
      if (pair.threshold < scene.collision_gap) continue;
      Watched<double> fresh(tests::ring_body(3, 7), scene);
      if (fresh.rush_in(pair, fast) < 3 * fast + 0.5) continue;
      while (fresh.close_in(pair, 0.02) > 0.25) fresh.check();
      fresh.check();
    }
  }
}

TEST(CollisionList, HoldsWhatPassesThroughInOneStep) {
  // The sides of the ring's hole go through each other: at both ends of the step they are far
  // apart.
  Watched<float> body(tests::ring_body(3, 7));
  for (int n = 0; n < 15; ++n)
    body.move([](int, double x, double y) { return std::pair{x, 0.95 * y}; });
  const int touching = body.check();
  const int met = body.move_within_reach([](int, double x, double y) {
    return std::pair{x, std::abs(y) < 2 ? y - std::copysign(1.3, y) : y};
  });
  EXPECT_GT(met, touching + 4);
}

TEST(CollisionList, HoldsTheCornersOfTrianglesWithoutPressureForEver) {
  Scene scene;
  scene.min_pressure_area = 0.42;  // some triangles of a blob are smaller
  for (const std::uint64_t seed : {3u, 4u, 5u}) {
    const Body blob = tests::blob_body(40, seed);
    const std::size_t corners = corners_without_pressure(blob, scene).size();
    ASSERT_GT(corners, 3u);
    Watched<double> body(blob, scene);
    const Scene all_have;
    Watched<double> without(blob, all_have);
    EXPECT_EQ(body.listed(), without.listed() + corners);
    // Blown up, so that nothing is near.
    for (int n = 0; n < 40; ++n) {
      body.move([](int, double x, double y) { return std::pair{1.1 * x, 1.1 * y}; });
      body.check();
    }
    EXPECT_EQ(body.listed(), corners);
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
