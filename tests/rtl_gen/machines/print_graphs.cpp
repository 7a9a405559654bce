// Prints the graphs of all machines.
#include <cstdio>

#include "tests/rtl_gen/machines/graphs.hpp"

int main() {
  std::fputs(hitpipe::rtl::machine_graphs().c_str(), stdout);
}
