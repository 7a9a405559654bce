#include "cli/report/gnuplot.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "host/process.hpp"

namespace hitpipe::cli {

std::string gnuplot_string(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("''") : std::string(1, c);
  return word + "'";
}

std::string run_gnuplot(const std::string& command, const std::string& script) {
  host::Outcome plotted = host::run({"gnuplot"}, {.input = script, .time_limit = host::answering_time});
  if (!plotted.succeeded() || plotted.out.empty()) {
    throw std::runtime_error(fmt::format("{}: gnuplot {}{}", command, plotted.failure(),
                                         plotted.not_found() ? "; install the package gnuplot-nox" : ""));
  }
  return std::move(plotted.out);
}

}  // namespace hitpipe::cli
