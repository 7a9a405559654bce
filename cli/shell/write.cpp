// hitpipe_shell FOLDER: writes the man page and the completions of the program, hitpipe.1, hitpipe.bash and _hitpipe.
#include <filesystem>

#include <CLI/CLI.hpp>

#include "cli/program.hpp"
#include "cli/shell/options.hpp"
#include "host/files.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  CLI::App program;
  int exit_code = 0;
  hitpipe::cli::fill(program, exit_code);
  hitpipe::host::write_file(folder / "hitpipe.1", hitpipe::cli::man_page(program));
  hitpipe::host::write_file(folder / "hitpipe.bash", hitpipe::cli::bash_completion(program));
  hitpipe::host::write_file(folder / "_hitpipe", hitpipe::cli::zsh_completion(program));
}
