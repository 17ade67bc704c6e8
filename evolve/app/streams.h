#pragma once

// Standard output and standard error, as whoever started the program left them.

#include <fmt/format.h>

#include <utility>

namespace metamorph::evolve {

/// To be called before anything opens a file: streams that are closed are opened so that writing to
/// them fails and no other file gets their numbers. A file size limit becomes a failed write.
void prepare_streams();

/// A broken pipe becomes a failed write, too, instead of the end of the program: for work that is
/// worth more than who looks on.
void ignore_broken_pipes();

/// Writes out what was printed. False, and a line on standard error, if some of it could not be.
bool finish_output();

void print_to_error(fmt::string_view text, fmt::format_args values) noexcept;

/// Prints to standard error. Where that is full or closed nothing is told, and nothing thrown.
template <class... Values>
void tell(fmt::format_string<Values...> text, Values&&... values) noexcept {
  print_to_error(text, fmt::make_format_args(values...));
}

}  // namespace metamorph::evolve
