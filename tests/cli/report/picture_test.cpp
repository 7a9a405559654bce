// The files of a picture: what gnuplot is told, that its program draws the same again, and failures in one
// line.
#include "cli/report/picture.hpp"

#include <filesystem>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/process.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/environment.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::cli::picture_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Picture picture(const std::string& plots = "plot $d with linespoints title 'it''s # 1'\n") {
  return {.name = "some",
          .title = "words about it",
          .height = 300,
          .settings = "$d << END\n1 2\n2 3\nEND\nset xlabel 'x²'\n",
          .plots = plots};
}

TEST(Picture, HasTheWidthOfThePaperAndLettersOf8Points) {
  const std::string script = picture_script(picture(), paper_form(84));
  EXPECT_THAT(script, HasSubstr("set terminal svg size 317,267 font 'sans-serif,10.67' "))
      << "pixels, 96 to the inch";
  EXPECT_THAT(script,
              HasSubstr("set terminal pdfcairo size 8.4000cm,7.0556cm font 'sans-serif,8' fontscale 0.75 "));
  EXPECT_THAT(script, testing::Not(HasSubstr("set title")));
  EXPECT_THAT(picture_script(picture(), report_form),
              HasSubstr("set terminal svg size 1000,300 font 'sans-serif,12' "));
  EXPECT_THAT(picture_script(picture(), page_form), HasSubstr("set terminal svg size 800,300 "));
}

/// A letter is as large in the PDF as on the paper: "it's # 1" in DejaVu Sans needs the page's size alone.
TEST(Picture, PdfHasTheSizeOfThePaper) {
  const DrawnPicture drawn = draw_picture("plot", picture(), paper_form(84));
  EXPECT_THAT(drawn.pdf, StartsWith("%PDF-"));
  EXPECT_THAT(drawn.pdf, HasSubstr("/MediaBox [ 0 0 238 200 ]")) << "points, 72 to the inch";
  EXPECT_THAT(drawn.svg, HasSubstr("width=\"317\" height=\"267\""));
  EXPECT_THAT(drawn.svg, HasSubstr(">it's # 1<"));
  EXPECT_THAT(drawn.svg, HasSubstr("font-size=\"10.67\""));
}

TEST(Picture, ItsProgramDrawsItAgain) {
  const DrawnPicture drawn = draw_picture("plot", picture(), paper_form(84));
  const std::vector<host::File> files = picture_files(drawn);
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].name, "some.svg");
  EXPECT_EQ(files[1].name, "some.pdf");
  EXPECT_EQ(files[2].name, "some.gp");
  const sim::TemporaryFolder folder;
  host::write_files(folder.path(), {files[2]});
  EXPECT_TRUE(host::run({"gnuplot", "some.gp"}, {.folder = folder.path()}).succeeded());
  EXPECT_EQ(host::read_file(folder.path() / "some.svg"), drawn.svg);
  // cairo writes the time into a PDF, so its bytes differ.
  EXPECT_EQ(host::read_file(folder.path() / "some.pdf").size(), drawn.pdf.size());
}

/// A scene may have any file's name.
TEST(Picture, TitleIsACommentOfOneLine) {
  Picture named = picture();
  named.title = "scene\nset output 'other' \\";
  EXPECT_THAT(picture_script(named, report_form),
              StartsWith("# scene set output 'other'  \n# gnuplot some.gp "));
}

TEST(Picture, IsDrawnInAnyTemporaryFolder) {
  const sim::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "it's temporary");
  const sim::EnvironmentValue variable("TMPDIR", (folder / "it's temporary").string());
  EXPECT_THAT(draw_picture("plot", picture(), report_form).svg, HasSubstr("<svg"));
}

std::string message_of(const Picture& drawn) {
  return hitpipe::message_of<std::runtime_error>(
      [&] { static_cast<void>(draw_picture("plot", drawn, report_form)); });
}

TEST(Picture, FailureRejected) {
  EXPECT_EQ(message_of(picture("plot nothing of the kind\n")), "plot: gnuplot failed with exit code 1");
}

TEST(Picture, MissingProgramRejected) {
  const sim::EnvironmentValue path("PATH", "/nowhere");
  EXPECT_EQ(message_of(picture()), "plot: gnuplot was not found; install the package gnuplot-nox");
}

}  // namespace
}  // namespace hitpipe::cli::picture_test
