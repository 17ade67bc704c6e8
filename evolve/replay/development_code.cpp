#include "evolve/replay/development_code.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>

#include "evolve/replay/track_code.h"

namespace metamorph::evolve {
namespace {

struct CellLife {
  int mother = -1, birth_step = 0;
  Course course;
  std::vector<double> period, phase;  ///< by frame
};

std::map<int, CellLife> cells_of(std::span<const core::Embryo> embryos) {
  std::map<int, CellLife> cells;  // by id
  for (std::size_t frame = 0; frame < embryos.size(); ++frame) {
    const core::Embryo& embryo = embryos[frame];
    for (std::size_t i = 0; i < embryo.id.size(); ++i) {
      const auto [place, is_new] = cells.try_emplace(embryo.id[i]);
      CellLife& cell = place->second;
      if (is_new) {
        cell.mother = embryo.mother[i];
        cell.birth_step = embryo.birth_step[i];
        cell.course.first = static_cast<int>(frame);
      }
      cell.course.x.push_back(embryo.x[i]);
      cell.course.y.push_back(embryo.y[i]);
      cell.period.push_back(embryo.period[i]);
      cell.phase.push_back(embryo.phase[i]);
    }
  }
  return cells;
}

void append(std::string& bytes, std::size_t value) {
  append_varint(bytes, static_cast<std::uint64_t>(value));
}

std::string packed_cells(const std::map<int, CellLife>& cells) {
  std::string bytes;
  append(bytes, cells.size());
  int before = 0;
  for (const auto& [id, cell] : cells) {
    append(bytes, static_cast<std::size_t>(id - before));
    append(bytes, static_cast<std::size_t>(cell.mother + 1));
    append(bytes, static_cast<std::size_t>(cell.course.first));
    append(bytes, cell.course.x.size());
    append_signed(bytes, cell.birth_step - cell.course.first);
    before = id;
  }
  return bytes;
}

std::string packed_signals(const std::map<int, CellLife>& cells) {
  std::string bytes;
  for (const auto& [id, cell] : cells) {
    std::string changes;
    std::size_t count = 0, since = 0;
    std::int64_t period = 0, phase = 0;
    for (std::size_t k = 0; k < cell.period.size(); ++k) {
      const std::int64_t p = std::llround(cell.period[k] / period_step);
      const std::int64_t h = std::llround(cell.phase[k] / phase_step);
      if (k > 0 && p == period && h == phase) continue;
      append(changes, k - since);
      append_signed(changes, p - period);
      append_signed(changes, h - phase);
      since = k;
      period = p;
      phase = h;
      ++count;
    }
    append(bytes, count);
    bytes += changes;
  }
  return bytes;
}

/// The links of an embryo as ids, ascending.
std::vector<std::pair<int, int>> links_of(const core::Embryo& embryo) {
  std::vector<std::pair<int, int>> links;
  for (const auto& [i, j] : embryo.links) {
    links.emplace_back(embryo.id[static_cast<std::size_t>(i)],
                       embryo.id[static_cast<std::size_t>(j)]);
  }
  std::sort(links.begin(), links.end());
  return links;
}

std::string packed_links(std::span<const core::Embryo> embryos,
                         const std::map<int, CellLife>& cells) {
  std::map<int, int> position;  // of an id in the list of cells
  for (const auto& [id, cell] : cells) position.emplace(id, static_cast<int>(position.size()));
  std::vector<std::array<int, 4>> spans;  // cells, first frame, number of frames
  std::map<std::pair<int, int>, int> open;
  std::vector<std::pair<int, int>> before;
  const auto close = [&](const std::pair<int, int>& link, int frame) {
    const int first = open.extract(link).mapped();
    spans.push_back({position[link.first], position[link.second], first, frame - first});
  };
  for (std::size_t f = 0; f <= embryos.size(); ++f) {
    const int frame = static_cast<int>(f);
    std::vector<std::pair<int, int>> now;
    if (f < embryos.size()) now = links_of(embryos[f]);
    std::vector<std::pair<int, int>> gone, come;
    std::set_difference(before.begin(), before.end(), now.begin(), now.end(),
                        std::back_inserter(gone));
    std::set_difference(now.begin(), now.end(), before.begin(), before.end(),
                        std::back_inserter(come));
    for (const auto& link : gone) close(link, frame);
    for (const auto& link : come) open.emplace(link, frame);
    before = std::move(now);
  }
  std::sort(spans.begin(), spans.end());
  std::string bytes;
  append(bytes, spans.size());
  int first = 0;
  for (const auto& [i, j, frame, frames] : spans) {
    append(bytes, static_cast<std::size_t>(i - first));
    append(bytes, static_cast<std::size_t>(j - i));
    append(bytes, static_cast<std::size_t>(frame));
    append(bytes, static_cast<std::size_t>(frames));
    first = i;
  }
  return bytes;
}

}  // namespace

PackedDevelopment pack(std::span<const core::Embryo> embryos) {
  const std::map<int, CellLife> cells = cells_of(embryos);
  std::vector<Course> courses;
  for (const auto& [id, cell] : cells) courses.push_back(cell.course);
  return {static_cast<int>(embryos.size()), deflated(packed_cells(cells)),
          deflated(packed_links(embryos, cells)), deflated(packed_signals(cells)), pack(courses)};
}

}  // namespace metamorph::evolve
