// Names of the last release: the program runs today's words and says them in one line.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cli/program.hpp"

namespace hitpipe::cli::old_names_test {
namespace {

struct OldLine {
  std::string before;
  std::string today;
  std::string notice;
};

TEST(OldNames, DoWhatTodaysDoAndNameThem) {
  const sim::TemporaryFolder folder;
  const std::string in = folder.path().string() + "/";
  ASSERT_EQ(hitpipe("render --scene spheres --width 8 --height 8 --out " + in + "a.png").exit_code, 0);
  const std::string image = in + "a.png";
  const std::string small = " --scene spheres --width 8 --height 8";
  const OldLine lines[] = {
      {"designs", "list designs", "`designs` is now `list designs`"},
      {"libraries --format csv", "list libraries --format csv", "`libraries` is now `list libraries`"},
      {"scenes", "list scenes", "`scenes` is now `list scenes`"},
      {"reproduce --tables 4.2 7.2", "table --judge 4.2,7.2",
       "`reproduce` is now `table --judge`; `--tables X` is now `X`"},
      {"stiffness --designs int_slabs int_major --bits 12/12 16/16 12+1/10 --tests 60",
       "check --stiff int_slabs,int_major --bits 12/12,16/16,12+1/10 --tests 60",
       "`stiffness` is now `check --stiff`; `--designs X` is now `X`"},
      {"compare " + image + " " + image, "render --compare " + image + " " + image,
       "`compare` is now `render --compare`"},
      {"render --arithmetic robust --traversal plu" + small,
       "render --arithmetic conservative --traversal plu" + small,
       "`--arithmetic robust` is now `--arithmetic conservative`"},
      {"render --arithmetic=robust --traversal plu" + small,
       "render --arithmetic=conservative --traversal plu" + small,
       "`--arithmetic robust` is now `--arithmetic conservative`"},
      {"rescale --scale 2 3 --offset 1,2,3 4,5,6" + small,
       "render --rescale --scale 2 --scale 3 --offset 1,2,3 --offset 4,5,6" + small,
       "`rescale` is now `render --rescale`"},
      {"rescale --design=int_slabs --bits 12/12 --scale 2" + small,
       "cosim int_slabs --rescale --bits 12/12 --scale 2" + small,
       "`rescale` is now `cosim --rescale`; `--design X` is now `X`"},
      {"sweep --bits 99/9 --designs int_slabs,int_plucker --out x" + small,
       "sweep int_slabs int_plucker --bits 99/9 --out x" + small, "`--designs X` is now `X`"},
      {"sweep --bits 12/12 99/9 --out x int_slabs" + small,
       "sweep int_slabs --bits 12/12,99/9 --out x" + small, ""},
      {"fit --designs int_slabs int_plucker --bits 99/9 --out x" + small,
       "fit int_slabs int_plucker --bits 99/9 --out x" + small, "`--designs X` is now `X`"}};
  for (const auto& [before, now, notice] : lines) {
    const Outcome old = hitpipe(before);
    const Outcome today = hitpipe(now);
    EXPECT_EQ(old.out, today.out) << before;
    EXPECT_EQ(old.exit_code, today.exit_code) << before;
    const std::string line =
        notice.empty() ? "" : fmt::format("hitpipe: {}; the next release takes only the new form\n", notice);
    EXPECT_EQ(old.err, line + today.err) << before;
  }
}

}  // namespace
}  // namespace hitpipe::cli::old_names_test
