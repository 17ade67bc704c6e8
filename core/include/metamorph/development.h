#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "metamorph/body.h"
#include "metamorph/network.h"
#include "metamorph/signals.h"
#include "metamorph/status.h"

namespace metamorph::core {

/// The rules of development (MODEL section 2). Times in paper steps, lengths in d.
struct DevelopmentRules {
  int steps = 1200;  ///< whole development; the time input is step / steps
  int max_cells = 256;
  int renew_interval = 10;   ///< neighbours
  int update_interval = 30;  ///< control network
  double step = 0.2;         ///< time units per step
  double stiffness = 1.0;
  double damping = 1.0;
  double drag = 0.2;             ///< per cell, force = -drag * velocity
  double link_limit = 1.5;       ///< longer links stay only where connectivity needs them
  double division_space = 0.9;   ///< no other centre may lie this close to a daughter's
  double coordinate_scale = 10;  ///< the x and y inputs are divided by it
  double period_min = 30;        ///< time units
  double period_max = 120;
  std::vector<Input> inputs = paper_inputs();     ///< of the control network, in order of its slots
  std::vector<Output> outputs = paper_outputs();  ///< in order of Network::output; others read 0
};

/// An embryo between two steps, neighbours renewed. Cells in order of age (id ascending).
struct Embryo {
  int step = 0;
  Status status = Status::ok;  ///< ok, empty or bad_development (both without cells)
  std::vector<int> id;         ///< counts births; founder 0
  std::vector<int> mother;     ///< id; founder -1
  std::vector<int> birth_step;
  std::vector<double> x, y;                 ///< d, founder started at (0, 0)
  std::vector<double> orientation;          ///< radians, (-pi, pi]
  std::vector<double> period;               ///< time units; as if development ended here
  std::vector<double> phase;                ///< radians
  std::vector<std::array<Index, 2>> links;  ///< positions in the cell list, i < j, ascending
  std::vector<std::array<Index, 3>> faces;  ///< Delaunay faces, counter-clockwise
  int created = 1;                          ///< cells ever created up to here, founder included
  int died = 0;

  Index cell_count() const { return static_cast<Index>(id.size()); }
};

/// What keeps a network from developing under these rules, in one line: other numbers of inputs or
/// outputs than the rules have, lists that do not fit each other, a link or an output from a slot
/// that is not computed before. Empty if nothing does.
std::string check(const Network& network, const DevelopmentRules& rules);

/// Develops every network as one batch and returns, for each of them, the embryo at each of
/// `stages` (ascending steps, the last one <= rules.steps). Taking an embryo out leaves no trace.
/// Precondition: check() finds nothing in any network.
/// result[network][stage]; the same bits for any batch, order and thread count (0: all threads).
std::vector<std::vector<Embryo>> develop(std::span<const Network> networks,
                                         const DevelopmentRules& rules, std::span<const int> stages,
                                         int threads);

/// The same for embryos that are controlled by one network after the other. lives[embryo] holds
/// either one network, for all of life, or switches.size() + 1: from step switches[k] on, networks
/// [k + 1] does the updates. An embryo that is taken out at that very step still is of the life
/// before: its oscillators are those of networks[k]. `switches`: ascending steps.
std::vector<std::vector<Embryo>> develop(std::span<const std::vector<Network>> lives,
                                         std::span<const int> switches,
                                         const DevelopmentRules& rules, std::span<const int> stages,
                                         int threads);

}  // namespace metamorph::core
