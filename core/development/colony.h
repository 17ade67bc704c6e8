#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/body/aligned.h"
#include "kernels/cell_mechanics.h"
#include "kernels/node_record.h"
#include "metamorph/body.h"

namespace metamorph::core {

/// The cells of one developing embryo, in order of age (id ascending). Arrays are padded to whole
/// lane groups; what lies in the padding is finite and linked to nobody.
template <class T>
struct Colony {
  int count = 0;
  int created = 0;
  int died = 0;
  Aligned<kernels::NodeRecord<T>> cell, next_cell;  ///< now, and room for the next step
  std::vector<T> heading_x, heading_y;              ///< orientation as a unit vector
  std::vector<T> morphogen1, morphogen2;
  std::vector<int> id, mother, birth_step;

  explicit Colony(int capacity) {
    constexpr int lanes = kernels::cell_lanes;
    const auto padded = static_cast<std::size_t>((capacity + lanes - 1) / lanes * lanes);
    cell.resize(padded);
    next_cell.resize(padded);
    for (auto* values : {&heading_x, &heading_y, &morphogen1, &morphogen2}) values->resize(padded);
    for (auto* values : {&id, &mother, &birth_step}) values->resize(padded);
  }

  /// Back to the founder alone, at the origin, looking along +x.
  void reset() {
    std::fill(cell.begin(), cell.end(), kernels::NodeRecord<T>{});
    std::fill(next_cell.begin(), next_cell.end(), kernels::NodeRecord<T>{});
    count = created = died = 0;
    add({}, T(1), T(0), T(0), T(0), -1, 0);
  }

  void add(const kernels::NodeRecord<T>& record, T x_heading, T y_heading, T first, T second,
           int mother_id, int step) {
    const auto i = at(count++);
    cell[i] = record;
    heading_x[i] = x_heading;
    heading_y[i] = y_heading;
    morphogen1[i] = first;
    morphogen2[i] = second;
    id[i] = created++;
    mother[i] = mother_id;
    birth_step[i] = step;
  }

  /// Removes the cells for which dies(i) holds and tells `moved(from, to)` of each that stays.
  template <class Dies, class Moved>
  bool remove_if(const Dies& dies, const Moved& moved) {
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      if (dies(i)) continue;
      const auto from = at(i), to = at(kept);
      cell[to] = cell[from];
      for (auto* values : {&heading_x, &heading_y, &morphogen1, &morphogen2}) {
        (*values)[to] = (*values)[from];
      }
      for (auto* values : {&id, &mother, &birth_step}) (*values)[to] = (*values)[from];
      moved(i, kept);
      ++kept;
    }
    const bool any = kept < count;
    for (int i = kept; i < count; ++i) cell[at(i)] = {};
    died += count - kept;
    count = kept;
    return any;
  }

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
};

}  // namespace metamorph::core
