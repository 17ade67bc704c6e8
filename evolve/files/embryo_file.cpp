#include "evolve/files/embryo_file.h"

#include <numeric>
#include <vector>

#include "evolve/files/body_file.h"
#include "evolve/files/json_text.h"

namespace metamorph::evolve {
namespace {

using namespace detail;

void append_cell(std::string& text, const core::Embryo& embryo, std::size_t i) {
  const auto integer = [&](const char* name, int value) {
    text.append(name).append(std::to_string(value));
  };
  const auto number = [&](const char* name, double value) {
    text.append(name);
    append_number(text, value);
  };
  integer("{\"id\": ", embryo.id[i]);
  number(", \"x\": ", embryo.x[i]);
  number(", \"y\": ", embryo.y[i]);
  number(", \"orientation\": ", embryo.orientation[i]);
  integer(", \"birth_step\": ", embryo.birth_step[i]);
  integer(", \"mother\": ", embryo.mother[i]);
  number(", \"period\": ", embryo.period[i]);
  number(", \"phase\": ", embryo.phase[i]);
  text += '}';
}

}  // namespace

std::string embryo_text(const core::Embryo& embryo, const core::Extraction& extraction) {
  std::vector<std::size_t> cells(embryo.id.size());
  std::iota(cells.begin(), cells.end(), std::size_t{0});
  std::string text = "{\n  \"format\": \"";
  text.append(embryo_format).append("\",\n  \"step\": ").append(std::to_string(embryo.step));
  text.append(",\n  \"cells\": ");
  append_lines(text, cells, 2,
               [&](std::string& out, std::size_t i) { append_cell(out, embryo, i); });
  text.append(",\n  \"links\": ");
  append_lines(text, embryo.links, 2, [](std::string& out, const auto& link) {
    append_row(out, link, [](std::string& row, core::Index i) { row += std::to_string(i); });
  });
  text.append(",\n  \"created\": ").append(std::to_string(embryo.created));
  text.append(",\n  \"died\": ").append(std::to_string(embryo.died)).append(",\n  \"body\": ");
  text += extraction.status == core::Status::ok ? body_object(extraction.body, 2) : "null";
  return text.append("\n}\n");
}

void write_embryo(const std::filesystem::path& file, const core::Embryo& embryo,
                  const core::Extraction& extraction, Overwrite overwrite) {
  write_file(file, embryo_text(embryo, extraction), overwrite);
}

}  // namespace metamorph::evolve
