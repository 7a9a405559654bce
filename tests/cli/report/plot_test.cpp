// gnuplot draws what it is told, whatever the folders are called, and its failures are told in one line.
#include "cli/report/plot.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/sim/environment.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::cli::plot_test {
namespace {

std::string message_of(const std::string& script) {
  return hitpipe::message_of<std::runtime_error>([&] { static_cast<void>(run_gnuplot("plot", script)); });
}

TEST(Gnuplot, DrawsInAnyTemporaryFolder) {
  const sim::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "it's temporary");
  const sim::EnvironmentValue variable("TMPDIR", (folder / "it's temporary").string());
  const std::string script =
      "set terminal svg\nset title " + gnuplot_string("it's a title") + "\nplot x notitle\n";
  const std::string drawn = run_gnuplot("plot", script);
  EXPECT_THAT(drawn, testing::HasSubstr("<svg"));
  EXPECT_THAT(drawn, testing::HasSubstr(">it's a title<"));
}

TEST(Gnuplot, FailureRejected) {
  EXPECT_EQ(message_of("plot nothing of the kind\n"), "plot: gnuplot failed with exit code 1");
}

TEST(Gnuplot, MissingProgramRejected) {
  const sim::EnvironmentValue path("PATH", "/nowhere");
  EXPECT_EQ(message_of("plot x\n"), "plot: gnuplot was not found; install the package gnuplot-nox");
}

}  // namespace
}  // namespace hitpipe::cli::plot_test
