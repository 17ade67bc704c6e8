#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "evolve/app/commands.h"
#include "evolve/app/streams.h"
#include "evolve/files/input_error.h"
#include "evolve/files/printable.h"

namespace metamorph::evolve {
namespace {

constexpr int exit_failure = 1;  ///< something broke
constexpr int exit_input = 2;    ///< what was asked for cannot be done

using AddCommand = void (*)(CLI::App&);

/// In the order of --help.
const std::vector<AddCommand> add_commands = {
    add_evolve_command, add_grow_command,   add_simulate_command, add_info_command,
    add_export_command, add_render_command, add_film_command,     add_replay_command,
    add_plot_command,   add_audit_command,
};

/// The line of a command-line fault: which command, what, and where to read on.
std::string fault_line(const CLI::App& app, const CLI::ParseError& error) {
  std::string command = app.get_name();
  for (const CLI::App* chosen : app.get_subcommands()) {
    command.append(" ").append(chosen->get_name());
  }
  std::string what = error.what();
  for (char& c : what) {
    if (c == '\n') c = ' ';
  }
  return command + ": " + printable(what) + " (see " + command + " --help)";
}

/// Ends the program where memory is asked for, in whatever thread: destructors of JSON need some
/// themselves, and what they throw ends the program without a word. No file is left half written.
[[noreturn]] void out_of_memory() {
  constexpr char line[] =
      "metamorph: out of memory: expected more of it, or less at once; what a run has recorded is "
      "safe\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line, sizeof line - 1);
  std::_Exit(exit_failure);
}

int run(int argc, char** argv) {
  CLI::App app("Evolves soft-bodied robots that change their shape.", "metamorph");
  app.set_version_flag("--version", "metamorph " METAMORPH_VERSION);
  app.require_subcommand(1);
  for (const AddCommand add : add_commands) add(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    tell("{}\n", fault_line(app, error));
    return exit_input;
  } catch (const InputError& error) {
    for (const std::string& line : error.lines()) tell("{}\n", line);
    return exit_input;
  } catch (const std::filesystem::filesystem_error& error) {
    tell("{}: {}\n", printable(error.path1().string()), error.code().message());
    return exit_input;
  } catch (const std::exception& error) {
    // That standard output fails is told at the end, for all commands.
    if (std::ferror(stdout) == 0) tell("metamorph: {}\n", printable(error.what()));
    return exit_failure;
  }
  return 0;
}

}  // namespace
}  // namespace metamorph::evolve

int main(int argc, char** argv) {
  using namespace metamorph::evolve;
  prepare_streams();
  std::set_new_handler(out_of_memory);
  const int code = run(argc, argv);
  return finish_output() || code != 0 ? code : exit_failure;
}
