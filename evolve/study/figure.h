#pragma once

#include "evolve/study/curves.h"
#include "evolve/view/chart.h"

namespace metamorph::evolve {

/// The figure of a study: a panel for every measure, a colour for every experiment.
Chart figure_of(const Study& study, const PlotKind& kind, Centre centre);

}  // namespace metamorph::evolve
