#pragma once

namespace CLI {
class App;
}

namespace metamorph::evolve {

// Every command adds itself to the program: its options, its help and the callback that runs it.
// Callbacks throw InputError for what a person can mend; main() prints it. A new command costs its
// own file, a line here and one in main.cpp.

void add_audit_command(CLI::App& app);
void add_evolve_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_film_command(CLI::App& app);
void add_grow_command(CLI::App& app);
void add_info_command(CLI::App& app);
void add_plot_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_replay_command(CLI::App& app);
void add_simulate_command(CLI::App& app);

}  // namespace metamorph::evolve
