#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "evolve/experiment/experiment.h"
#include "evolve/run/checkpoint.h"
#include "evolve/run/generation.h"
#include "evolve/run/integrity.h"
#include "evolve/run/sqlite.h"

namespace metamorph::evolve {

/// A lock on a directory, held by one process and freed when it ends, however it ends. On a disk
/// that machines share it holds between them.
class DirectoryLock {
 public:
  explicit DirectoryLock(const std::filesystem::path& directory);  ///< throws InputError if held
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// True if the file that is locked is no longer the one that others would find.
  bool is_gone() const;

 private:
  std::filesystem::path file_;
  int descriptor_;
};

/// The record of a run being written: run.db in the run's directory (record_schema.h). One
/// transaction per generation, with digests of all its rows (integrity.h). All failures (no room,
/// no rights, damage, a file that is not where it was) throw InputError. RECORD.md says what is
/// promised.
class Record {
 public:
  /// Makes the directory and an empty record in it. Refuses a directory that is not empty.
  Record(const std::filesystem::path& directory, const Experiment& experiment, int threads);

  /// Opens a run to go on with it, after checking that it is whole. Nothing is written before
  /// `accept`, if set, has looked at it; what that throws leaves it as it was.
  static std::unique_ptr<Record> resume(const std::filesystem::path& directory, int threads,
                                        const std::function<void(Record&)>& accept = {});

  ~Record();  ///< as close(), but for failures, of which it says nothing
  Record(const Record&) = delete;
  Record& operator=(const Record&) = delete;

  /// The experiment as recorded.
  Experiment experiment();
  /// Records that the run is to have another number of generations.
  void change_generations(int generations);
  int generations_done();
  /// Makes the search go on where the run was left, and makes its tables if the run has none yet.
  /// Returns the best individual up to there.
  BestEver restore(Search& search);

  /// Writes one generation and the checkpoint after it, as one transaction. `search` has been told
  /// of the generation and goes on with the next; restore() has seen it.
  void write(const GenerationResult& result, const PhaseSeconds& seconds, const Search& search,
             const BestEver& best);

  /// Makes the record one plain file that is safe on the disk. Nothing can be done with it after.
  void close();

  const std::filesystem::path& directory() const { return directory_; }

 private:
  explicit Record(const std::filesystem::path& directory);  // of an existing run
  void start_session(int threads);
  void frame(const Search& search);
  void begin_journal();
  void check_place();
  /// A statement that writes rows of the generation, which its digest counts.
  Statement insertion(const std::string& table, const std::string& sql);
  void write_checkpoint(const Checkpoint& checkpoint);
  TableDigest write_clock(const GenerationResult& result, const PhaseSeconds& seconds);
  void finish();
  void write_individuals(const GenerationResult& result);
  void write_summary(const GenerationResult& result);
  void write_search(const GenerationResult& result, const Search& search);
  void write_last_duration();

  std::filesystem::path directory_;
  std::unique_ptr<DirectoryLock> lock_;
  std::unique_ptr<Database> database_;
  std::vector<std::string> tables_;  ///< whose rows are counted in every generation
  Digests written_;                  ///< in this generation
  std::uint64_t chain_ = 0;          ///< of all digests so far
  // Of the last generation that is committed; how long it took to write is recorded with the next.
  TableDigest last_timings_;
  int last_generation_ = -1;  ///< -1: none in this session
  double last_duration_ = 0;  ///< s
};

}  // namespace metamorph::evolve
