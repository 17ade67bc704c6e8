#pragma once

#include <array>
#include <limits>
#include <string_view>
#include <tuple>

namespace metamorph::evolve {

/// What kind of animat an individual is in one trial: numbers by which searches tell individuals
/// apart (MODEL section 9). Not a number: it says nothing, for there is no body (none before it),
/// or it failed to move.
struct TrialDescriptors {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  // Of the body at rest (metamorph/shape.h).
  double cells = unknown;
  double elongation = unknown;
  double compactness = unknown;
  double symmetry = unknown;
  double limbs = unknown;
  double mean_period = unknown;
  double phase_coherence = unknown;
  // Of its motion (metamorph/outcome.h).
  double height = unknown;
  double stance = unknown;
  double gait_frequency = unknown;
  // Of the metamorphosis that led to it, from the stage before.
  double growth = unknown;
  double turnover = unknown;
  double reshaping = unknown;
};

/// One of them.
struct DescriptorField {
  std::string_view name;  ///< of the member; TRIAL.name in a problem, its column in the record
  double TrialDescriptors::* member;
  std::string_view unit;  ///< "1": a ratio or a count
  std::string_view meaning;
  double low, high;  ///< between them it is expected
  /// It tells of a change since the stage before, and the first stage does not have it.
  bool of_metamorphosis = false;
};

/// The one list of what describes an individual in a trial, in the order in which problems and the
/// record have it.
inline constexpr std::array descriptor_fields = {
    DescriptorField{"cells", &TrialDescriptors::cells, "1", "nodes of the body", 0, 256},
    DescriptorField{"elongation", &TrialDescriptors::elongation, "1",
                    "1 - short axis / long axis of the area", 0, 0.8},
    DescriptorField{"compactness", &TrialDescriptors::compactness, "1",
                    "4 pi area / (length of the outline)^2", 0.2, 0.9},
    DescriptorField{"symmetry", &TrialDescriptors::symmetry, "1",
                    "share of nodes with a partner in a mirror", 0.5, 1},
    DescriptorField{"limbs", &TrialDescriptors::limbs, "1", "protrusions of the outline", 0, 6},
    DescriptorField{"height", &TrialDescriptors::height, "d", "of the body as actuation begins", 0,
                    25},
    DescriptorField{"mean_period", &TrialDescriptors::mean_period, "time units",
                    "of the oscillators", 30, 120},
    DescriptorField{"phase_coherence", &TrialDescriptors::phase_coherence, "1",
                    "of the oscillators: 1 if all have one phase", 0, 1},
    DescriptorField{"stance", &TrialDescriptors::stance, "1",
                    "share of time on the ground of the nodes that touch it", 0, 1},
    DescriptorField{"gait_frequency", &TrialDescriptors::gait_frequency, "1/time unit",
                    "at which the mean node position moves most", 0, 0.07},
    DescriptorField{"growth", &TrialDescriptors::growth, "1", "cells / cells of the stage before",
                    0, 5, true},
    DescriptorField{"turnover", &TrialDescriptors::turnover, "1",
                    "(born + died since) / cells of the stage before", 0, 5, true},
    DescriptorField{"reshaping", &TrialDescriptors::reshaping, "1",
                    "1 - overlap with the body of the stage before", 0, 1, true}};

// What is new in TrialDescriptors must be listed above: the binding names as many members as there
// are, and each of them must be one field's.
static_assert([] {
  const TrialDescriptors all;
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = all;
  const auto times_listed = [&all](const double& member) {
    int times = 0;
    for (const DescriptorField& field : descriptor_fields) times += &(all.*field.member) == &member;
    return times;
  };
  return std::apply([&](const auto&... member) { return ((times_listed(member) == 1) && ...); },
                    std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m));
}());

}  // namespace metamorph::evolve
