#include "core/locomotion/rings.h"

#include <algorithm>

namespace metamorph::core {
namespace {

struct Corner {
  Index next, after;  ///< the triangle's other nodes, counter-clockwise
  Index triangle;
};

/// Lists grouped by node, in one array.
template <class T>
struct Grouped {
  std::vector<int> begin;
  std::vector<T> items;
};

template <class T, class Each>
Grouped<T> group_by_node(Index nodes, Each&& each) {
  Grouped<T> grouped;
  grouped.begin.assign(static_cast<std::size_t>(nodes) + 1, 0);
  each([&](Index node, const T&) { ++grouped.begin[static_cast<std::size_t>(node) + 1]; });
  for (std::size_t i = 1; i < grouped.begin.size(); ++i) grouped.begin[i] += grouped.begin[i - 1];
  grouped.items.resize(static_cast<std::size_t>(grouped.begin.back()));
  std::vector<int> next(grouped.begin.begin(), grouped.begin.end() - 1);
  each([&](Index node, const T& item) {
    grouped.items[static_cast<std::size_t>(next[static_cast<std::size_t>(node)]++)] = item;
  });
  return grouped;
}

struct SpringEnd {
  Index other, spring;
};

}  // namespace

Rings make_rings(const Body& body) {
  const Index nodes = body.node_count();
  const auto corners = group_by_node<Corner>(nodes, [&](auto&& put) {
    for (std::size_t t = 0; t < body.triangles.size(); ++t) {
      const auto& [a, b, c] = body.triangles[t];
      const auto index = static_cast<Index>(t);
      put(a, Corner{b, c, index});
      put(b, Corner{c, a, index});
      put(c, Corner{a, b, index});
    }
  });
  const auto ends = group_by_node<SpringEnd>(nodes, [&](auto&& put) {
    for (std::size_t s = 0; s < body.springs.size(); ++s) {
      const auto& [a, b] = body.springs[s];
      put(a, SpringEnd{b, static_cast<Index>(s)});
      put(b, SpringEnd{a, static_cast<Index>(s)});
    }
  });

  Rings rings;
  rings.begin.push_back(0);
  rings.edge_begin.push_back(0);
  std::vector<Corner> fan;
  for (Index node = 0; node < nodes; ++node) {
    const auto at = static_cast<std::size_t>(node);
    fan.assign(corners.items.begin() + corners.begin[at],
               corners.items.begin() + corners.begin[at + 1]);
    std::sort(fan.begin(), fan.end(),
              [](const Corner& a, const Corner& b) { return a.next < b.next; });
    const auto spring_to = [&](Index other) {
      // Springs ascend, hence so do their other ends.
      return std::lower_bound(ends.items.begin() + ends.begin[at],
                              ends.items.begin() + ends.begin[at + 1], other,
                              [](const SpringEnd& end, Index value) { return end.other < value; })
          ->spring;
    };

    rings.closing.push_back(-1);
    while (!fan.empty()) {
      // An open fan starts at a neighbour that no triangle of this node ends at; if there is none,
      // the ring is closed.
      auto start = std::find_if(fan.begin(), fan.end(), [&](const Corner& corner) {
        return std::none_of(fan.begin(), fan.end(),
                            [&](const Corner& other) { return other.after == corner.next; });
      });
      const bool open = start != fan.end();
      if (!open) start = fan.begin();
      const Index first = start->next;
      rings.slots.push_back({first, spring_to(first), -1});
      if (open) rings.edge_other.push_back(first);
      Index last = first;
      for (auto corner = start; corner != fan.end();
           corner = std::find_if(fan.begin(), fan.end(),
                                 [&](const Corner& other) { return other.next == last; })) {
        const Index triangle = corner->triangle, after = corner->after;
        fan.erase(corner);
        if (after == first) {
          rings.closing.back() = triangle;
          break;
        }
        rings.slots.push_back({after, spring_to(after), triangle});
        last = after;
      }
      if (open) rings.edge_other.push_back(last);
    }
    rings.begin.push_back(static_cast<int>(rings.slots.size()));
    rings.edge_begin.push_back(static_cast<int>(rings.edge_other.size()));
  }
  return rings;
}

}  // namespace metamorph::core
