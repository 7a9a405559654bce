// Prints the graphs of all machines: canonical ones, or with an argument as they were traced.
#include <cstdio>

#include "tests/rtl_gen/machines/graphs.hpp"

int main(int count, char** /*words*/) {
  std::fputs(hitpipe::rtl::machine_graphs(count == 1).c_str(), stdout);
}
