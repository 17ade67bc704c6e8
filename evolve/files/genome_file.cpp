#include "evolve/files/genome_file.h"

#include <algorithm>
#include <array>
#include <optional>

#include "evolve/files/input_file.h"
#include "evolve/files/json_text.h"

namespace metamorph::evolve {
namespace {

using namespace detail;

constexpr std::array<std::string_view, 3> kind_names = {"input", "output", "hidden"};

std::string_view kind_name(NodeKind kind) { return kind_names[static_cast<std::size_t>(kind)]; }

std::optional<NodeKind> as_kind(const Json& value, const std::string& key, FaultList& faults) {
  for (const NodeKind kind : {NodeKind::input, NodeKind::output, NodeKind::hidden}) {
    if (value.is_string() && value.get_ref<const std::string&>() == kind_name(kind)) return kind;
  }
  faults.add(key, shown(value), "\"input\", \"output\" or \"hidden\"");
  return std::nullopt;
}

/// Calls read(members) for every object of an array; every other element is a fault.
template <class Read>
void read_objects(const Json* value, const std::string& key, const std::string& expected,
                  FaultList& faults, Read read) {
  if (value == nullptr) return;
  const Json::array_t* items = as_array(*value, key, "an array of " + expected, faults);
  if (items == nullptr) return;
  for (std::size_t i = 0; i < items->size(); ++i) {
    const Json& item = (*items)[i];
    if (!item.is_object()) {
      faults.add(element_key(key, i), shown(item), expected);
      continue;
    }
    Members members(item, element_key(key, i), faults);
    read(members);
    members.no_others();
  }
}

int integer_of(Members& members, const std::string& name, int low, FaultList& faults) {
  const Json* value = members.required(name, "an integer >= " + std::to_string(low));
  return value == nullptr ? 0 : as_integer(*value, members.key_of(name), faults, low).value_or(0);
}

int node_of(Members& members, const std::string& name, FaultList& faults) {
  return integer_of(members, name, least_id, faults);
}

NodeGene read_node(Members& members, FaultList& faults) {
  NodeGene node;
  node.id = node_of(members, "id", faults);
  if (const Json* kind = members.required("kind", "\"input\", \"output\" or \"hidden\"")) {
    node.kind = as_kind(*kind, members.key_of("kind"), faults).value_or(NodeKind::hidden);
  }
  return node;
}

LinkGene read_link(Members& members, FaultList& faults) {
  LinkGene link;
  link.innovation = integer_of(members, "innovation", 0, faults);
  link.from = node_of(members, "from", faults);
  link.to = node_of(members, "to", faults);
  if (const Json* weight = members.required("weight", "a number")) {
    link.weight =
        as_number(*weight, members.key_of("weight"), faults, -largest_weight, largest_weight)
            .value_or(0);
  }
  const auto stage_of = [&](const char* name, int& stage) {
    const Json* value = members.optional(name);
    if (value == nullptr) return;
    stage = as_integer(*value, members.key_of(name), faults, 0).value_or(stage);
  };
  stage_of("first_stage", link.stages.first);
  stage_of("last_stage", link.stages.last);
  return link;
}

}  // namespace

Genome parse_genome(std::string_view text, const std::string& source) {
  const Json object = parse_object(text, source);
  FaultList faults(source);
  check_format(object, genome_format, faults);
  Members members(object, "", faults);
  members.optional("format");
  const std::string node_keys = "{\"id\", \"kind\"}";
  const std::string link_keys = "{\"innovation\", \"from\", \"to\", \"weight\"}";
  const Json* nodes = members.required("nodes", "an array of " + node_keys);
  const Json* links = members.required("links", "an array of " + link_keys);
  members.no_others();

  Genome genome;
  read_objects(nodes, "nodes", node_keys, faults,
               [&](Members& node) { genome.nodes.push_back(read_node(node, faults)); });
  read_objects(links, "links", link_keys, faults,
               [&](Members& link) { genome.links.push_back(read_link(link, faults)); });
  faults.throw_if_any();  // what follows would judge values that were never read

  std::sort(genome.nodes.begin(), genome.nodes.end(),
            [](const NodeGene& a, const NodeGene& b) { return a.id < b.id; });
  std::sort(genome.links.begin(), genome.links.end(),
            [](const LinkGene& a, const LinkGene& b) { return a.innovation < b.innovation; });
  for (const std::string& fault : check(genome)) faults.add_line(fault);
  faults.throw_if_any();
  return genome;
}

Genome read_genome(const std::filesystem::path& file) {
  return parse_genome(read_text(file), file.string());
}

Genome read_genome(const std::filesystem::path& file, const core::DevelopmentRules& rules) {
  Genome genome = read_genome(file);
  check_fits(genome, rules, file.string());
  return genome;
}

void check_fits(const Genome& genome, const core::DevelopmentRules& rules,
                const std::string& source) {
  FaultList faults(source);
  for (const std::string& line : misfits(genome, shape_of(rules))) faults.add_line(line);
  faults.throw_if_any();
}

std::string genome_text(const Genome& genome) {
  std::string text = "{\n  \"format\": \"";
  text.append(genome_format).append("\",\n  \"nodes\": ");
  append_lines(text, genome.nodes, 2, [](std::string& out, const NodeGene& node) {
    out.append("{\"id\": ").append(std::to_string(node.id));
    out.append(", \"kind\": \"").append(kind_name(node.kind)).append("\"}");
  });
  text.append(",\n  \"links\": ");
  append_lines(text, genome.links, 2, [](std::string& out, const LinkGene& link) {
    out.append("{\"innovation\": ").append(std::to_string(link.innovation));
    out.append(", \"from\": ").append(std::to_string(link.from));
    out.append(", \"to\": ").append(std::to_string(link.to)).append(", \"weight\": ");
    append_number(out, link.weight);
    const auto& [first, last] = link.stages;
    if (first > 0) out.append(", \"first_stage\": ").append(std::to_string(first));
    if (last != Stages::end_of_life) {
      out.append(", \"last_stage\": ").append(std::to_string(last));
    }
    out += '}';
  });
  return text.append("\n}\n");
}

void write_genome(const std::filesystem::path& file, const Genome& genome, Overwrite overwrite) {
  write_file(file, genome_text(genome), overwrite);
}

}  // namespace metamorph::evolve
