// One function per command: adds it, with its options, to the program. The exit code of the last command that
// ran is left in `exit_code`; errors are thrown as std::exception with one line of text.
#pragma once

namespace CLI {
class App;
}

namespace hitpipe::cli {

void add_designs_command(CLI::App& program);
void add_scenes_command(CLI::App& program);
void add_rtl_command(CLI::App& program);
void add_area_command(CLI::App& program);
void add_bvh_command(CLI::App& program);
void add_render_command(CLI::App& program);
void add_compare_command(CLI::App& program, int& exit_code);
void add_cosim_command(CLI::App& program, int& exit_code);
void add_sweep_command(CLI::App& program, int& exit_code);
void add_table_command(CLI::App& program);
void add_check_command(CLI::App& program, int& exit_code);
void add_stiffness_command(CLI::App& program, int& exit_code);
void add_rescale_command(CLI::App& program, int& exit_code);
void add_fit_command(CLI::App& program, int& exit_code);
void add_report_command(CLI::App& program, int& exit_code);

}  // namespace hitpipe::cli
