#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "evolve/search/offspring.h"
#include "metamorph/searches.h"

namespace metamorph::evolve {

/// One of the pool: whoever was evaluated and lives.
struct Member {
  std::int64_t id = 0;
  int born = 0;  ///< generation in which it was evaluated
  Genome genome;
  Evaluation evaluation;
  double quality = 0;  ///< geometric mean of its objectives (eq 6)
};

/// The rule by which a pool search chooses who lives on.
class Survival {
 public:
  virtual ~Survival() = default;

  struct Judgement {
    std::vector<std::size_t> order;  ///< [pool] best first
    std::vector<double> scores;      ///< [pool] finite, >= 0, what the record tells
  };
  /// Judges parents and children together; the pool stands in order of age, the eldest first.
  virtual Judgement judge(std::span<const Member> pool) = 0;
  /// So many parents are drawn, the best of them has the child: 1 is uniform choice.
  virtual int tournament() const = 0;

  virtual std::vector<Table> tables() const = 0;
  /// [tables] of a generation, after it was judged: of those who live on, best first, of whom
  /// `entered` are new. `children` are all that were evaluated now; the rows may be the place where
  /// some of them are remembered.
  virtual std::vector<std::vector<Row>> rows(int generation, std::span<const Member> living,
                                             std::span<const Member> children, int entered) = 0;
  virtual nlohmann::json save() const;
  /// Throws nlohmann's exceptions, or std::runtime_error, if it is not what save() gave.
  virtual void load(const nlohmann::json& /*state*/, const Search::RowsOf& /*rows*/) {}
};

/// Parents and children compete for neat.population places in every generation. Who lives on keeps
/// the evaluation it had: where starts are renewed, a lucky one too.
class PoolSearch : public Search {
 public:
  PoolSearch(const SearchSetup& setup, std::unique_ptr<Survival> survival);

  Asked ask() const override;
  Told tell(std::span<const Evaluation> evaluations) override;
  int generation() const override { return brood_.state.generation; }
  std::vector<Table> tables() const override;
  std::vector<std::uint8_t> save() const override;
  void load(std::span<const std::uint8_t> state, const RowsOf& rows) override;

 private:
  void breed();

  NeatSettings neat_;
  Problem problem_;
  int threads_;
  std::unique_ptr<Survival> survival_;
  std::vector<Member> pool_;  ///< best first
  Brood brood_;
};

}  // namespace metamorph::evolve
