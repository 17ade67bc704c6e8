#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <span>
#include <type_traits>
#include <vector>

#include "core/development/colony.h"
#include "core/development/control.h"
#include "core/development/link_check.h"
#include "core/development/neighbourhood.h"
#include "kernels/cell_mechanics.h"
#include "kernels/cell_space.h"
#include "metamorph/development.h"

namespace metamorph::core {

/// In (-pi, pi]; for the record only, nothing in development depends on it.
inline double angle_of(double x, double y) {
  const double angle = std::atan2(y, x);
  return angle > -std::numbers::pi ? angle : std::numbers::pi;
}

/// The networks that control one embryo: from step switches[k] on it is networks[k + 1].
struct Controls {
  std::span<const Network> networks;  ///< [switches + 1]
  std::span<const int> switches;      ///< ascending
};

/// Develops one embryo after the other, in arrays that it keeps. T is the precision of the cells'
/// state and of the network; triangulations are exact in either.
template <class T>
class Developer {
 public:
  explicit Developer(const DevelopmentRules& rules)
      : rules_(rules),
        mechanics_{static_cast<T>(rules.step), static_cast<T>(rules.stiffness),
                   static_cast<T>(rules.damping), static_cast<T>(rules.drag)},
        colony_(rules.max_cells),
        control_(rules_),
        neighbourhood_(sizeof(kernels::NodeRecord<T>)),
        stage_neighbourhood_(sizeof(kernels::NodeRecord<T>)),
        next_x_(colony_.cell.size()),
        next_y_(colony_.cell.size()),
        willing_(colony_.cell.size()) {}

  /// check: what is to see every renewal, or nullptr.
  std::vector<Embryo> operator()(const Controls& controls, std::span<const int> stages,
                                 LinkCheck* check = nullptr) {
    check_ = check;
    controls_ = controls;
    current_ = 0;
    control_.set_network(controls_.networks.front());
    colony_.reset();
    neighbourhood_.clear();
    previous_.clear();
    status_ = Status::ok;
    std::vector<Embryo> result;
    result.reserve(stages.size());
    for (int step = 0;; ++step) {
      while (result.size() < stages.size() && step == stages[result.size()]) {
        result.push_back(embryo(step));
      }
      if (result.size() == stages.size()) break;
      if (colony_.count == 0) continue;
      if (step % rules_.renew_interval == 0) renew(step, neighbourhood_);
      if (step % rules_.update_interval == 0 && update(step)) renew(step, neighbourhood_);
      move();
    }
    return result;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  void renew(int step, Neighbourhood& neighbourhood) {
    x_.resize(at(colony_.count));
    y_.resize(at(colony_.count));
    bool finite = true;
    for (int i = 0; i < colony_.count; ++i) {
      x_[at(i)] = static_cast<double>(colony_.cell[at(i)].x);
      y_[at(i)] = static_cast<double>(colony_.cell[at(i)].y);
      finite = finite && std::isfinite(x_[at(i)]) && std::isfinite(y_[at(i)]);
    }
    if (!finite) {
      status_ = Status::bad_development;
      colony_.count = 0;
      x_.clear();
      y_.clear();
    }
    previous_.resize(at(colony_.count), -1);
    neighbourhood.renew(x_, y_, previous_, rules_.link_limit);
    std::iota(previous_.begin(), previous_.end(), 0);
    if (check_ != nullptr) {
      check_->compare(step, x_, y_, rules_.link_limit, neighbourhood.links());
    }
  }

  /// Sets the network of the stage of life that goes on at this step.
  void choose_network(int step) {
    const std::size_t before = current_;
    while (current_ < controls_.switches.size() && controls_.switches[current_] <= step) {
      ++current_;
    }
    if (current_ != before) control_.set_network(controls_.networks[current_]);
  }

  /// One update of the control network. True if cells were born or died.
  bool update(int step) {
    choose_network(step);
    control_.evaluate(step, colony_, neighbourhood_);
    for (int i = 0; i < colony_.count; ++i) {
      turned_heading(colony_, neighbourhood_, i, control_(Output::angle, i), next_x_[at(i)],
                     next_y_[at(i)]);
      willing_[at(i)] = control_(Output::inhibit, i) <= T(0);
    }
    for (int i = 0; i < colony_.count; ++i) {
      colony_.morphogen1[at(i)] = control_(Output::morphogen_1, i);
      colony_.morphogen2[at(i)] = control_(Output::morphogen_2, i);
    }
    bool changed = colony_.remove_if([&](int i) { return control_(Output::die, i) > T(0); },
                                     [&](int from, int to) {
                                       next_x_[at(to)] = next_x_[at(from)];
                                       next_y_[at(to)] = next_y_[at(from)];
                                       willing_[at(to)] = willing_[at(from)];
                                       previous_[at(to)] = from;
                                     });
    const int mothers = colony_.count;
    previous_.resize(at(mothers));
    for (int i = 0; i < mothers; ++i) {
      if (!willing_[at(i)]) continue;
      colony_.heading_x[at(i)] = next_x_[at(i)];
      colony_.heading_y[at(i)] = next_y_[at(i)];
    }
    // After deaths the lists of neighbours speak of other numbers.
    const auto asked = [&, died = changed](int i) {
      return died ? NeighbourTable::List() : neighbourhood_.of(i);
    };
    for (int i = 0; i < mothers && colony_.count < rules_.max_cells; ++i) {
      if (willing_[at(i)] && divide(i, step, asked(i))) changed = true;
    }
    return changed;
  }

  /// Puts a daughter 1 d from the mother in her direction, if there is space. neighbours: cells to
  /// ask first, who mostly are the ones in the way.
  bool divide(int mother, int step, NeighbourTable::List neighbours) {
    const auto& cell = colony_.cell[at(mother)];
    const T x = cell.x + colony_.heading_x[at(mother)];
    const T y = cell.y + colony_.heading_y[at(mother)];
    const T space = static_cast<T>(rules_.division_space);
    for (const int i : neighbours) {
      const T dx = colony_.cell[at(i)].x - x, dy = colony_.cell[at(i)].y - y;
      if (dx * dx + dy * dy <= space * space) return false;
    }
    if (kernels::is_space_taken(colony_.cell.data(), colony_.count, x, y, space, mother)) {
      return false;
    }
    colony_.add({x, y, cell.vx, cell.vy}, colony_.heading_x[at(mother)],
                colony_.heading_y[at(mother)], colony_.morphogen1[at(mother)],
                colony_.morphogen2[at(mother)], colony_.id[at(mother)], step);
    return true;
  }

  void move() {
    kernels::step_cells(mechanics_, neighbourhood_.rings(), colony_.cell.data(),
                        colony_.next_cell.data());
    colony_.cell.swap(colony_.next_cell);
  }

  Embryo embryo(int step) {
    // Between two renewals development goes on with the neighbours of the earlier one.
    const bool renewal_due = step % rules_.renew_interval == 0;
    if (!renewal_due) stage_neighbourhood_ = neighbourhood_;
    Neighbourhood& neighbourhood = renewal_due ? neighbourhood_ : stage_neighbourhood_;
    renew(step, neighbourhood);
    choose_network(step - 1);  // of the life that ends here, if one does
    control_.evaluate(step, colony_, neighbourhood);
    Embryo embryo;
    embryo.step = step;
    embryo.status = colony_.count == 0 && status_ == Status::ok ? Status::empty : status_;
    embryo.created = colony_.created;
    embryo.died = colony_.died;
    const auto first = [&](const auto& values) {
      using Values = std::remove_cvref_t<decltype(values)>;
      return Values(values.begin(), values.begin() + colony_.count);
    };
    embryo.id = first(colony_.id);
    embryo.mother = first(colony_.mother);
    embryo.birth_step = first(colony_.birth_step);
    embryo.x = x_;
    embryo.y = y_;
    for (int i = 0; i < colony_.count; ++i) {
      embryo.orientation.push_back(angle_of(colony_.heading_x[at(i)], colony_.heading_y[at(i)]));
      const double share =
          std::clamp(static_cast<double>(control_(Output::period, i)) + 0.5, 0.0, 1.0);
      embryo.period.push_back(rules_.period_min + share * (rules_.period_max - rules_.period_min));
      embryo.phase.push_back(std::numbers::pi * static_cast<double>(control_(Output::phase, i)));
    }
    embryo.links = neighbourhood.links();
    embryo.faces = neighbourhood.faces();
    return all_finite(embryo) ? embryo : without_cells(embryo);
  }

  static bool all_finite(const Embryo& embryo) {
    const auto finite = [](const std::vector<double>& values) {
      return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    };
    return finite(embryo.orientation) && finite(embryo.period) && finite(embryo.phase);
  }

  /// Its positions are numbers still, its network's outputs are not.
  static Embryo without_cells(const Embryo& embryo) {
    Embryo failed;
    failed.step = embryo.step;
    failed.status = Status::bad_development;
    failed.created = embryo.created;
    failed.died = embryo.died;
    return failed;
  }

  DevelopmentRules rules_;
  kernels::CellMechanics<T> mechanics_;
  Colony<T> colony_;
  Control<T> control_;
  Neighbourhood neighbourhood_, stage_neighbourhood_;
  LinkCheck* check_ = nullptr;
  Controls controls_;        // borrowed during a call
  std::size_t current_ = 0;  // of its networks
  Status status_ = Status::ok;
  std::vector<T> next_x_, next_y_;  // headings after the update, if willing
  std::vector<char> willing_;       // not inhibited
  std::vector<double> x_, y_;       // positions at the last renewal
  std::vector<Index> previous_;     // which cell each was at the last renewal, -1 if none
};

}  // namespace metamorph::core
