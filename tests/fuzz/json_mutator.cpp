#include "tests/fuzz/json_mutator.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace metamorph::fuzz {
namespace {

using Json = nlohmann::json;

constexpr int deepest = 32;

/// All values of a document; false if it is nested too deep.
bool collect(Json& value, std::vector<Json*>& all, int depth = 0) {
  if (depth > deepest) return false;
  all.push_back(&value);
  if (!value.is_structured()) return true;
  for (Json& element : value) {
    if (!collect(element, all, depth + 1)) return false;
  }
  return true;
}

Json number_near(const Json& value, std::minstd_rand& random) {
  if (value.is_number_integer()) {
    const auto old = value.get<std::int64_t>();
    const std::array<std::int64_t, 8> news = {
        old / 2,
        old < std::numeric_limits<std::int64_t>::max() ? old + 1 : 0,
        old > std::numeric_limits<std::int64_t>::min() ? old - 1 : 0,
        0,
        -1,
        static_cast<std::int64_t>(random() % 32),
        std::numeric_limits<std::int32_t>::max(),
        static_cast<std::int64_t>(random())};
    return news[random() % news.size()];
  }
  const auto old = value.get<double>();
  const double share = static_cast<double>(random()) / static_cast<double>(random.max());
  const std::array news = {-old,
                           old * (1 + 0.01 * share),
                           old + share - 0.5,
                           old * 100 * share,
                           0.0,
                           old * 1e-3,
                           share,
                           1e-308,
                           1e6 * old,
                           std::nextafter(old, 0)};
  return news[random() % news.size()];
}

void change_array(Json& array, std::minstd_rand& random) {
  if (array.empty()) {
    array.push_back(0);
    return;
  }
  const auto at = static_cast<std::ptrdiff_t>(random() % array.size());
  switch (random() % 3) {
    case 0:
      array.erase(array.begin() + at);
      break;
    case 1:
      array.insert(array.begin() + at, Json(array[random() % array.size()]));
      break;
    default:
      std::swap(array[static_cast<std::size_t>(at)], array[random() % array.size()]);
  }
}

void change_object(Json& object, std::minstd_rand& random, const Json& other) {
  if (object.empty()) return;
  auto member = object.begin();
  std::advance(member, static_cast<std::ptrdiff_t>(random() % object.size()));
  if (random() % 2 == 0) {
    object.erase(member);
  } else {
    *member = Json(other);
  }
}

std::string changed_text(std::string text, std::minstd_rand& random) {
  const std::size_t size = text.size();
  text.resize(size + 1 + random() % 16);
  text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), size, text.size()));
  return text;
}

}  // namespace

bool mutate(Json& document, std::minstd_rand& random) {
  std::vector<Json*> all;
  if (!collect(document, all)) return false;
  Json& value = *all[random() % all.size()];
  const Json other = *all[random() % all.size()];
  if (random() % 16 == 0) {
    value = other;
  } else if (value.is_number()) {
    value = number_near(value, random);
  } else if (value.is_array()) {
    change_array(value, random);
  } else if (value.is_object()) {
    change_object(value, random, other);
  } else if (value.is_string()) {
    value = changed_text(value.get<std::string>(), random);
  } else {
    value = other;
  }
  return true;
}

}  // namespace metamorph::fuzz
