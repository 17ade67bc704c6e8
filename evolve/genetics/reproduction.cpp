#include "evolve/genetics/reproduction.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "core/body/parallel_for.h"
#include "metamorph/random.h"
#include "metamorph/variation.h"

namespace metamorph::evolve {

std::vector<int> apportion(std::span<const double> shares, int seats) {
  // Relative to the largest share: of any size, without overflow.
  const double largest = *std::max_element(shares.begin(), shares.end());
  std::vector<double> quota(shares.size(), 1.0);
  if (largest > 0) {
    std::transform(shares.begin(), shares.end(), quota.begin(),
                   [&](double share) { return share / largest; });
  }
  const double total = std::accumulate(quota.begin(), quota.end(), 0.0);
  std::vector<int> parts(shares.size());
  for (std::size_t s = 0; s < quota.size(); ++s) {
    quota[s] *= seats / total;
    parts[s] = static_cast<int>(quota[s]);
    quota[s] -= parts[s];
  }
  std::vector<std::size_t> order(shares.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return quota[a] != quota[b] ? quota[a] > quota[b] : a < b;
  });
  int left = seats - std::accumulate(parts.begin(), parts.end(), 0);
  for (std::size_t i = 0; left > 0; i = (i + 1) % order.size(), --left) ++parts[order[i]];
  return parts;
}

std::vector<SpeciesPlan> plan_reproduction(const PopulationState& state,
                                           const NeatSettings& settings,
                                           std::span<const double> fitness,
                                           const std::vector<std::vector<int>>& ranked) {
  const std::size_t count = state.species.size();
  const auto champion_fitness = [&](std::size_t s) {
    return fitness[static_cast<std::size_t>(ranked[s].front())];
  };
  std::size_t best = 0;
  for (std::size_t s = 1; s < count; ++s) {
    if (champion_fitness(s) > champion_fitness(best)) best = s;
  }

  // Relative to the best fitness, so that no sum overflows.
  const double unit = std::max(champion_fitness(best), settings.fitness_floor);
  std::vector<double> shares(count, 0.0);
  for (std::size_t s = 0; s < count; ++s) {
    const Species& species = state.species[s];
    double factor = 1;
    if (species.age < settings.young_age) factor *= settings.young_bonus;
    if (species.age > settings.old_age) factor *= settings.old_factor;
    if (species.stagnant >= settings.stagnation && s != best) factor *= settings.stagnation_factor;
    const double size = static_cast<double>(ranked[s].size());
    for (const int member : ranked[s]) {
      const double own =
          std::max(fitness[static_cast<std::size_t>(member)], settings.fitness_floor);
      shares[s] += factor * (own / unit) / size;
    }
  }

  std::vector<int> offspring = apportion(shares, settings.population);
  if (offspring[best] == 0) {
    --*std::max_element(offspring.begin(), offspring.end());
    offspring[best] = 1;
  }

  std::vector<SpeciesPlan> plans(count);
  for (std::size_t s = 0; s < count; ++s) {
    const double size = static_cast<double>(ranked[s].size());
    const auto survivors = std::min(
        ranked[s].size(),
        static_cast<std::size_t>(std::floor(settings.survival_share * size)) + std::size_t{1});
    plans[s].parents.assign(ranked[s].begin(),
                            ranked[s].begin() + static_cast<std::ptrdiff_t>(survivors));
    plans[s].offspring = offspring[s];
  }
  return plans;
}

namespace {

Origin origin_of(MutationKind kind) {
  switch (kind) {
    case MutationKind::redraw:
      return Origin::redraw;
    case MutationKind::add_link:
      return Origin::add_link;
    case MutationKind::add_node:
      return Origin::add_node;
    case MutationKind::remove_link:
      return Origin::remove_link;
    case MutationKind::move_gene:
      return Origin::move_gene;
    case MutationKind::weights:
    case MutationKind::none:
      break;
  }
  return Origin::weights;
}

// Where in the new generation a child stands.
struct Slot {
  std::size_t species;
  bool is_copy;
};

struct Breeder {
  const PopulationState& state;
  const NeatSettings& settings;
  std::span<const double> fitness;
  const std::vector<SpeciesPlan>& plans;
  std::vector<std::size_t> breeding;  // species with offspring
  std::vector<Slot> slots;            // [population]

  // Draws from streams of its own, so that a child depends on its index and attempt alone.
  Child child(int index, int attempt) const {
    const Slot& slot = slots[static_cast<std::size_t>(index)];
    const std::vector<int>& parents = plans[slot.species].parents;
    Child result;
    if (slot.is_copy) {
      result.parent_a = parents.front();
      result.genome = genome(result.parent_a);
      return result;
    }
    const std::uint32_t key =
        static_cast<std::uint32_t>(attempt) * static_cast<std::uint32_t>(settings.population) +
        static_cast<std::uint32_t>(index);
    const auto stream = [&](Purpose purpose) {
      return RandomStream(purpose, state.seed, static_cast<std::uint32_t>(state.generation), key);
    };
    RandomStream choice = stream(Purpose::parent_choice);
    const std::uint32_t mother = choice.below(static_cast<std::uint32_t>(parents.size()));
    int other = -1;
    if (choice.chance(settings.crossover)) {
      if (choice.chance(settings.interspecies_crossover) && breeding.size() > 1) {
        RandomStream foreign = stream(Purpose::species_choice);
        other = foreign_mate(slot.species, foreign);
      } else if (parents.size() > 1) {
        const std::uint32_t drawn = choice.below(static_cast<std::uint32_t>(parents.size() - 1));
        other = parents[drawn + (drawn >= mother ? 1 : 0)];
      }
    }
    const Mate a = mate(parents[mother]);
    const Mate b = mate(other < 0 ? parents[mother] : other);
    return child_of(a, other < 0 ? nullptr : &b, settings, stream(Purpose::crossover),
                    stream(Purpose::mutation));
  }

 private:
  const Genome& genome(int i) const { return state.genomes[static_cast<std::size_t>(i)]; }
  Mate mate(int i) const { return {genome(i), fitness[static_cast<std::size_t>(i)], i}; }

  int foreign_mate(std::size_t own, RandomStream& stream) const {
    const std::uint32_t others = static_cast<std::uint32_t>(breeding.size() - 1);
    const std::size_t drawn = stream.below(others);
    const std::size_t at = static_cast<std::size_t>(
        std::find(breeding.begin(), breeding.end(), own) - breeding.begin());
    const std::vector<int>& parents = plans[breeding[drawn + (drawn >= at ? 1 : 0)]].parents;
    return parents[stream.below(static_cast<std::uint32_t>(parents.size()))];
  }
};

// Equal fitness: the smaller genome leads, then the earlier individual.
bool leads(const Mate& a, const Mate& b) {
  if (a.fitness != b.fitness) return a.fitness > b.fitness;
  if (a.genome.links.size() != b.genome.links.size()) {
    return a.genome.links.size() < b.genome.links.size();
  }
  return a.index < b.index;
}

std::uint64_t fingerprint(const Genome& genome, const StructuralChange& change) {
  std::uint64_t hash = 0;
  const auto mix = [&](std::uint64_t value) {
    hash = (hash ^ value) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 29;
  };
  for (const LinkGene& link : genome.links) {
    mix(static_cast<std::uint64_t>(link.innovation));
    mix(std::bit_cast<std::uint64_t>(link.weight));
  }
  mix(static_cast<std::uint64_t>(change.kind));
  mix(static_cast<std::uint64_t>(change.from));
  mix(static_cast<std::uint64_t>(change.to));
  return hash;
}

}  // namespace

Child child_of(const Mate& a, const Mate* b, const NeatSettings& settings, RandomStream crossing,
               RandomStream mutation) {
  Child child;
  child.parent_a = a.index;
  child.origin = Origin::copy;
  if (b != nullptr) {
    child.parent_b = b->index;
    child.origin = Origin::crossover;
    const bool averaging = !crossing.chance(settings.multipoint);
    const bool a_leads = leads(a, *b);
    child.genome =
        cross(a_leads ? a.genome : b->genome, a_leads ? b->genome : a.genome, averaging, crossing);
  } else {
    child.genome = a.genome;
  }
  if (b == nullptr || mutation.chance(settings.mutation_after_crossover)) {
    const MutationKind kind = mutate(child.genome, child.change, settings, mutation);
    if (kind != MutationKind::none) child.origin = origin_of(kind);
  }
  return child;
}

std::vector<Child> breed_distinct(int count, int tries, int threads,
                                  const std::function<Child(int, int)>& child,
                                  const std::function<bool(int)>& is_copy,
                                  std::span<const Genome* const> living) {
  std::vector<Child> children(static_cast<std::size_t>(count));
  std::vector<std::uint64_t> prints(children.size());
  core::parallel_for<core::Schedule::equal>(children.size(), threads, [&](std::size_t c) {
    children[c] = child(static_cast<int>(c), 0);
    prints[c] = fingerprint(children[c].genome, children[c].change);
  });

  // Clones are looked for in order of the children: which one is bred again must not depend on
  // which thread was first. They are compared before numbering: equal changes get equal numbers.
  static constexpr StructuralChange unchanged;
  using Known = std::pair<const Genome*, const StructuralChange*>;
  std::unordered_multimap<std::uint64_t, Known> earlier;
  earlier.reserve(children.size() + living.size());
  for (const Genome* genome : living) {
    earlier.emplace(fingerprint(*genome, unchanged), Known(genome, &unchanged));
  }
  for (int i = 0; i < count; ++i) {
    const std::size_t c = static_cast<std::size_t>(i);
    const auto is_clone = [&] {
      const auto [from, to] = earlier.equal_range(prints[c]);
      return std::any_of(from, to, [&](const auto& entry) {
        const auto& [genome, change] = entry.second;
        return *genome == children[c].genome && *change == children[c].change;
      });
    };
    for (int attempt = 1; attempt <= tries && !is_copy(i) && is_clone(); ++attempt) {
      children[c] = child(i, attempt);
      prints[c] = fingerprint(children[c].genome, children[c].change);
    }
    earlier.emplace(prints[c], Known(&children[c].genome, &children[c].change));
  }
  return children;
}

std::vector<Child> breed(const PopulationState& state, const NeatSettings& settings,
                         std::span<const double> fitness, const std::vector<SpeciesPlan>& plans,
                         int threads) {
  Breeder breeder{state, settings, fitness, plans, {}, {}};
  for (std::size_t s = 0; s < plans.size(); ++s) {
    if (plans[s].offspring > 0) breeder.breeding.push_back(s);
    for (int c = 0; c < plans[s].offspring; ++c) breeder.slots.push_back({s, c == 0});
  }
  return breed_distinct(
      static_cast<int>(breeder.slots.size()), settings.clone_tries, threads,
      [&](int index, int attempt) { return breeder.child(index, attempt); },
      [&](int index) { return breeder.slots[static_cast<std::size_t>(index)].is_copy; }, {});
}

}  // namespace metamorph::evolve
