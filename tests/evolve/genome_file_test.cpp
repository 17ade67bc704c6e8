#include "evolve/files/genome_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "metamorph/random.h"
#include "tests/evolve/files.h"

namespace metamorph::evolve {
namespace {

using ::testing::ElementsAre;
using ::testing::StartsWith;
using tests::Json;
using tests::lines_of;

std::vector<std::string> faults(const std::string& text) {
  return lines_of([&] { parse_genome(text, "f"); });
}

/// Inputs, outputs and `hidden` hidden nodes; every input to every hidden node to every output.
Genome layered(int hidden, std::uint64_t seed) {
  evolve::RandomStream random(evolve::Purpose::test, seed, 0, 0);
  Genome genome;
  for (int id = 0; id < 13 + hidden; ++id) {
    genome.nodes.push_back(
        {id, id < 6 ? NodeKind::input : (id < 13 ? NodeKind::output : NodeKind::hidden)});
  }
  const auto link = [&](int from, int to) {
    genome.links.push_back(
        {3 * static_cast<int>(genome.links.size()) + 1, from, to, 8 * random.triangular()});
  };
  for (int h = 13; h < 13 + hidden; ++h) {
    for (int i = 0; i < 6; ++i) link(i, h);
    for (int o = 6; o < 13; ++o) link(h, o);
  }
  return genome;
}

Json small() { return Json::parse(genome_text(layered(1, 7))); }

Json with(const std::string& pointer, const Json& value) {
  Json object = small();
  object[Json::json_pointer(pointer)] = value;
  return object;
}

Json without(const std::string& parent, const std::string& key) {
  Json object = small();
  object[Json::json_pointer(parent)].erase(key);
  return object;
}

RC_GTEST_PROP(GenomeFile, WriteReadWriteGivesTheSameBytes, ()) {
  const Genome genome =
      layered(*rc::gen::inRange(0, 9), *rc::gen::inRange<std::uint64_t>(0, 100000));
  const std::string text = genome_text(genome);
  const Genome again = parse_genome(text, "f");
  RC_ASSERT(again == genome);
  RC_ASSERT(genome_text(again) == text);
}

TEST(GenomeFile, HoldsAnInputThatCameLater) {
  Genome genome = layered(1, 7);
  genome.nodes.insert(genome.nodes.begin(), {-1, NodeKind::input});
  genome.links.push_back({1000, -1, 13, 0.25});
  const std::string text = genome_text(genome);
  EXPECT_EQ(parse_genome(text, "f"), genome);
  EXPECT_EQ(genome_text(parse_genome(text, "f")), text);
  EXPECT_THAT(text, ::testing::HasSubstr("{\"id\": -1, \"kind\": \"input\"}"));
  core::DevelopmentRules rules;
  EXPECT_THAT(lines_of([&] { check_fits(genome, rules, "f"); }),
              ElementsAre("f: inputs: time, x, y, morphogen_1, morphogen_2, bias, neighbours: "
                          "expected none but time, x, y, morphogen_1, morphogen_2, bias"));
  rules.inputs.push_back(core::Input::neighbours);
  EXPECT_THAT(lines_of([&] { check_fits(genome, rules, "f"); }), ::testing::IsEmpty());
}

TEST(GenomeFile, OrderInTheFileDoesNotMatter) {
  Json object = small();
  std::reverse(object["nodes"].begin(), object["nodes"].end());
  std::reverse(object["links"].begin(), object["links"].end());
  EXPECT_EQ(parse_genome(object.dump(), "f"), layered(1, 7));
}

TEST(GenomeFile, NamesEveryFaultOfFormAndRange) {
  const std::string nodes = "expected an array of {\"id\", \"kind\"}";
  const std::string links = "expected an array of {\"innovation\", \"from\", \"to\", \"weight\"}";
  const std::string integer = "expected an integer from 0 to 2147483647";
  const std::string node = "expected an integer from -3000 to 2147483647";
  const std::string kinds = "expected \"input\", \"output\" or \"hidden\"";
  const std::string weight = "expected a number from -1000 to 1000";
  const std::vector<std::pair<Json, std::string>> table = {
      {without("", "format"), "format: missing: expected \"metamorph-genome/1\""},
      {with("/format", "metamorph-body/1"),
       "format: \"metamorph-body/1\": expected \"metamorph-genome/1\""},
      {with("/extra", 1), "extra: unknown key: expected one of format, nodes, links"},
      {without("", "nodes"), "nodes: missing: " + nodes},
      {with("/nodes", 3), "nodes: 3: " + nodes},
      {with("/nodes/2", 5), "nodes[2]: 5: expected {\"id\", \"kind\"}"},
      {without("/nodes/2", "id"), "nodes[2].id: missing: expected an integer >= -3000"},
      {with("/nodes/2/id", "two"), "nodes[2].id: \"two\": " + node},
      {with("/nodes/2/id", -3001), "nodes[2].id: -3001: " + node},
      {with("/nodes/2/id", 2.5), "nodes[2].id: 2.5: " + node},
      {with("/nodes/2/id", 4294967296), "nodes[2].id: 4294967296: " + node},
      {without("/nodes/2", "kind"), "nodes[2].kind: missing: " + kinds},
      {with("/nodes/2/kind", "inputs"), "nodes[2].kind: \"inputs\": " + kinds},
      {with("/nodes/2/kind", 1), "nodes[2].kind: 1: " + kinds},
      {with("/nodes/2/name", "x"), "nodes[2].name: unknown key: expected one of id, kind"},
      {without("", "links"), "links: missing: " + links},
      {with("/links", "none"), "links: \"none\": " + links},
      {with("/links/1", Json::array()),
       "links[1]: []: expected {\"innovation\", \"from\", \"to\", \"weight\"}"},
      {without("/links/1", "innovation"), "links[1].innovation: missing: expected an integer >= 0"},
      {without("/links/1", "from"), "links[1].from: missing: expected an integer >= -3000"},
      {without("/links/1", "to"), "links[1].to: missing: expected an integer >= -3000"},
      {without("/links/1", "weight"), "links[1].weight: missing: expected a number"},
      {with("/links/1/innovation", -4), "links[1].innovation: -4: " + integer},
      {with("/links/1/from", "bias"), "links[1].from: \"bias\": " + node},
      {with("/links/1/to", nullptr), "links[1].to: null: " + node},
      {with("/links/1/weight", "w"), "links[1].weight: \"w\": " + weight},
      {with("/links/1/weight", 1e4), "links[1].weight: 10000.0: " + weight},
      {with("/links/1/enabled", true),
       "links[1].enabled: unknown key: expected one of innovation, from, to, weight"},
  };
  for (const auto& [json, line] : table)
    EXPECT_THAT(faults(json.dump()), ElementsAre("f: " + line));
}

TEST(GenomeFile, TellsAllFaultsOfFormAtOnce) {
  Json object = with("/nodes/0/kind", 4);
  object["links"][3]["weight"] = "w";
  object["links"][5].erase("to");
  EXPECT_EQ(faults(object.dump()).size(), 3u);
}

TEST(GenomeFile, RefusesGenomesThatAreUnsound) {
  const std::vector<Json> table = {
      with("/nodes/13/id", 5),           // twice the same node
      with("/nodes/13/kind", "output"),  // kind against id
      with("/links/1/from", 99),         // from nowhere
      with("/links/1/to", 3),            // into an input
      with("/links/1/from", 7),          // out of an output
      with("/links/1/innovation", 1),    // twice the same innovation
      with("/links/1/from", 0),          // twice the same pair
      with("/links/6", {{"innovation", 19}, {"from", 13}, {"to", 13}, {"weight", 1}}),  // a cycle
  };
  for (const Json& json : table) {
    const auto lines = faults(json.dump());
    EXPECT_FALSE(lines.empty()) << json;
    for (const std::string& line : lines) EXPECT_THAT(line, StartsWith("f: "));
  }
  Json object = small();
  object["nodes"].erase(4);  // a link from nowhere
  EXPECT_FALSE(faults(object.dump()).empty());
}

TEST(GenomeFile, CutAnywhereItIsRefusedInOneLine) {
  const std::string text = genome_text(layered(1, 7));
  for (std::size_t size = 0; size + 2 < text.size(); ++size) {
    const auto lines = faults(text.substr(0, size));
    ASSERT_EQ(lines.size(), 1u) << size;
    ASSERT_THAT(lines[0], StartsWith("f: line ")) << size;
  }
}

RC_GTEST_PROP(GenomeFile, DamagedTextIsReadOrRefusedInLines, ()) {
  std::string text = genome_text(layered(1, 7));
  const int damages = *rc::gen::inRange(1, 6);
  for (int i = 0; i < damages; ++i) {
    const auto at = *rc::gen::inRange<std::size_t>(0, text.size());
    if (*rc::gen::arbitrary<bool>()) {
      text[at] = *rc::gen::arbitrary<char>();
    } else {
      text.insert(at, *rc::gen::element<std::string>("-", "9999999999", "[", "}", ",", "\"", "1"));
    }
  }
  try {
    RC_ASSERT(check(parse_genome(text, "f")).empty());
  } catch (const InputError& error) {
    RC_ASSERT(!error.lines().empty());
    for (const std::string& line : error.lines()) {
      RC_ASSERT(line.rfind("f: ", 0) == 0);
      RC_ASSERT(line.find('\n') == std::string::npos);
    }
  }
}

TEST(GenomeFile, ReadsWhatItWrote) {
  const tests::TemporaryDirectory directory;
  const auto file = directory.path() / "genome.json";
  write_genome(file, layered(8, 1), Overwrite::no);
  EXPECT_EQ(read_genome(file), layered(8, 1));
}

}  // namespace
}  // namespace metamorph::evolve
