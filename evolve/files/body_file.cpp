#include "evolve/files/body_file.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <vector>

#include "evolve/files/input_file.h"
#include "evolve/files/json_text.h"

namespace metamorph::evolve {
namespace {

using core::Body;
using core::Index;
using namespace detail;

/// Reads an array of arrays of n numbers. False (and faults) if its shape is wrong.
template <std::size_t n, class Convert>
bool read_rows(const Json& value, const std::string& key, const std::string& expected,
               FaultList& faults, Convert convert) {
  const Json::array_t* rows = as_array(value, key, "an array of " + expected, faults);
  if (rows == nullptr) return false;
  bool good = true;
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const Json& row = (*rows)[i];
    if (!row.is_array() || row.size() != n || !convert(row)) {
      faults.add(element_key(key, i), shown(row), expected);
      good = false;
    }
  }
  return good;
}

bool read_nodes(const Json& value, Body& body, FaultList& faults) {
  return read_rows<2>(value, "nodes", "[x, y]", faults, [&](const Json& row) {
    if (!row[0].is_number() || !row[1].is_number()) return false;
    body.x.push_back(row[0].get<double>());
    body.y.push_back(row[1].get<double>());
    return true;
  });
}

template <std::size_t n>
bool read_indices(const Json& value, const std::string& key, const std::string& expected,
                  std::vector<std::array<Index, n>>& result, FaultList& faults) {
  return read_rows<n>(value, key, expected, faults, [&](const Json& row) {
    std::array<Index, n> indices;
    FaultList ignored("");
    for (std::size_t k = 0; k < n; ++k) {
      const std::optional<int> index = as_integer(row[k], "", ignored);
      if (!index) return false;
      indices[k] = *index;
    }
    result.push_back(indices);
    return true;
  });
}

/// Reads an array of numbers. One that is no number becomes a fault and 1, so that the rest of the
/// body can still be judged.
/// True if there was an array.
bool read_values(const Json* value, const std::string& key, std::vector<double>& result,
                 FaultList& faults) {
  if (value == nullptr) return false;
  const Json::array_t* values = as_array(*value, key, "an array of numbers", faults);
  if (values == nullptr) return false;
  result.clear();
  for (std::size_t i = 0; i < values->size(); ++i) {
    result.push_back(as_number((*values)[i], element_key(key, i), faults).value_or(1.0));
  }
  return true;
}

/// Brings springs into the order of core::Body, their rest lengths along; leaves springs that are
/// not the triangles' edges as they are, for check() to name.
void order_springs(Body& body, bool with_lengths) {
  std::vector<std::size_t> order(body.springs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (auto& spring : body.springs) {
    if (spring[0] > spring[1]) std::swap(spring[0], spring[1]);
  }
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return body.springs[a] < body.springs[b]; });
  std::vector<std::array<Index, 2>> springs;
  std::vector<double> lengths;
  for (const std::size_t i : order) {
    springs.push_back(body.springs[i]);
    if (with_lengths) lengths.push_back(body.rest_length[i]);
  }
  if (springs != core::edges_of(body.triangles)) return;
  body.springs = std::move(springs);
  if (with_lengths) body.rest_length = std::move(lengths);
}

bool indices_in_range(const Body& body) {
  return std::all_of(body.triangles.begin(), body.triangles.end(), [&](const auto& triangle) {
    return std::all_of(triangle.begin(), triangle.end(),
                       [&](Index node) { return node >= 0 && node < body.node_count(); });
  });
}

Body read(const Json& object, FaultList& faults) {
  check_format(object, body_format, faults);
  Members members(object, "", faults);
  members.optional("format");
  const Json* nodes = members.required("nodes", "an array of [x, y]");
  const Json* triangles = members.required("triangles", "an array of [i, j, k]");
  const Json* springs = members.optional("springs");
  const Json* period = members.required("period", "an array of numbers, one per node");
  const Json* phase = members.required("phase", "an array of numbers, one per node");
  const Json* rest_length = members.optional("rest_length");
  const Json* rest_area = members.optional("rest_area");
  members.no_others();

  Body body;
  bool mesh = nodes != nullptr && read_nodes(*nodes, body, faults);
  mesh = triangles != nullptr &&
         read_indices<3>(*triangles, "triangles", "[i, j, k], three node numbers", body.triangles,
                         faults) &&
         mesh;
  std::vector<std::array<Index, 2>> given_springs;
  if (springs != nullptr) {
    mesh =
        read_indices<2>(*springs, "springs", "[i, j], two node numbers", given_springs, faults) &&
        mesh;
  }
  body.period.assign(body.x.size(), 1);
  body.phase.assign(body.x.size(), 0);
  read_values(period, "period", body.period, faults);
  read_values(phase, "phase", body.phase, faults);
  std::vector<double> given_lengths, given_areas;
  const bool has_lengths = read_values(rest_length, "rest_length", given_lengths, faults);
  const bool has_areas = read_values(rest_area, "rest_area", given_areas, faults);
  if (!mesh) return body;

  // Where triangles name no nodes there are no rest values yet; check() says why.
  const bool in_range = indices_in_range(body);
  if (in_range) core::set_rest_from_nodes(body);
  if (springs != nullptr) body.springs = std::move(given_springs);
  if (has_lengths) body.rest_length = std::move(given_lengths);
  if (has_areas) body.rest_area = std::move(given_areas);
  if (!in_range) {
    body.rest_length.resize(body.springs.size(), 1);
    body.rest_area.resize(body.triangles.size(), 1);
  } else if (springs != nullptr) {
    if (!has_lengths || body.rest_length.size() == body.springs.size()) {
      order_springs(body, has_lengths);
    }
    if (!has_lengths) body.rest_length.resize(body.springs.size(), 1);
  }
  for (const core::BodyFault& fault : core::check(body)) faults.add_line(fault.what);
  return body;
}

}  // namespace

Body parse_body(std::string_view text, const std::string& source) {
  const Json object = parse_object(text, source);
  FaultList faults(source);
  Body body = read(object, faults);
  faults.throw_if_any();
  return body;
}

Body read_body(const std::filesystem::path& file) {
  return parse_body(read_text(file), file.string());
}

std::string body_object(const Body& body, std::size_t indent) {
  const std::string next = ",\n" + std::string(indent + 2, ' ');
  std::string text = "{\n" + std::string(indent + 2, ' ');
  const auto append_indices = [](std::string& out, const auto& indices) {
    append_row(out, indices, [](std::string& row, Index i) { row += std::to_string(i); });
  };
  std::vector<std::array<double, 2>> nodes;
  for (std::size_t i = 0; i < body.x.size(); ++i) nodes.push_back({body.x[i], body.y[i]});

  text.append("\"format\": \"").append(body_format).append("\"");
  text.append(next).append("\"nodes\": ");
  append_lines(text, nodes, indent + 2, [](std::string& out, const std::array<double, 2>& node) {
    append_row(out, node, append_number);
  });
  text.append(next).append("\"triangles\": ");
  append_lines(text, body.triangles, indent + 2, append_indices);
  text.append(next).append("\"springs\": ");
  append_lines(text, body.springs, indent + 2, append_indices);
  text.append(next).append("\"period\": ");
  append_numbers(text, body.period);
  text.append(next).append("\"phase\": ");
  append_numbers(text, body.phase);

  Body derived = body;
  core::set_rest_from_nodes(derived);
  if (body.rest_length != derived.rest_length) {
    text.append(next).append("\"rest_length\": ");
    append_numbers(text, body.rest_length);
  }
  if (body.rest_area != derived.rest_area) {
    text.append(next).append("\"rest_area\": ");
    append_numbers(text, body.rest_area);
  }
  return text.append("\n").append(indent, ' ').append("}");
}

std::string body_text(const Body& body) { return body_object(body, 0) + "\n"; }

void write_body(const std::filesystem::path& file, const Body& body, Overwrite overwrite) {
  write_file(file, body_text(body), overwrite);
}

}  // namespace metamorph::evolve
