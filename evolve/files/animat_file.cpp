#include "evolve/files/animat_file.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "evolve/files/body_file.h"
#include "evolve/files/embryo_file.h"
#include "evolve/files/genome_file.h"
#include "evolve/files/input_error.h"
#include "evolve/files/json_text.h"
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

using Faults = std::vector<std::string>;

/// The *.json files of a directory, ascending by name.
std::vector<std::filesystem::path> files_in(const std::filesystem::path& directory,
                                            Faults& faults) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  }
  if (error) {
    faults.push_back(directory.string() + ": " + error.message() +
                     ": expected a directory that can be read");
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Bodies as they are read, genomes as networks with their places among the animats.
struct Reading {
  const BodyChoice& choice;
  std::vector<Animat> animats;
  std::vector<std::size_t> places;
  std::vector<std::vector<core::Network>> lives;
  Faults faults;

  void read(const std::filesystem::path& file, bool skip_embryo) {
    const std::string name = file.string();
    try {
      const std::string text = detail::read_text(file);
      const std::string format = format_of(text, name);
      if (format == body_format) {
        animats.push_back({name, core::Status::ok, parse_body(text, name)});
      } else if (format == genome_format) {
        const Genome genome = parse_genome(text, name);
        check_fits(genome, choice.rules, name);
        lives.push_back(compile_stages(genome, shape_of(choice.rules),
                                       static_cast<int>(choice.switches.size()) + 1));
        places.push_back(animats.size());
        animats.push_back({name, core::Status::ok, {}});
      } else if (!(skip_embryo && format == embryo_format)) {
        FaultList fault(name);
        fault.add("format", format.empty() ? "missing" : format,
                  "metamorph-body/1 or metamorph-genome/1");
        fault.throw_if_any();
      }
    } catch (const InputError& error) {
      faults.insert(faults.end(), error.lines().begin(), error.lines().end());
    }
  }
};

}  // namespace

std::string format_of(const std::filesystem::path& file) {
  return format_of(detail::read_text(file), file.string());
}

std::vector<Animat> read_animats(const std::vector<std::filesystem::path>& paths,
                                 const BodyChoice& choice, int threads) {
  Reading reading{choice, {}, {}, {}, {}};
  for (const std::filesystem::path& path : paths) {
    std::error_code error;
    if (!std::filesystem::is_directory(path, error)) {
      reading.read(path, false);
      continue;
    }
    const std::size_t animats = reading.animats.size();
    const std::size_t faults = reading.faults.size();
    for (const auto& file : files_in(path, reading.faults)) reading.read(file, true);
    if (reading.animats.size() == animats && reading.faults.size() == faults) {
      reading.faults.push_back(path.string() + ": expected body or genome files (*.json) in it");
    }
  }
  if (!reading.faults.empty()) throw InputError(reading.faults);
  grow(reading.animats, reading.places, reading.lives, choice, threads);
  return std::move(reading.animats);
}

}  // namespace metamorph::evolve
