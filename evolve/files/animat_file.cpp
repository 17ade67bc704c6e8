#include "evolve/files/animat_file.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "evolve/files/body_file.h"
#include "evolve/files/embryo_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/input_error.h"
#include "evolve/files/input_file.h"
#include "evolve/files/json_text.h"
#include "evolve/files/printable.h"
#include "metamorph/extraction.h"

namespace metamorph::evolve {
namespace {

/// The tag of a file; "" if it has none.
std::string format_of(std::string_view text, const std::string& source) {
  const detail::Json object = detail::parse_object(text, source);
  const auto tag = object.find("format");
  return tag != object.end() && tag->is_string() ? tag->get<std::string>() : std::string();
}

void grow(std::vector<Animat>& animats, const std::vector<std::size_t>& places,
          const std::vector<std::vector<core::Network>>& lives, const BodyChoice& choice,
          int threads) {
  if (lives.empty()) return;
  const std::array<int, 1> stages = {choice.stage};
  const auto embryos = core::develop(lives, choice.switches, choice.rules, stages, threads);
  for (std::size_t i = 0; i < places.size(); ++i) {
    core::Extraction extraction = core::extract_body(embryos[i].front(), choice.min_cells);
    animats[places[i]].status = extraction.status;
    animats[places[i]].body = std::move(extraction.body);
  }
}

/// The *.json files of a directory, ascending by name. Throws InputError if it cannot be read.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  }
  if (error) {
    throw InputError(directory.string() + ": " + error.message() +
                     ": expected a directory that can be read");
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Bodies as they are read, genomes as networks with their places among the animats.
struct Reading {
  const BodyChoice& choice;
  std::vector<Animat> animats = {};
  std::vector<std::size_t> places = {};
  std::vector<std::vector<core::Network>> lives = {};

  /// Throws InputError.
  void read(const std::filesystem::path& file, bool skip_embryo) {
    const std::string source = file.string();
    const std::string name = printable(source);
    const std::string text = read_text(file);
    const std::string format = format_of(text, source);
    if (format == body_format) {
      animats.push_back({name, core::Status::ok, parse_body(text, source)});
    } else if (format == genome_format) {
      const Genome genome = parse_genome(text, source);
      check_fits(genome, choice.rules, source);
      lives.push_back(compile_stages(genome, shape_of(choice.rules),
                                     static_cast<int>(choice.switches.size()) + 1));
      places.push_back(animats.size());
      animats.push_back({name, core::Status::ok, {}});
    } else if (!(skip_embryo && format == embryo_format)) {
      FaultList fault(source);
      fault.add("format", format.empty() ? "missing" : format,
                "metamorph-body/1 or metamorph-genome/1");
      fault.throw_if_any();
    }
  }
};

/// Reads; where that throws, the lines go to `faults`. False then.
template <class Read>
bool collect(std::vector<std::string>& faults, Read read) {
  try {
    read();
  } catch (const InputError& error) {
    faults.insert(faults.end(), error.lines().begin(), error.lines().end());
    return false;
  }
  return true;
}

}  // namespace

std::string format_of(const std::filesystem::path& file) {
  return format_of(read_text(file), file.string());
}

AnimatFiles read_animats(const std::vector<std::filesystem::path>& paths, const BodyChoice& choice,
                         int threads) {
  Reading reading{choice};
  AnimatFiles files;
  bool usable = true;
  for (const std::filesystem::path& path : paths) {
    const bool good = collect(files.faults, [&] {
      std::error_code error;
      if (!std::filesystem::is_directory(path, error)) return reading.read(path, false);
      const std::size_t before = reading.animats.size();
      const int refused = files.refused;
      for (const auto& file : files_in(path)) {
        if (!collect(files.faults, [&] { reading.read(file, true); })) ++files.refused;
      }
      if (reading.animats.size() == before && files.refused == refused) {
        throw InputError(path.string() + ": expected body or genome files (*.json) in it");
      }
    });
    usable = usable && good;
  }
  if (!usable || reading.animats.empty()) throw InputError(files.faults);
  grow(reading.animats, reading.places, reading.lives, choice, threads);
  files.animats = std::move(reading.animats);
  return files;
}

}  // namespace metamorph::evolve
