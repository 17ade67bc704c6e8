#include "evolve/run/record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "evolve/run/run_reader.h"
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

/// One generation of two individuals in which every field has a value of its own.
struct Example {
  Experiment experiment = tiny_experiment(SearchKind::novelty, 3);
  Checkpoint next;
  PopulationState population;
  GenerationResult result;

  Example() {
    experiment.neat.population = 2;
    population = first_generation(experiment.neat, experiment.seed);
    population.individuals = {{10, 4, 5, 7}, {11, 6, -1, 8}};
    population.species = {{7, population.genomes[0], 3, 2.5, 1, 1},
                          {8, population.genomes[1], 4, 3.5, 2, 1}};
    population.compatibility_threshold = 4.75;
    result.scores = {0.1 + 0.2, 7.0};
    result.eq6 = {1.0 / 3, 0.0};
    result.champion = 0;
    result.archive_before = 0;
    result.work = {2, 1, 4, 3};
    result.individuals.resize(2);
    double value = 100;
    for (Evaluated& one : result.individuals) {
      one.evaluation.created = 33;
      one.evaluation.died = 3;
      one.evaluation.penalty = 0.1;
      one.evaluation.evaluated = {1, 1};
      one.evaluation.trials.resize(2);
      one.stages = {{20, 22, 2}, {30, 33, 3}};
      for (core::Outcome& o : one.evaluation.trials) {
        for (double* field :
             {&o.mean_position[0], &o.mean_position[1], &o.distance, &o.settle_time,
              &o.min_area_ratio, &o.max_speed, &o.longest_spring, &o.long_spring_share}) {
          *field = std::sqrt(value++);
        }
        o.cells = static_cast<int>(value++);
        o.springs = static_cast<int>(value++);
        o.triangles = static_cast<int>(value++);
        o.steps = (std::int64_t{1} << 35) + static_cast<std::int64_t>(value++);
      }
    }
    core::Outcome& failed = result.individuals[1].evaluation.trials[1];
    failed.status = core::Status::non_finite;
    failed.distance = 0;
    failed.failed_step = 77;
    failed.failed_index = 5;
    failed.failed_value = std::numeric_limits<double>::quiet_NaN();
    result.individuals[1].evaluation.evaluated[0] = 0;
    next.population = population;
    next.population.generation = 1;
    next.search.archive = {{10, 0, 1.5, {0.1, -0.0, 1e-308, 12345.678901234567}}};
    next.search.archive_threshold = 0.9;
    next.best = {0, 10, 1.0 / 3, 0.3, {1, 2}, population.genomes[0]};
  }
};

TEST(Record, EveryFieldOfAGenerationComesBack) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  const Example x;
  {
    Record record(path, x.experiment, 1);
    record.write(x.population, x.result, {{1, 2, 3}, 4, 5, 0}, x.next);
  }
  Database database(path / "run.db", Database::Mode::read);
  {
    Statement s(database, "SELECT * FROM individuals ORDER BY position");
    for (int i = 0; i < 2; ++i) {
      const auto n = static_cast<std::size_t>(i);
      const Individual& who = x.population.individuals[n];
      const Genome& genome = x.population.genomes[n];
      ASSERT_TRUE(s.step());
      EXPECT_EQ(s.integer(0), 0);
      EXPECT_EQ(s.integer(1), i);
      EXPECT_EQ(s.integer(2), who.id);
      EXPECT_EQ(s.integer(3), who.parent_a);
      EXPECT_EQ(s.integer(4), who.parent_b);
      EXPECT_EQ(s.integer(5), who.species);
      EXPECT_EQ(s.real(6), x.result.scores[n]);
      EXPECT_EQ(s.real(7), x.result.eq6[n]);
      EXPECT_EQ(s.real(8), 0.1);
      EXPECT_EQ(s.integer(9), 33);
      EXPECT_EQ(s.integer(10), 3);
      EXPECT_EQ(s.integer(11), static_cast<int>(genome.nodes.size()));
      EXPECT_EQ(s.integer(12), static_cast<int>(genome.links.size()));
    }
    EXPECT_FALSE(s.step());
  }
  {
    Statement s(database, "SELECT * FROM outcomes ORDER BY position, trial");
    for (const auto& [i, t] : {std::pair{0u, 0u}, {0u, 1u}, {1u, 1u}}) {  // (1, 0) was not run
      ASSERT_TRUE(s.step());
      const core::Outcome& o = x.result.individuals[i].evaluation.trials[t];
      const StageCounts& stage = x.result.individuals[i].stages[t];
      EXPECT_EQ(s.integer(1), static_cast<int>(i));
      EXPECT_EQ(s.integer(2), static_cast<int>(t));
      EXPECT_EQ(s.text(3), core::name(o.status));
      EXPECT_EQ(s.real(4), o.distance);
      EXPECT_EQ(s.real(5), o.mean_position[0]);
      EXPECT_EQ(s.real(6), o.mean_position[1]);
      EXPECT_EQ(s.integer(7), stage.cells);
      EXPECT_EQ(s.integer(8), stage.created);
      EXPECT_EQ(s.integer(9), stage.died);
      EXPECT_EQ(s.integer(10), o.cells);
      EXPECT_EQ(s.integer(11), o.springs);
      EXPECT_EQ(s.integer(12), o.triangles);
      EXPECT_EQ(s.integer(13), o.steps);
      EXPECT_EQ(s.real(14), o.settle_time);
      EXPECT_EQ(s.real(15), o.min_area_ratio);
      EXPECT_EQ(s.real(16), o.max_speed);
      EXPECT_EQ(s.real(17), o.longest_spring);
      EXPECT_EQ(s.real(18), o.long_spring_share);
      EXPECT_EQ(s.is_null(19), !core::is_failure(o.status));
      if (core::is_failure(o.status)) {
        EXPECT_EQ(s.integer(19), 77);
        EXPECT_EQ(s.integer(20), 5);
        EXPECT_TRUE(std::isnan(s.real(21)));
      }
    }
    EXPECT_FALSE(s.step());
  }
  {
    Statement s(database, "SELECT * FROM generations");
    ASSERT_TRUE(s.step());
    const double expected[] = {0, 10, 1.0 / 3, (1.0 / 3) / 2, 7.0, (0.1 + 0.2 + 7.0) / 2, 2, 4.75,
                               1, 1,  0.9};
    for (int c = 0; c < 11; ++c) EXPECT_DOUBLE_EQ(s.real(c), expected[c]) << s.name(c);
  }
  {
    Statement s(database, "SELECT trial, status, count FROM status_counts ORDER BY trial, status");
    std::vector<std::string> rows;
    while (s.step()) rows.push_back(s.text(0) + " " + s.text(1) + " " + s.text(2));
    EXPECT_THAT(rows, ElementsAre("0 ok 1", "1 non_finite 1", "1 ok 1"));
  }
  {
    Statement s(database, "SELECT * FROM species ORDER BY id");
    ASSERT_TRUE(s.step());
    const double expected[] = {0, 7, 3, 1, 2.5, 1, x.result.scores[0], x.result.scores[0]};
    for (int c = 0; c < 8; ++c) EXPECT_EQ(s.real(c), expected[c]) << s.name(c);
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
    EXPECT_EQ(phases["breeding"], 5);
    EXPECT_GT(phases["record"], 0);  // measured by the record itself
  }
  const RunReader reader(path);
  EXPECT_EQ(reader.work().individuals, 2);
  EXPECT_EQ(reader.work().developed, 1);
  EXPECT_EQ(reader.work().bodies, 4);
  EXPECT_EQ(reader.work().simulated, 3);
  const Champion champion = reader.champion(0);
  EXPECT_EQ(champion.genome, x.population.genomes[0]);
  EXPECT_EQ(champion.individual, 10);
  EXPECT_EQ(champion.eq6, x.result.eq6[0]);
  EXPECT_EQ(champion.score, x.result.scores[0]);
  EXPECT_EQ(champion.distances[1], x.result.individuals[0].evaluation.trials[1].distance);
  EXPECT_EQ(to_toml(reader.experiment()), to_toml(x.experiment));
  std::map<std::string, std::string> session;
  for (const auto& [key, value] : reader.last_session()) session[key] = value;
  for (const char* key : {"version", "compiler", "flags", "processor", "system", "threads"}) {
    EXPECT_FALSE(session[key].empty()) << key;
  }
}

TEST(Record, CheckpointComesBackWithItsArchive) {
  const TemporaryDirectory directory;
  const Example x;
  {
    Record record(directory.path() / "a", x.experiment, 1);
    record.write(x.population, x.result, {}, x.next);
  }
  const Checkpoint back = Record::resume(directory.path() / "a", 1)->checkpoint();
  EXPECT_EQ(encode(back), encode(x.next));
  ASSERT_EQ(back.search.archive.size(), 1u);
  const ArchiveEntry &a = back.search.archive[0], &b = x.next.search.archive[0];
  EXPECT_EQ(a.individual, b.individual);
  EXPECT_EQ(a.generation, b.generation);
  EXPECT_EQ(a.novelty, b.novelty);
  EXPECT_EQ(a.behaviour, b.behaviour);
  EXPECT_TRUE(std::signbit(a.behaviour[1]));
}

TEST(Record, NothingExistingIsOverwritten) {
  const TemporaryDirectory directory;
  const Experiment e = tiny_experiment(SearchKind::simple, 1);
  EXPECT_THAT(lines_of([&] {
                std::ofstream(directory.path() / "mine") << "precious";
                const Record record(directory.path(), e, 1);
              }),
              ElementsAre(HasSubstr("is not empty")));
  EXPECT_THAT(directory.names(), ElementsAre("mine"));
}

TEST(Record, DirectoriesThatCannotBeMadeGetALine) {
  const Experiment e = tiny_experiment(SearchKind::simple, 1);
  const TemporaryDirectory directory;
  std::ofstream(directory.path() / "file") << "x";
  EXPECT_THAT(lines_of([&] { const Record record("/proc/none/run", e, 1); }),
              ElementsAre(HasSubstr("/proc/none/run: cannot be made")));
  EXPECT_THAT(lines_of([&] { const Record record(directory.path() / "file", e, 1); }),
              ElementsAre(HasSubstr("cannot be made")));
}

TEST(Record, ASecondWriterIsRefused) {
  const TemporaryDirectory directory;
  const Experiment e = tiny_experiment(SearchKind::simple, 1);
  const auto first = std::make_unique<Record>(directory.path() / "a", e, 1);
  EXPECT_THAT(lines_of([&] { Record::resume(directory.path() / "a", 1); }),
              ElementsAre(HasSubstr("another metamorph evolve is writing this run")));
}

TEST(Record, CanBeReadWhileItIsWritten) {
  const TemporaryDirectory directory;
  const Example x;
  Record record(directory.path() / "a", x.experiment, 1);
  record.write(x.population, x.result, {}, x.next);
  const RunReader reader(directory.path() / "a");
  EXPECT_EQ(reader.generations_done(), 1);
  EXPECT_EQ(reader.best().genome, x.population.genomes[0]);
}

TEST(Record, MissingForeignAndDamagedFilesGetOneLine) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  const auto resume = [&] { return lines_of([&] { Record::resume(path, 1)->checkpoint(); }); };
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
  EXPECT_THAT(read(), ElementsAre(HasSubstr("expected \"metamorph-run/1\"")));
}

TEST(Record, EveryTruncatedFileGetsOneLine) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  run_whole(path, tiny_experiment(SearchKind::simple, 2));
  std::string whole;
  {
    std::ifstream stream(path / "run.db", std::ios::binary);
    whole.assign(std::istreambuf_iterator<char>(stream), {});
  }
  ASSERT_GT(whole.size(), 20u * 4096u);
  for (std::size_t length = 0; length < whole.size(); length += 4096 + 512) {
    std::ofstream(path / "run.db", std::ios::binary) << whole.substr(0, length);
    EXPECT_THAT(lines_of([&] { Record::resume(path, 1)->checkpoint(); }),
                ElementsAre(HasSubstr("run.db: ")))
        << length;
  }
}

TEST(Record, DamagedCheckpointsGetOneLine) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "a";
  run_whole(path, tiny_experiment(SearchKind::simple, 2));
  const auto damaged = [&](const std::string& sql) {
    {
      Database database(path / "run.db", Database::Mode::write);
      database.run(sql);
    }
    return lines_of([&] { Record::resume(path, 1)->checkpoint(); });
  };
  EXPECT_THAT(damaged("UPDATE checkpoint SET state = substr(state, 1, length(state) - 1)"),
              ElementsAre(HasSubstr("checkpoint is")));
  EXPECT_THAT(damaged("DELETE FROM checkpoint"), ElementsAre(HasSubstr("checkpoint is missing")));
  EXPECT_THAT(damaged("UPDATE run SET value = 'x' WHERE key = 'format'"),
              ElementsAre(HasSubstr("format = \"x\": expected \"metamorph-run/1\"")));
}

TEST(Record, TablesAreWrittenAsCsv) {
  const TemporaryDirectory directory;
  const Example x;
  {
    Record record(directory.path() / "a", x.experiment, 1);
    record.write(x.population, x.result, {}, x.next);
  }
  const RunReader reader(directory.path() / "a");
  const auto csv = [&](const std::string& table) {
    std::string text;
    reader.write_csv(table, [&](std::string_view part) { text += part; });
    return text;
  };
  EXPECT_EQ(csv("archive"),
            "number,individual,generation,novelty,behaviour\n"
            "0,10,0,1.5,\"[0.1,-0.0,1e-308,12345.678901234567]\"\n");
  EXPECT_THAT(csv("individuals"), HasSubstr("\n0,0,10,4,5,7,0.30000000000000004,"));
  EXPECT_THAT(csv("outcomes"), HasSubstr(",77,5,\n"));  // NaN is an empty field
  for (const std::string& table : reader.tables()) EXPECT_FALSE(csv(table).empty()) << table;
  EXPECT_THAT(lines_of([&] { csv("nothing"); }), ElementsAre(HasSubstr("expected one of archive")));
  EXPECT_THAT(lines_of([&] { csv("run; DROP TABLE run"); }), ElementsAre(HasSubstr("expected")));
}

}  // namespace
}  // namespace metamorph::evolve
