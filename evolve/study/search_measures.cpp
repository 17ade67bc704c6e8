// What a record tells of how its search fares, and what that cost.

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "evolve/run/generation.h"
#include "evolve/study/measures.h"
#include "metamorph/status.h"

namespace metamorph::evolve {
namespace {

bool has_table(const Source& source, const std::string& table) {
  const std::vector<std::string> tables = source.run.tables();
  return std::find(tables.begin(), tables.end(), table) != tables.end();
}

std::string search_of(const Source& source) {
  return "search.kind = \"" + source.experiment.search.kind + "\"";
}

/// A column for each of the measures, of a table with a row for every generation.
void read_columns(const Source& source, const std::string& table, const std::string& columns,
                  std::vector<Measure>& measures) {
  source.run.read(table, "generation, " + columns, [&](const TableRow& row) {
    const auto g = static_cast<std::size_t>(row.integer(0));
    if (std::cmp_greater_equal(g, source.generations)) return;
    for (std::size_t m = 0; m < measures.size(); ++m) {
      measures[m].values[g] = row.number(static_cast<int>(m) + 1);
    }
  });
}

/// The share in per cent, 0 of none.
double percent(double part, double all) { return all == 0 ? 0 : 100 * part / all; }

}  // namespace

std::vector<Measure> read_species(const Source& source) {
  if (!has_table(source, "populations")) {
    source.lacks(search_of(source), "a run whose search breeds in species");
  }
  std::vector<Measure> measures = {
      {"species", "", "Species", "species", source.unknown()},
      {"threshold", "", "Compatibility threshold", "distance of genomes", source.unknown()}};
  read_columns(source, "populations", "species, compatibility_threshold", measures);
  return measures;
}

std::vector<Measure> read_archive(const Source& source) {
  std::vector<Measure> measures;
  if (has_table(source, "archive_sizes")) {
    measures = {{"size", "", "Novelty archive", "individuals", source.unknown()},
                {"threshold", "", "Threshold to enter", "novelty", source.unknown()}};
    read_columns(source, "archive_sizes", "archive_size, archive_threshold", measures);
  } else if (has_table(source, "qd")) {
    measures = {{"filled", "", "Niches filled", "%", source.unknown()},
                {"qd_score", "", "QD score", "sum of qualities, d", source.unknown()}};
    read_columns(source, "qd", "100 * coverage, qd_score", measures);
  } else {
    source.lacks(search_of(source), "a run whose search has an archive or a map of elites");
  }
  return measures;
}

std::vector<Measure> read_failures(const Source& source) {
  const auto generations = static_cast<std::size_t>(source.generations);
  std::vector<Measure> measures = {
      {"dead", "", "Fitness 0", "% of the individuals", source.unknown()},
      {"no_body", "", "No body to move", "% of the evaluations", source.unknown()},
      {"not_settled", "", "Not settled in time", "% of the evaluations", source.unknown()},
      {"failed", "", "Failed", "% of the evaluations", source.unknown()}};

  std::vector<int> individuals(generations), dead(generations);
  source.run.read("individuals", "generation, eq6", [&](const TableRow& row) {
    const auto g = static_cast<std::size_t>(row.integer(0));
    if (g >= generations) return;
    ++individuals[g];
    if (row.number(1) == 0) ++dead[g];
  });
  std::vector<std::array<double, core::status_count>> ended(generations);  // with each status
  source.run.read("status_counts", "generation, status, count", [&](const TableRow& row) {
    const auto g = static_cast<std::size_t>(row.integer(0));
    const std::string status = row.text(1);
    const auto known =
        std::find_if(core::all_statuses.begin(), core::all_statuses.end(),
                     [&](const core::Status code) { return core::name(code) == status; });
    if (g >= generations || known == core::all_statuses.end()) return;
    ended[g][static_cast<std::size_t>(known - core::all_statuses.begin())] += row.number(2);
  });
  const std::vector<bool> fully = fully_evaluated(source);
  for (std::size_t g = 0; g < generations; ++g) {
    double all = 0, no_body = 0, not_settled = 0, failed = 0;
    for (const core::Status status : core::all_statuses) {
      const double count = ended[g][static_cast<std::size_t>(status)];
      all += count;
      if (status == core::Status::empty || status == core::Status::no_body) no_body += count;
      if (status == core::Status::not_settled) not_settled += count;
      if (core::is_failure(status)) failed += count;
    }
    if (fully[g]) measures[0].values[g] = percent(dead[g], individuals[g]);
    measures[1].values[g] = percent(no_body, all);
    measures[2].values[g] = percent(not_settled, all);
    measures[3].values[g] = percent(failed, all);
  }
  return measures;
}

std::vector<Measure> read_time(const Source& source) {
  std::vector<Measure> measures = {{"all", "", "All phases", "s per generation", source.unknown()}};
  for (const std::string_view name : PhaseSeconds::names) {
    const std::string phase(name);
    measures.push_back({phase, "", titled(phase), "s per generation", source.unknown()});
  }
  std::vector<double>& all = measures[0].values;
  source.run.read("timings", "generation, phase, seconds", [&](const TableRow& row) {
    const auto g = static_cast<std::size_t>(row.integer(0));
    if (g >= all.size()) return;
    const std::string phase = row.text(1);
    const auto known = std::find_if(measures.begin() + 1, measures.end(),
                                    [&](const Measure& m) { return m.what == phase; });
    if (known != measures.end()) known->values[g] = row.number(2);
  });
  // How long the last generation took to record may not be known yet.
  for (std::size_t g = 0; g < all.size(); ++g) {
    all[g] = 0;
    for (std::size_t m = 1; m < measures.size(); ++m) all[g] += measures[m].values[g];
  }
  return measures;
}

}  // namespace metamorph::evolve
