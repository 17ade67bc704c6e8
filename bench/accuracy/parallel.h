#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace metamorph::bench {

/// text(i) for all i < count, on all threads, in order of i.
template <class Text>
std::vector<std::string> in_parallel(std::size_t count, Text&& text) {
  std::vector<std::string> rows(count);
  const auto last = static_cast<std::ptrdiff_t>(count);
#pragma omp parallel for schedule(dynamic)
  for (std::ptrdiff_t i = 0; i < last; ++i)
    rows[static_cast<std::size_t>(i)] = text(static_cast<std::size_t>(i));
  return rows;
}

}  // namespace metamorph::bench
