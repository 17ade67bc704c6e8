#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "evolve/app/commands.h"
#include "evolve/files/input_error.h"

namespace metamorph::evolve {
namespace {

constexpr int exit_failure = 1;  ///< something broke
constexpr int exit_input = 2;    ///< what was asked for cannot be done

using AddCommand = void (*)(CLI::App&);

/// In the order of --help.
const std::vector<AddCommand> add_commands = {
    add_evolve_command, add_grow_command,   add_simulate_command, add_info_command,
    add_export_command, add_render_command, add_audit_command,
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
  return command + ": " + what + " (see " + command + " --help)";
}

/// Kept for the way out: what is destroyed there may allocate (nlohmann's JSON does, by the length
/// of its lists), and would end the program in an abort. Never written, it takes address space
/// alone.
constexpr std::size_t reserve_size = 32 << 20;
std::atomic<void*> reserve;

void give_up() {
  std::free(reserve.exchange(nullptr));
  throw std::bad_alloc();
}

int run(int argc, char** argv) {
  reserve = std::malloc(reserve_size);
  std::set_new_handler(give_up);
  CLI::App app("Evolves soft-bodied robots that change their shape.", "metamorph");
  app.set_version_flag("--version", "metamorph " METAMORPH_VERSION);
  app.require_subcommand(1);
  for (const AddCommand add : add_commands) add(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    std::fprintf(stderr, "%s\n", fault_line(app, error).c_str());
    return exit_input;
  } catch (const InputError& error) {
    for (const std::string& line : error.lines()) std::fprintf(stderr, "%s\n", line.c_str());
    return exit_input;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr,
                 "metamorph: out of memory: expected more of it, or less at once; what a run has "
                 "recorded is safe\n");
    return exit_failure;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "metamorph: %s\n", error.what());
    return exit_failure;
  }
  return 0;
}

}  // namespace
}  // namespace metamorph::evolve

int main(int argc, char** argv) { return metamorph::evolve::run(argc, argv); }
