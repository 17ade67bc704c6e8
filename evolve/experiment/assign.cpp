#include "evolve/experiment/assign.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <vector>

namespace metamorph::evolve {
namespace {

/// Reads a list of names. What is wrong with one of them is left in `fault`.
bool assign_names(const NameList& list, const toml::node& node, std::string& fault) {
  const toml::array* items = node.as_array();
  if (items == nullptr || items->empty()) return false;
  std::vector<std::size_t> chosen;
  for (const toml::node& item : *items) {
    const auto name = item.value_exact<std::string>();
    if (!name) return false;
    const auto found = std::find(list.names.begin(), list.names.end(), *name);
    if (found == list.names.end()) {
      fault = fmt::format("\"{}\" is unknown", *name);
      return false;
    }
    const auto at = static_cast<std::size_t>(found - list.names.begin());
    if (std::find(chosen.begin(), chosen.end(), at) != chosen.end()) {
      fault = fmt::format("\"{}\" stands twice", *name);
      return false;
    }
    chosen.push_back(at);
  }
  if (list.needed < list.names.size() &&
      std::find(chosen.begin(), chosen.end(), list.needed) == chosen.end()) {
    fault = fmt::format("\"{}\" is missing", list.names[list.needed]);
    return false;
  }
  list.set(chosen);
  return true;
}

}  // namespace

bool is_name(std::string_view text) {
  return !text.empty() && text.front() != '.' && text.size() <= 100 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) {
           return std::isalnum(c) || c == '-' || c == '_' || c == '.';
         });
}

bool assign(const Key& key, const toml::node& node, std::string& fault) {
  struct Visitor {
    const Key& key;
    const toml::node& node;
    std::string& fault;
    bool in_range(double value) const { return value >= key.low && value <= key.high; }
    bool operator()(int* field) const {
      const auto value = node.value_exact<std::int64_t>();
      if (!value || !in_range(static_cast<double>(*value))) return false;
      *field = static_cast<int>(*value);
      return true;
    }
    bool operator()(std::uint64_t* field) const {
      // As integers: 2^53 + 1 as a double is 2^53.
      const auto value = node.value_exact<std::int64_t>();
      if (!value || *value < static_cast<std::int64_t>(key.low) ||
          *value > static_cast<std::int64_t>(key.high)) {
        return false;
      }
      *field = static_cast<std::uint64_t>(*value);
      return true;
    }
    bool operator()(double* field) const {
      if (!node.is_number()) return false;
      const double value = *node.value<double>();
      if (!std::isfinite(value) || !in_range(value)) return false;
      *field = value;
      return true;
    }
    bool operator()(const Step& step) const {
      if (node.value_exact<std::string>() != "auto") return (*this)(step.value);
      *step.value = core::automatic_step;
      return true;
    }
    bool operator()(bool* field) const {
      if (!node.is_boolean()) return false;
      *field = *node.value<bool>();
      return true;
    }
    bool operator()(std::string* field) const {
      const auto value = node.value_exact<std::string>();
      if (!value || !is_name(*value)) return false;
      *field = *value;
      return true;
    }
    bool operator()(std::vector<double>* field) const {
      const toml::array* items = node.as_array();
      if (items == nullptr) return false;
      std::vector<double> numbers;
      for (const toml::node& item : *items) {
        const double number = item.value<double>().value_or(std::nan(""));
        if (!item.is_number() || !std::isfinite(number) || !in_range(number)) return false;
        numbers.push_back(number);
      }
      *field = std::move(numbers);
      return true;
    }
    bool operator()(std::vector<std::string>* field) const {
      const toml::array* items = node.as_array();
      if (items == nullptr) return false;
      std::vector<std::string> names;
      for (const toml::node& item : *items) {
        const auto name = item.value_exact<std::string>();
        if (!name || !is_name(*name)) return false;
        names.push_back(*name);
      }
      *field = std::move(names);
      return true;
    }
    bool operator()(const Choice& choice) const {
      const auto value = node.value_exact<std::string>();
      if (!value) return false;
      const auto found = std::find(choice.names.begin(), choice.names.end(), *value);
      if (found == choice.names.end()) return false;
      choice.set(static_cast<std::size_t>(found - choice.names.begin()));
      return true;
    }
    bool operator()(const NameList& list) const { return assign_names(list, node, fault); }
  };
  return std::visit(Visitor{key, node, fault}, key.field);
}

std::string shown(const toml::node& node) {
  std::ostringstream text;
  if (const auto* string = node.as_string()) {
    text << '"' << string->get() << '"';
  } else if (node.is_table()) {
    text << "a table";
  } else if (const auto* list = node.as_array(); list != nullptr && list->empty()) {
    text << "an empty list";
  } else if (list != nullptr) {
    text << "a list";
  } else {
    node.visit([&](const auto& value) {
      if constexpr (toml::is_value<decltype(value)>) text << value;
    });
  }
  std::string line = text.str().substr(0, 60);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

}  // namespace metamorph::evolve
