// metamorph_accuracy STUDY GENOMES RANDOM: one table of bench/ACCURACY.md on standard output.

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

constexpr Entry studies[] = {{"work-precision", metamorph::bench::work_precision},
                             {"stability", metamorph::bench::stability_map},
                             {"ablation", metamorph::bench::ablation},
                             {"settling", metamorph::bench::settling},
                             {"predictability", metamorph::bench::predictability}};

int usage() {
  std::cerr << "usage: metamorph_accuracy STUDY GENOMES RANDOM\n"
               "  STUDY    work-precision, stability, ablation, settling or predictability\n"
               "  GENOMES  folder of genome files of evolved animats\n"
               "  RANDOM   number of bodies of random genomes besides\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return usage();
  std::size_t random = 0;
  const char* const end = argv[3] + std::strlen(argv[3]);
  if (std::from_chars(argv[3], end, random).ptr != end) return usage();
  for (const Entry& study : studies) {
    if (study.name != argv[1]) continue;
    try {
      const auto specimens = metamorph::bench::grow_specimens(argv[2], random);
      study.run(specimens, std::cout);
      return 0;
    } catch (const std::exception& error) {
      std::cerr << "metamorph_accuracy: " << error.what() << '\n';
      return 1;
    }
  }
  return usage();
}
