// --answers: a line for each ray of a file, by each command that traces them. A square in two triangles faces
// the eye. A triangle without area stands before them in the file, and another triangle lies behind the square.
#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/text.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::answers_test {
namespace {

namespace fs = std::filesystem;
using Line = std::map<std::string, std::string>;

/// Triangle 0 has no area. 1 and 2 are a square in z = 0 and share the diagonal x = y. 3 lies in z = -1.
constexpr const char* mesh =
    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\n"
    "f 1 1 2\nf 1 2 3\nf 1 3 4\nf 5 6 7\n";

constexpr const char* rays =
    "ox,oy,oz,dx,dy,dz,length,any\n"
    "0.5,-0.5,2,0,0,-1,inf,0\n"       // 0: triangle 1
    "0.25,0.25,2,0,0,-2,inf,0\n"      // 1: the shared edge, so the lower number
    "0,3,2,0,0,-1,inf,0\n"            // 2: a miss
    "-0.5,0.5,2,0,0,-1,1.5,0\n"       // 3: ends before triangle 2
    "0.5,-0.25,2,0,0,-1,inf,1\n"      // 4: any hit
    "0,3,2,0,0,-1,inf,1\n"            // 5: any hit, a miss
    "-0.5,-0.25,-0.5,0,0,-1,inf,0\n"  // 6: starts behind the square
    "-0.25,0.5,8,0,0,-1,inf,0\n";     // 7: starts outside the cube

const std::string columns =
    "ray,query,hit,number,face,t,distance,w0,w1,w2,exact_hit,exact_number,exact_face,exact_t,exact_distance";

class Answers : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("mesh.obj", mesh);
    folder_.write("rays.csv", rays);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path() / name).string(); }

  /// Of a command that must end with this exit code.
  [[nodiscard]] std::vector<Line> lines(const std::string& command, const std::string& header = columns,
                                        int exit_code = 0, const Variables& variables = {}) const {
    const Outcome outcome = hitpipe(command + " --scene " + file("mesh.obj") +
                                        " --eye 0,0,3 --target 0,0,0 --light 0,0,3 --rays " +
                                        file("rays.csv") + " --answers " + file("answers.csv"),
                                    variables);
    EXPECT_EQ(outcome.exit_code, exit_code) << command << '\n' << outcome.err;
    const std::vector<std::string> text = lines_of(contents_of(file("answers.csv")));
    EXPECT_EQ(text.at(0), header) << command;
    const std::vector<std::string> names = host::csv_cells(text.at(0));
    std::vector<Line> made;
    for (std::size_t i = 1; i < text.size(); ++i) {
      const std::vector<std::string> cells = host::csv_cells(text[i]);
      EXPECT_EQ(cells.size(), names.size()) << text[i];
      Line& line = made.emplace_back();
      for (std::size_t j = 0; j < std::min(cells.size(), names.size()); ++j) line[names[j]] = cells[j];
    }
    const auto notes = nlohmann::json::parse(contents_of(file("answers.csv-metadata.json")));
    EXPECT_EQ(notes.at("url"), "answers.csv");
    EXPECT_EQ(notes.at("tableSchema").at("columns").size(), names.size());
    return made;
  }

  const sim::TemporaryFolder folder_;
};

std::string text_of(const Line& line, const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name + "=" + line.at(name);
  return text;
}

/// What does not depend on the world.
void expect_known_triangles(const std::vector<Line>& lines, const std::string& of) {
  ASSERT_EQ(lines.size(), 8U) << of;
  const std::vector<std::string> known{"nearest 1 1 1 1", "nearest 1 1 1 1", "nearest 0  0 ",
                                       "nearest 0  0 ",   "any 1 1 1 1",     "any 0  0 ",
                                       "nearest 1 3 1 3", "nearest 1 2 1 2"};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    EXPECT_EQ(line.at("ray"), std::to_string(i)) << of;
    EXPECT_EQ(line.at("query") + " " + line.at("hit") + " " + line.at("number") + " " + line.at("exact_hit") +
                  " " + line.at("exact_number"),
              known[i])
        << of << ": ray " << i;
    for (const char* const name : {"distance", "w0", "w1", "w2", "exact_distance"})
      EXPECT_EQ(line.at(name).empty(), line.at("hit") == "0") << of << ": ray " << i << ' ' << name;
    EXPECT_EQ(line.at("t"), line.at("exact_t")) << of << ": ray " << i;
    EXPECT_EQ(line.at("distance"), line.at("exact_distance")) << of << ": ray " << i;
  }
}

void expect_known_floats(const std::vector<Line>& lines, const std::string& of) {
  expect_known_triangles(lines, of);
  const std::map<std::size_t, std::string> known{{0, "t= distance=2 w0=0.25 w1=0.5 w2=0.25"},
                                                 {1, "t= distance=1 w0=0.375 w1=0 w2=0.625"},
                                                 {4, "t= distance=2 w0=0.25 w1=0.375 w2=0.375"},
                                                 {6, "t= distance=0.5 w0=0.375 w1=0.25 w2=0.375"},
                                                 {7, "t= distance=8 w0=0.25 w1=0.375 w2=0.375"}};
  for (const auto& [ray, text] : known)
    EXPECT_EQ(text_of(lines.at(ray), {"t", "distance", "w0", "w1", "w2"}), text) << of << ": ray " << ray;
}

/// The cube holds x, y = -1..1 and z = -1..3, so a unit is 1023/2048 of it. The origin's grid has 524,286
/// steps from 0 to 1, and the corners' grid half of them: z = 2 is at 261,887, the square at 2 * -130,944.
void expect_known_integers(const std::vector<Line>& lines, const std::string& of) {
  expect_known_triangles(lines, of);
  EXPECT_EQ(lines.at(0).at("t"), "523775") << of;
  EXPECT_EQ(lines.at(1).at("t"), "523775") << of;
  EXPECT_EQ(lines.at(1).at("w1"), "0") << of;
  const std::map<std::size_t, double> distances{{0, 2}, {1, 1}, {4, 2}, {6, 0.5}, {7, 8}};
  for (const auto& [ray, distance] : distances) {
    EXPECT_NEAR(std::stod(lines.at(ray).at("distance")), distance, 1e-5) << of << ": ray " << ray;
    double sum = 0;
    for (const char* const weight : {"w0", "w1", "w2"}) sum += std::stod(lines.at(ray).at(weight));
    EXPECT_NEAR(sum, 1, 1e-8) << of << ": ray " << ray;
  }
  EXPECT_NEAR(std::stod(lines.at(0).at("w1")), 0.5, 1e-5) << of;
  EXPECT_NEAR(std::stod(lines.at(7).at("w0")), 0.25, 1e-5) << of;
}

TEST_F(Answers, OfRenderAreKnownInBothWorlds) {
  expect_known_floats(lines("render"), "render");
  expect_known_floats(lines("render --encoding wide8 --traversal slabs-dist --bundle 1"), "wide8");
  expect_known_floats(lines("render --bundle 64 --threads 2"), "bundles");
  expect_known_floats(lines("render --arithmetic integer --bits 12/12"), "12/12");
  expect_known_integers(lines("render --world integer"), "integer world");
}

TEST_F(Answers, OfCosimAreKnownInBothWorlds) {
  expect_known_floats(lines("cosim int_slabs --bits 12/12"), "int_slabs");
  expect_known_integers(lines("cosim int_triangle"), "int_triangle");
}

TEST_F(Answers, OfACoreHaveALineForEachNumberOfRaysInFlight) {
  for (const std::string more : {"", " --parts 3"}) {
    const std::vector<Line> both =
        lines("core trace --native --rays-in-flight 1,4" + more, "rays_in_flight," + columns);
    ASSERT_EQ(both.size(), 16U);
    for (std::size_t core = 0; core < 2; ++core) {
      const auto first = both.begin() + static_cast<std::ptrdiff_t>(8 * core);
      for (auto line = first; line != first + 8; ++line)
        EXPECT_EQ(line->at("rays_in_flight"), core == 0 ? "1" : "4");
      expect_known_integers({first, first + 8}, "core" + more);
    }
  }
}

TEST_F(Answers, OfASweepSayWhichUnitAnswered) {
  const std::string header = "design,bits,rays_in_flight,ii," + columns;
  const std::vector<Line> all =
      lines("sweep int_slabs,fp_slabs --bits int_slabs=12/12 --rays-in-flight 4,8 --out " + file("rows.csv"),
            header);
  const std::vector<std::string> units{"fp_slabs fp32 4 1", "fp_slabs fp32 8 1", "int_slabs 12/12 4 1",
                                       "int_slabs 12/12 8 1"};
  ASSERT_EQ(all.size(), 8 * units.size());
  for (std::size_t unit = 0; unit < units.size(); ++unit) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(8 * unit);
    for (auto line = first; line != first + 8; ++line)
      EXPECT_EQ(line->at("design") + " " + line->at("bits") + " " + line->at("rays_in_flight") + " " +
                    line->at("ii"),
                units[unit]);
    expect_known_floats({first, first + 8}, units[unit]);
  }
  // The rows are there now, so nothing would be measured.
  const Outcome again =
      hitpipe("sweep int_slabs --scene " + file("mesh.obj") + " --rays " + file("rays.csv") + " --answers " +
              file("again.csv") + " --out " + file("rows.csv"));
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_EQ(again.err, "hitpipe: --answers: rows that " + file("rows.csv") +
                           " holds are not measured again; remove it or give another --out\n");
  EXPECT_FALSE(fs::exists(file("again.csv")));
}

/// The ray of docs/check.md grazes the box within the rounding of binary32.
TEST_F(Answers, ShowAFalseMiss) {
  folder_.write("mesh.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n");
  folder_.write("rays.csv",
                "ox,oy,oz,dx,dy,dz,any\n0,0.5,2,0,0,-1,0\n0.1,0.4,2.8,4.5,1.5,-14,0\n"
                "0.1,0.4,2.8,4.5,1.5,-14,1\n");
  for (const std::string command : {"cosim fp_slabs --padding 0", "render --arithmetic float --padding 0"}) {
    const std::vector<Line> answers = lines(command, columns, command.starts_with("cosim") ? 1 : 0);
    ASSERT_EQ(answers.size(), 3U);
    const std::vector<std::string> names{"hit", "number", "distance", "w0", "exact_hit", "exact_number"};
    EXPECT_EQ(text_of(answers[0], {"hit", "number", "exact_hit"}), "hit=1 number=1 exact_hit=1") << command;
    for (const std::size_t ray : {1U, 2U}) {
      EXPECT_EQ(text_of(answers[ray], names), "hit=0 number= distance= w0= exact_hit=1 exact_number=0")
          << command;
      EXPECT_NEAR(std::stod(answers[ray].at("exact_distance")), 0.2, 1e-7) << command;
    }
  }
}

/// Answers are the Verilog's, also where it is wrong.
TEST_F(Answers, AreThoseOfTheVerilog) {
  const Variables wrong{{"VERILATOR", always_missing_verilator(folder_)}};
  const std::vector<Line> answers = lines("cosim int_slabs --bits 12/12", columns, 1, wrong);
  ASSERT_EQ(answers.size(), 8U);
  for (const Line& line : answers) EXPECT_EQ(line.at("hit"), "0") << line.at("ray");
  EXPECT_EQ(answers[0].at("exact_number"), "1");
}

TEST_F(Answers, RenderCountsTheRaysOfAFile) {
  const Outcome outcome = hitpipe("render --format json --arithmetic float --padding 0 --scene " +
                                  file("mesh.obj") + " --rays " + file("rays.csv"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto row = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(row.at("rays_primary"), 6);
  EXPECT_EQ(row.at("rays_shadow"), 2);
  EXPECT_EQ(row.at("different_triangles"), 0);
  EXPECT_GE(row.at("box_tests"), 8);
  EXPECT_FALSE(row.contains("rays_secondary"));
}

}  // namespace
}  // namespace hitpipe::cli::answers_test
