#pragma once

#include <cstddef>
#include <tuple>
#include <utility>

#include "core/body/aligned.h"

namespace metamorph::core {

/// One field of an entry, and the pointer by which a view finds its array.
template <class Entry, class Value, class View>
struct Column {
  Value Entry::* field;
  const Value* View::* array;
};

/// Entries as a structure of arrays: one array per column of the list `Entry::columns`, a tuple.
template <class Entry>
class Columns {
 public:
  /// `count` entries, each as Entry{} is.
  void assign(std::size_t count) {
    zip(arrays_,
        [&](const auto& column, auto& array) { array.assign(count, Entry{}.*column.field); });
  }

  void put(std::size_t place, const Entry& entry) {
    zip(arrays_, [&](const auto& column, auto& array) { array[place] = entry.*column.field; });
  }

  /// Sets the pointers of `view` to the entries from `place` on.
  template <class View>
  void show(std::size_t place, View& view) const {
    zip(arrays_,
        [&](const auto& column, const auto& array) { view.*column.array = array.data() + place; });
  }

 private:
  template <class View, class... Values>
  static std::tuple<Aligned<Values>...> arrays_of(
      const std::tuple<Column<Entry, Values, View>...>&);
  using Arrays = decltype(arrays_of(Entry::columns));

  template <class Pairs, class Function>
  static void zip(Pairs& arrays, Function&& function) {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (function(std::get<i>(Entry::columns), std::get<i>(arrays)), ...);
    }(std::make_index_sequence<std::tuple_size_v<Arrays>>{});
  }

  Arrays arrays_;
};

}  // namespace metamorph::core
