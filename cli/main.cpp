// The program hitpipe.
#include "cli/program.hpp"

int main(int argc, char** argv) {
  return hitpipe::cli::run(argc, argv);
}
