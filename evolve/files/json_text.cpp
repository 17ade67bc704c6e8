#include "evolve/files/json_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

namespace metamorph::evolve::detail {
namespace {

constexpr int deepest = 16;          ///< levels; our formats need six
constexpr std::size_t longest = 60;  ///< characters of a list that is shown whole

/// "line 3, column 7" of a byte, counted from 1.
std::string place(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(text.size(), byte > 0 ? byte - 1 : 0));
  const auto lines = std::count(before.begin(), before.end(), '\n');
  const std::size_t start = before.rfind('\n') == before.npos ? 0 : before.rfind('\n') + 1;
  return std::string("line ")
      .append(std::to_string(lines + 1))
      .append(", column ")
      .append(std::to_string(before.size() - start + 1));
}

[[noreturn]] void refuse(const std::string& source, std::string_view key, std::string_view value,
                         std::string_view expected) {
  FaultList faults(source);
  faults.add(key, value, expected);
  throw InputError(faults.lines());
}

/// Watches a parse for what the grammar allows and we do not: repeated keys, deep nesting.
class Watch {
 public:
  explicit Watch(std::string source) : source_(std::move(source)) {}

  bool operator()(int depth, Json::parse_event_t event, const Json& value) {
    if (depth > deepest) refuse(source_, "", "deeply nested JSON", "at most 16 levels");
    const auto level = static_cast<std::size_t>(depth);
    if (event == Json::parse_event_t::object_start) {
      keys_.resize(std::max(keys_.size(), level + 2));
      keys_[level + 1].clear();
    } else if (event == Json::parse_event_t::key) {
      const auto& name = value.get_ref<const std::string&>();
      if (!keys_[level].insert(name).second) refuse(source_, name, "given twice", "it once");
    }
    return true;
  }

 private:
  std::string source_;
  std::vector<std::set<std::string>> keys_;  ///< of the open object at every level
};

}  // namespace

Json parse_object(std::string_view text, const std::string& source) {
  Json object;
  try {
    object = Json::parse(text.begin(), text.end(), Watch(source));
  } catch (const Json::parse_error& error) {
    const std::size_t byte = error.byte;
    const bool ended = byte == 0 || byte > text.size();
    std::string value = "the file ends";
    if (!ended) value = {'\'', text[byte - 1], '\''};
    refuse(source, place(text, ended ? text.size() + 1 : byte), value,
           ended ? "more JSON" : "valid JSON");
  } catch (const Json::out_of_range& error) {
    // "... number overflow parsing '1e999'"
    const std::string_view what = error.what();
    const std::size_t open = what.find('\'');
    const std::size_t close = what.rfind('\'');
    refuse(source, "", open < close ? what.substr(open + 1, close - open - 1) : what,
           "a finite number");
  }
  if (!object.is_object()) refuse(source, "", shown(object), "a JSON object");
  return object;
}

void check_format(const Json& object, std::string_view format, FaultList& faults) {
  const std::string expected = std::string("\"").append(format).append("\"");
  const auto tag = object.find("format");
  if (tag == object.end()) {
    faults.add("format", "missing", expected);
  } else if (!tag->is_string() || tag->get_ref<const std::string&>() != format) {
    refuse(faults.source(), "format", shown(*tag), expected);
  }
}

std::string shown(const Json& value) {
  if (value.is_object()) return "an object";
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (value.is_array() && text.size() > longest) {
    return std::string("an array of ").append(std::to_string(value.size()));
  }
  return text;
}

std::string Members::key_of(const std::string& name) const {
  return key_.empty() ? name : key_ + "." + name;
}

const Json* Members::optional(const std::string& name) {
  known_.push_back(name);
  const auto found = object_.find(name);
  return found == object_.end() ? nullptr : &*found;
}

const Json* Members::required(const std::string& name, std::string_view expected) {
  const Json* member = optional(name);
  if (member == nullptr) faults_.add(key_of(name), "missing", expected);
  return member;
}

void Members::no_others() {
  for (const auto& item : object_.items()) {
    if (std::find(known_.begin(), known_.end(), item.key()) != known_.end()) continue;
    std::string names;
    for (const std::string& name : known_) names.append(names.empty() ? "" : ", ").append(name);
    faults_.add(key_of(item.key()), "unknown key", names.insert(0, "one of "));
  }
}

std::optional<double> as_number(const Json& value, const std::string& key, FaultList& faults,
                                double low, double high) {
  if (value.is_number()) {
    const double number = value.get<double>();
    if (number >= low && number <= high) return number;
  }
  std::string expected = "a number";
  if (low != std::numeric_limits<double>::lowest()) {
    expected += " from ";
    append_number(expected, low);
    expected += " to ";
    append_number(expected, high);
  }
  faults.add(key, shown(value), expected);
  return std::nullopt;
}

std::optional<int> as_integer(const Json& value, const std::string& key, FaultList& faults, int low,
                              int high) {
  if (value.is_number_unsigned()) {
    const auto number = value.get<std::uint64_t>();
    if (number <= static_cast<std::uint64_t>(std::max(high, 0)) &&
        static_cast<std::int64_t>(number) >= low) {
      return static_cast<int>(number);
    }
  } else if (value.is_number_integer()) {
    const auto number = value.get<std::int64_t>();
    if (number >= low && number <= high) return static_cast<int>(number);
  }
  faults.add(key, shown(value),
             std::string("an integer from ")
                 .append(std::to_string(low))
                 .append(" to ")
                 .append(std::to_string(high)));
  return std::nullopt;
}

const Json::array_t* as_array(const Json& value, const std::string& key, std::string_view expected,
                              FaultList& faults) {
  if (value.is_array()) return value.get_ptr<const Json::array_t*>();
  faults.add(key, shown(value), expected);
  return nullptr;
}

std::string element_key(std::string_view key, std::size_t index) {
  return std::string(key).append("[").append(std::to_string(index)).append("]");
}

void append_number(std::string& text, double value) {
  char buffer[32];
  const char* end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  text.append(std::string_view(buffer, end));
  if (value == 0 && std::signbit(value)) text += ".0";  // a reader takes "-0" for an integer
}

}  // namespace metamorph::evolve::detail
