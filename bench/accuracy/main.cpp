// metamorph_accuracy STUDY RANDOM GENOME...: one table of bench/ACCURACY.md on standard output.

#include <charconv>
#include <cstring>
#include <exception>
#include <iostream>
#include <string_view>

#include "bench/accuracy/specimens.h"
#include "bench/accuracy/studies.h"

namespace {

using Study = void (*)(std::span<const metamorph::bench::Specimen>, std::ostream&);

struct Entry {
  std::string_view name;
  Study run;
};

constexpr Entry studies[] = {
    {"work-precision-water", metamorph::bench::work_precision_water},
    {"work-precision-land-third", metamorph::bench::work_precision_land_third},
    {"work-precision-land", metamorph::bench::work_precision_land},
    {"work-precision-slope", metamorph::bench::work_precision_slope},
    {"stability", metamorph::bench::stability_map},
    {"ablation", metamorph::bench::ablation},
    {"settling", metamorph::bench::settling},
    {"solidity", metamorph::bench::solidity},
    {"predictability", metamorph::bench::predictability}};

int usage() {
  std::cerr
      << "usage: metamorph_accuracy STUDY RANDOM GENOME...\n"
         "  STUDY    work-precision-water, -land-third, -land or -slope, stability, ablation,\n"
         "           settling, solidity or predictability\n"
         "  RANDOM   number of bodies of random genomes\n"
         "  GENOME   file of an evolved genome; its larva and adult are measured too\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return usage();
  std::size_t random = 0;
  const char* const end = argv[2] + std::strlen(argv[2]);
  if (std::from_chars(argv[2], end, random).ptr != end) return usage();
  for (const Entry& study : studies) {
    if (study.name != argv[1]) continue;
    try {
      const auto specimens = metamorph::bench::grow_specimens({argv + 3, argv + argc}, random);
      study.run(specimens, std::cout);
      return 0;
    } catch (const std::exception& error) {
      std::cerr << "metamorph_accuracy: " << error.what() << '\n';
      return 1;
    }
  }
  return usage();
}
