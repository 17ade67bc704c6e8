#include "core/development/link_check.h"

#include <algorithm>
#include <iterator>

#include "core/development/delaunay.h"
#include "core/development/links.h"

namespace metamorph::core {
namespace {

using Links = std::vector<std::array<Index, 2>>;

std::string list_text(const Links& links) {
  constexpr std::size_t most = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(links.size(), most); ++i) {
    text.append(" ").append(std::to_string(links[i][0]));
    text.append("-").append(std::to_string(links[i][1]));
  }
  if (links.empty()) text = " none";
  if (links.size() > most) text += " and " + std::to_string(links.size() - most) + " more";
  return text;
}

}  // namespace

void LinkCheck::compare(int at_step, std::span<const double> x, std::span<const double> y,
                        double limit, std::span<const std::array<Index, 2>> chosen) {
  Triangulation full;
  triangulate(x, y, full);
  Links expected;
  LinkSelection().select(x, y, limit, full.edges, expected);
  ++renewals;
  links += static_cast<std::int64_t>(expected.size());
  if (!ok() || std::equal(chosen.begin(), chosen.end(), expected.begin(), expected.end())) return;
  step = at_step;
  std::set_difference(expected.begin(), expected.end(), chosen.begin(), chosen.end(),
                      std::back_inserter(missing));
  std::set_difference(chosen.begin(), chosen.end(), expected.begin(), expected.end(),
                      std::back_inserter(surplus));
}

std::string difference_text(const LinkCheck& check) {
  if (check.ok()) return {};
  return "step " + std::to_string(check.step) +
         " of development: other links than those of a full triangulation: missing" +
         list_text(check.missing) + "; surplus" + list_text(check.surplus);
}

}  // namespace metamorph::core
