#include "evolve/run/record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <type_traits>

#include "evolve/run/run_reader.h"
#include "metamorph/outcome_fields.h"
#include "tests/evolve/files.h"
#include "tests/evolve/runs.h"

namespace metamorph::evolve {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::lines_of;
using tests::run_whole;
using tests::TemporaryDirectory;
using tests::tiny_experiment;

/// A search that has nothing but its tables and one number.
class Stub : public Search {
 public:
  Asked ask() const override { return {}; }
  Told tell(std::span<const Evaluation>) override { return {}; }
  int generation() const override { return generation_; }
  std::vector<Table> tables() const override {
    using Type = Table::Type;
    return {
        {"notes", {{"number", Type::integer}, {"share", Type::real}, {"words", Type::text}}, 1}};
  }
  std::vector<std::uint8_t> save() const override {
    return {7, static_cast<std::uint8_t>(generation_)};
  }
  void load(std::span<const std::uint8_t> state, const RowsOf& rows) override {
    if (state.size() != 2 || state[0] != 7) throw std::runtime_error("not mine");
    generation_ = state[1];
    loaded = rows(tables()[0]);
  }

  std::vector<Row> loaded;
  int generation_ = 0;
};

/// One generation of two individuals in which every field has a value of its own.
struct Example {
  Experiment experiment = tiny_experiment("novelty", 3);
  GenerationResult result;
  BestEver best;
  Stub search;
  std::vector<Row> notes = {{std::int64_t{3}, 0.1 + 0.2, "a \"b\", c"},
                            {std::int64_t{1} << 40, 1e-308, ""}};

  Example() {
    experiment.neat.population = 2;
    result.asked.genomes = first_generation(experiment.neat, experiment.seed).genomes;
    result.asked.lineage = {{10, 4, 5}, {11, 6, -1}};
    result.scores = {0.1 + 0.2, 7.0};
    result.eq6 = {1.0 / 3, 0.0};
    result.champion = 0;
    result.search_rows = {notes};
    result.work = {2, 1, 4, 3};
    result.individuals.resize(2);
    double value = 100;
    for (Evaluated& one : result.individuals) {
      one.created = 33;
      one.died = 3;
      one.penalty = 0.1;
      one.evaluated = {1, 1};
      one.trials.resize(2);
      one.stages = {{20, 22, 2}, {30, 33, 3}};
      one.descriptors.resize(2);
      for (TrialDescriptors& descriptors : one.descriptors) {
        for (const DescriptorField& field : descriptor_fields) {
          descriptors.*field.member = std::sqrt(value++);
        }
      }
      for (core::Outcome& o : one.trials) {
        core::for_each_field([&](const auto& field) {
          auto& member = o.*field.member;
          using Member = std::remove_cvref_t<decltype(member)>;
          if constexpr (std::is_same_v<Member, double>) {
            member = std::sqrt(value++);
          } else if constexpr (std::is_same_v<Member, std::array<double, 2>>) {
            member = {std::sqrt(value), -std::sqrt(value + 1)};
            value += 2;
          } else if constexpr (std::is_same_v<Member, std::int64_t>) {
            member = (std::int64_t{1} << 35) + static_cast<std::int64_t>(value++);
          } else if constexpr (std::is_same_v<Member, int>) {
            member = static_cast<int>(value++);
          }
        });
      }
    }
    result.individuals[0].trials[0].settle_step = 0;  // water
    result.individuals[0].trials[1].near_step_limit = true;
    core::Outcome& failed = result.individuals[1].trials[1];
    failed.status = core::Status::non_finite;
    failed.distance = 0;
    failed.failed_value = std::numeric_limits<double>::quiet_NaN();
    result.individuals[1].evaluated[0] = 0;
    result.individuals[0].descriptors[0].growth = TrialDescriptors::unknown;
    result.individuals[0].descriptors[1] = {};  // it has no body
    best = {0, 10, 1.0 / 3, 0.3, {1, 2}, result.asked.genomes[0]};
    search.generation_ = 1;
  }

  void write(const std::filesystem::path& path) {
    Record record(path, experiment, 1);
    Stub fresh;
    record.restore(fresh);
    record.write(result, {{1, 2, 3}, 4, 0}, search, best);
  }
};

/// A column of an outcome as text, from the program's side.
template <class Value>
std::string text_of(const Value& value) {
  if constexpr (std::is_same_v<Value, double>) {
    return std::isnan(value) ? "null" : fmt::format("{:a}", value);
  } else if constexpr (std::is_same_v<Value, bool>) {
    return value ? "1" : "0";
  } else {
    return fmt::format("{}", value);
  }
}

TEST(Record, EveryFieldOfAGenerationComesBack) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  Example x;
  x.write(path);
  Database database(path / "run.db", Database::Mode::read);
  {
    Statement s(database, "SELECT * FROM individuals ORDER BY position");
    for (int i = 0; i < 2; ++i) {
      const auto n = static_cast<std::size_t>(i);
      const Lineage& who = x.result.asked.lineage[n];
      const Genome& genome = x.result.asked.genomes[n];
      ASSERT_TRUE(s.step());
      EXPECT_EQ(s.integer(0), 0);
      EXPECT_EQ(s.integer(1), i);
      EXPECT_EQ(s.integer(2), who.id);
      EXPECT_EQ(s.integer(3), who.parent_a);
      EXPECT_EQ(s.integer(4), who.parent_b);
      EXPECT_EQ(s.real(5), x.result.scores[n]);
      EXPECT_EQ(s.real(6), x.result.eq6[n]);
      EXPECT_EQ(s.real(7), 0.1);
      EXPECT_EQ(s.integer(8), 33);
      EXPECT_EQ(s.integer(9), 3);
      EXPECT_EQ(s.integer(10), static_cast<int>(genome.nodes.size()));
      EXPECT_EQ(s.integer(11), static_cast<int>(genome.links.size()));
    }
    EXPECT_FALSE(s.step());
  }
  {
    Statement s(database, "SELECT * FROM outcomes ORDER BY position, trial");
    for (const auto& [i, t] : {std::pair{0u, 0u}, {0u, 1u}, {1u, 1u}}) {  // (1, 0) was not run
      ASSERT_TRUE(s.step());
      const StageCounts& stage = x.result.individuals[i].stages[t];
      EXPECT_EQ(s.integer(1), static_cast<int>(i));
      EXPECT_EQ(s.integer(2), static_cast<int>(t));
      EXPECT_EQ(s.integer(3), stage.cells);
      EXPECT_EQ(s.integer(4), stage.created);
      EXPECT_EQ(s.integer(5), stage.died);
      int c = 6;
      core::visit_columns(x.result.individuals[i].trials[t], [&](const core::OutcomeColumn& column,
                                                                 const auto& value) {
        EXPECT_EQ(s.name(c), column.name);
        const std::string found = s.is_null(c)   ? "null"
                                  : s.is_real(c) ? fmt::format("{:a}", s.real(c))
                                                 : s.text(c);
        EXPECT_EQ(found, column.applies ? text_of(value) : "null") << column.name;
        ++c;
      });
      EXPECT_EQ(c, s.columns());
    }
    EXPECT_FALSE(s.step());
  }
  {
    Statement s(database, "SELECT * FROM descriptors ORDER BY position, trial");
    for (const auto& [i, t] : {std::pair{0u, 0u}, {1u, 1u}}) {
      ASSERT_TRUE(s.step());
      EXPECT_EQ(s.integer(1), static_cast<int>(i));
      EXPECT_EQ(s.integer(2), static_cast<int>(t));
      int c = 3;
      for (const DescriptorField& field : descriptor_fields) {
        const double value = x.result.individuals[i].descriptors[t].*field.member;
        EXPECT_EQ(s.name(c), field.name);
        EXPECT_EQ(s.is_null(c) ? "null" : text_of(s.real(c)), text_of(value)) << field.name;
        ++c;
      }
      EXPECT_EQ(c, s.columns());
    }
    EXPECT_FALSE(s.step());
  }
  {
    Statement s(database, "SELECT * FROM generations");
    ASSERT_TRUE(s.step());
    const double expected[] = {0, 10, 1.0 / 3, (1.0 / 3) / 2, 7.0, (0.1 + 0.2 + 7.0) / 2};
    for (int c = 0; c < 6; ++c) EXPECT_DOUBLE_EQ(s.real(c), expected[c]) << s.name(c);
    EXPECT_EQ(s.columns(), 6);
  }
  {
    Statement s(database, "SELECT trial, status, count FROM status_counts ORDER BY trial, status");
    std::vector<std::string> rows;
    while (s.step()) rows.push_back(s.text(0) + " " + s.text(1) + " " + s.text(2));
    EXPECT_THAT(rows, ElementsAre("0 ok 1", "1 non_finite 1", "1 ok 1"));
  }
  {
    Statement s(database, "SELECT phase, seconds FROM timings ORDER BY phase");
    std::map<std::string, double> phases;
    while (s.step()) phases[s.text(0)] = s.real(1);
    EXPECT_EQ(phases.size(), PhaseSeconds::names.size());
    EXPECT_EQ(phases["develop"], 1);
    EXPECT_EQ(phases["extract"], 2);
    EXPECT_EQ(phases["locomotion"], 3);
    EXPECT_EQ(phases["search"], 4);
    EXPECT_GT(phases["record"], 0);  // measured by the record itself
  }
  const RunReader reader(path);
  EXPECT_EQ(reader.work().individuals, 2);
  EXPECT_EQ(reader.work().developed, 1);
  EXPECT_EQ(reader.work().bodies, 4);
  EXPECT_EQ(reader.work().simulated, 3);
  const Champion champion = reader.champion(0);
  EXPECT_EQ(champion.genome, x.result.asked.genomes[0]);
  EXPECT_EQ(champion.individual, 10);
  EXPECT_EQ(champion.eq6, x.result.eq6[0]);
  EXPECT_EQ(champion.score, x.result.scores[0]);
  EXPECT_EQ(champion.distances[1], x.result.individuals[0].trials[1].distance);
  EXPECT_EQ(to_toml(reader.experiment()), to_toml(x.experiment));
  std::map<std::string, std::string> session;
  for (const auto& [key, value] : reader.last_session()) session[key] = value;
  for (const char* key : {"version", "compiler", "flags", "processor", "system", "threads"}) {
    EXPECT_FALSE(session[key].empty()) << key;
  }
}

TEST(Record, TheSearchComesBackWithItsTables) {
  const TemporaryDirectory directory;
  Example x;
  x.write(directory.path() / "a");
  Stub back;
  const BestEver best = Record::resume(directory.path() / "a", 1)->restore(back);
  EXPECT_EQ(best, x.best);
  EXPECT_EQ(back.generation_, 1);
  ASSERT_EQ(back.loaded.size(), 2u);
  EXPECT_EQ(back.loaded, x.notes);  // of ascending numbers already
}

TEST(Record, NothingExistingIsOverwritten) {
  const TemporaryDirectory directory;
  const Experiment e = tiny_experiment("simple", 1);
  EXPECT_THAT(lines_of([&] {
                std::ofstream(directory.path() / "mine") << "precious";
                const Record record(directory.path(), e, 1);
              }),
              ElementsAre(HasSubstr("is not empty")));
  EXPECT_THAT(directory.names(), ElementsAre("mine"));
}

TEST(Record, DirectoriesThatCannotBeMadeGetALine) {
  const Experiment e = tiny_experiment("simple", 1);
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "file") << "x";
  EXPECT_THAT(lines_of([&] { const Record record("/proc/none/run", e, 1); }),
              ElementsAre(HasSubstr("/proc/none/run: cannot be made")));
  EXPECT_THAT(lines_of([&] { const Record record(directory.path() / "file", e, 1); }),
              ElementsAre(HasSubstr("cannot be made")));
}

TEST(Record, ASecondWriterIsRefused) {
  const TemporaryDirectory directory;
  const Experiment e = tiny_experiment("simple", 1);
  const auto first = std::make_unique<Record>(directory.path() / "a", e, 1);
  EXPECT_THAT(lines_of([&] { Record::resume(directory.path() / "a", 1); }),
              ElementsAre(HasSubstr("another metamorph evolve is writing this run")));
}

TEST(Record, CanBeReadWhileItIsWritten) {
  const TemporaryDirectory directory;
  Example x;
  Record record(directory.path() / "a", x.experiment, 1);
  Stub fresh;
  record.restore(fresh);
  record.write(x.result, {}, x.search, x.best);
  const RunReader reader(directory.path() / "a");
  EXPECT_EQ(reader.generations_done(), 1);
  EXPECT_EQ(reader.best().genome, x.result.asked.genomes[0]);
}

/// Where the run in that directory goes on, of a simple search.
void restored(const std::filesystem::path& path) {
  const std::unique_ptr<Record> record = Record::resume(path, 1);
  const std::unique_ptr<Search> search = make_search(search_setup_of(record->experiment(), 1));
  record->restore(*search);
}

TEST(Record, CanBeReadWhereItsWriterWasKilledHalfWay) {
  const TemporaryDirectory directory;
  const std::filesystem::path whole = directory.path() / "whole";
  const std::filesystem::path killed = directory.path() / "killed";
  run_whole(whole, tiny_experiment("simple", 3));
  const auto expected = tests::contents(whole);
  {
    // Copied while a transaction has written over pages that only its journal still has.
    Database database(whole / "run.db", Database::Mode::write);
    database.run(
        "PRAGMA cache_size = 1; BEGIN; DELETE FROM individuals; DELETE FROM run;"
        "CREATE TABLE more AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 "
        "FROM n WHERE i < 3000) SELECT i, randomblob(500) FROM n");
    std::filesystem::copy(whole, killed);
    database.run("ROLLBACK");
  }
  ASSERT_TRUE(std::filesystem::exists(killed / "run.db-journal"));
  EXPECT_EQ(tests::contents(killed), expected);
}

TEST(Record, MissingForeignAndDamagedFilesGetOneLine) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  const auto resume = [&] { return lines_of([&] { restored(path); }); };
  const auto read = [&] {
    return lines_of([&] {
      const RunReader reader(path);
      reader.experiment();
      reader.best();
    });
  };
  EXPECT_THAT(resume(), ElementsAre(HasSubstr("holds no run.db")));
  EXPECT_THAT(read(), ElementsAre(HasSubstr("no such file")));

  std::filesystem::create_directory(path);
  std::ofstream(path / "run.db") << "not a database, but long enough to be looked at closely";
  EXPECT_THAT(resume(), ElementsAre(HasSubstr("run.db: ")));
  EXPECT_THAT(read(), ElementsAre(HasSubstr("run.db: ")));
  std::ofstream(path / "run.db").close();  // empty
  EXPECT_THAT(resume(), ElementsAre(HasSubstr("holds no experiment")));
  EXPECT_THAT(read(), ElementsAre(HasSubstr("expected \"metamorph-run/4\"")));
}

TEST(Record, EveryTruncatedFileGetsOneLine) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  run_whole(path, tiny_experiment("simple", 2));
  const std::string whole = tests::text_of(path / "run.db");
  ASSERT_GT(whole.size(), 20u * 4096u);
  for (std::size_t length = 0; length < whole.size(); length += 4096 + 512) {
    std::ofstream(path / "run.db", std::ios::binary) << whole.substr(0, length);
    EXPECT_THAT(lines_of([&] { restored(path); }), ElementsAre(HasSubstr("run.db: "))) << length;
  }
}

TEST(Record, DamagedCheckpointsGetOneLine) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  run_whole(path, tiny_experiment("simple", 2));
  const auto damaged = [&](const std::string& sql) {
    {
      Database database(path / "run.db", Database::Mode::write);
      database.run(sql);
    }
    return lines_of([&] { restored(path); });
  };
  EXPECT_THAT(damaged("UPDATE checkpoint SET state = substr(state, 1, length(state) - 1)"),
              ElementsAre(HasSubstr("checkpoint is")));
  EXPECT_THAT(damaged("UPDATE checkpoint SET state = (SELECT state FROM checkpoint) || x'00'"),
              ElementsAre(HasSubstr("checkpoint is")));
  EXPECT_THAT(damaged("DELETE FROM checkpoint"), ElementsAre(HasSubstr("checkpoint is missing")));
  EXPECT_THAT(damaged("UPDATE run SET value = 'x' WHERE key = 'format'"),
              ElementsAre(HasSubstr("format = \"x\": expected \"metamorph-run/4\"")));
}

TEST(Record, TablesAreWrittenAsCsv) {
  const TemporaryDirectory directory;
  Example x;
  x.write(directory.path() / "a");
  const RunReader reader(directory.path() / "a");
  const auto csv = [&](const std::string& table) {
    std::string text;
    reader.write_csv(table, [&](std::string_view part) { text += part; });
    return text;
  };
  EXPECT_EQ(csv("notes"),
            "number,share,words\n"
            "3,0.30000000000000004,\"a \"\"b\"\", c\"\n"
            "1099511627776,1e-308,\n");
  EXPECT_THAT(csv("individuals"), HasSubstr("\n0,0,10,4,5,0.30000000000000004,"));
  const core::Outcome& failed = x.result.individuals[1].trials[1];
  EXPECT_THAT(csv("outcomes"), HasSubstr(fmt::format(",{},{},\n", failed.failed_step,
                                                     failed.failed_index)));  // NaN: an empty field
  for (const std::string& table : reader.tables()) EXPECT_FALSE(csv(table).empty()) << table;
  EXPECT_THAT(lines_of([&] { csv("nothing"); }),
              ElementsAre(HasSubstr("expected one of champion_outcomes")));
  EXPECT_THAT(lines_of([&] { csv("run; DROP TABLE run"); }), ElementsAre(HasSubstr("expected")));
}

}  // namespace
}  // namespace metamorph::evolve
