// `hitpipe operands`: files from rays and boxes, the counts, what is refused, and the examples of
// docs/operands.md.
#include <cstdlib>
#include <map>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/catalogue/design.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::operands_command_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

const std::string two_rays = "ox,oy,oz,dx,dy,dz,length\n-0.5,0,0,1,0,0,inf\n-0.5,0,0,-1,0.25,0.125,2\n";
const std::string two_boxes =
    "min_x,min_y,min_z,max_x,max_y,max_z\n0,-0.5,-0.5,0.5,0.5,0.5\n0,-0.5,-0.5,0.5,0.5,0.5\n";

class OperandsCommand : public testing::Test {
 protected:
  void SetUp() override { fs::create_directory(results_); }

  [[nodiscard]] Outcome operands(const std::string& out, const std::vector<std::string>& more = {},
                                 const std::string& design = "int_slabs") const {
    return run_hitpipe(with({"operands", design, "--rays", rays_, "--boxes", boxes_, "--out", out}, more));
  }
  [[nodiscard]] std::string out(const std::string& name) const { return (results_ / name).string(); }
  void rejected(const Outcome& outcome, const std::string& message) const {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "hitpipe: " + message + "\n");
    EXPECT_TRUE(fs::is_empty(results_));
  }

  const sim::TemporaryFolder folder_;
  const fs::path results_ = folder_.path() / "results";
  std::string rays_ = folder_.write("rays.csv", two_rays).string();
  std::string boxes_ = folder_.write("boxes.csv", two_boxes).string();
};

TEST_F(OperandsCommand, WritesCsvAndPrintsTheCounts) {
  const Outcome outcome = operands(out("o.csv"));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out,
            "design        int_slabs\n"
            "bits          20/24\n"
            "tests         2\n"
            "hits          1\n"
            "exact_hits    1\n"
            "false_hits    0\n"
            "false_misses  0\n"
            "operands      " +
                out("o.csv") + "\n");
  const auto lines = lines_of(contents_of(out("o.csv")));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(
      lines[0],
      "ray,box,irx,iry,irz,irlen,iri_floor,iri_ceil,irj_floor,irj_ceil,irk_floor,irk_ceil,rinf,ixmin,ixmax,"
      "iymin,iymax,izmin,izmax,hit,exact_hit");
  EXPECT_THAT(lines[1], StartsWith("1,1,-131071,0,0,"));
  EXPECT_THAT(lines[1], testing::EndsWith(",1,1"));
  EXPECT_THAT(lines[2], testing::EndsWith(",0,0"));
}

TEST_F(OperandsCommand, StandardOutputHasTheTestsAndStandardErrorTheCounts) {
  const Outcome file = operands(out("o.csv"), {"--format", "json"});
  const Outcome stream = operands("-", {"--format", "json"});
  EXPECT_EQ(stream.exit_code, 0);
  EXPECT_EQ(stream.out, contents_of(out("o.csv")));
  auto counts = nlohmann::json::parse(file.out);
  counts.erase("operands");
  EXPECT_EQ(nlohmann::json::parse(stream.err), counts);
}

TEST_F(OperandsCommand, ReadsStandardInput) {
  const fs::path file = folder_.path() / "piped.csv";
  const std::string command = fmt::format("cat {} | {} operands int_slabs --rays - --boxes {} --out {} >{}",
                                          rays_, HITPIPE_PROGRAM, boxes_, file.string(), out("counts"));
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(contents_of(file), operands("-").out);
}

TEST_F(OperandsCommand, JsonHasTheColumnsOfTheCsv) {
  const auto lines = lines_of(operands("-", {"--as", "json", "--with-input"}, "fp_slabs").out);
  const auto csv = lines_of(operands("-", {"--with-input"}, "fp_slabs").out);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(nlohmann::json::parse(lines[0]),
            nlohmann::json::parse(R"({"design":"fp_slabs","bits":"fp32","scale":1,"offset":[0,0,0]})"));
  std::string names;
  std::string values;
  const auto test = nlohmann::ordered_json::parse(lines[1]);
  for (const auto& [name, value] : test.items()) {
    names += (names.empty() ? "" : ",") + name;
    values += (values.empty() ? "" : ",") + (value.is_string() ? value.get<std::string>() : value.dump());
  }
  EXPECT_EQ(names, csv[0]);
  EXPECT_EQ(values, csv[1]);
  EXPECT_EQ(test["rx"], "0xbf000000");
  EXPECT_EQ(test["ox"], "-0x1p-1");
}

TEST_F(OperandsCommand, RecordsScaleAndOffsetOfTheBounds) {
  boxes_ =
      folder_.write("far.csv", "min_x,min_y,min_z,max_x,max_y,max_z\n100,100,100,300,200,200\n").string();
  rays_ = folder_.write("near.csv", "ox,oy,oz,dx,dy,dz\n100,150,150,1,0,0\n").string();
  const std::vector<std::string> bounds{"--bounds", "100,100,100,300,200,200", "--with-input"};
  ASSERT_EQ(operands(out("o.csv"), bounds).exit_code, 0);
  const auto csv = lines_of(contents_of(out("o.csv")));
  ASSERT_EQ(csv.size(), 2U);
  const auto about = nlohmann::json::parse(contents_of(out("o.csv-metadata.json")));
  EXPECT_EQ(about.at("url"), "o.csv");
  const auto& notes = about.at("notes").at(0);
  EXPECT_EQ(notes.at("design"), "int_slabs");
  EXPECT_EQ(notes.at("bits"), "20/24");
  EXPECT_EQ(notes.at("offset"), (nlohmann::json{200, 150, 150}));
  EXPECT_EQ(notes.at("scale"), 0.009990234375);
  EXPECT_THAT(notes.at("command").get<std::string>(),
              StartsWith("hitpipe operands int_slabs --rays " + rays_ + " --boxes "));
  EXPECT_THAT(csv[1], StartsWith("1,1,-0x1.ff8p-1,0x0p+0,0x0p+0,0x1p+0,0x0p+0,0x0p+0,inf,"));
  EXPECT_THAT(csv[1], testing::EndsWith(",1,1"));
}

/// The testbench that is written with the unit runs them in place of its own, which are as many.
TEST_F(OperandsCommand, HexReplacesTheVectorsOfTheTestbench) {
  for (const std::string design : {"int_slabs", "int_major"}) {
    const std::string rtl = out(design);
    ASSERT_EQ(run_hitpipe({"rtl", design, "--out", rtl}).exit_code, 0);
    const std::string hex = rtl + "/tb/" + design + "_vectors.hex";
    std::size_t vectors = 0;
    for (const std::string& line : lines_of(contents_of(hex))) vectors += line.starts_with("//") ? 0U : 1U;
    ASSERT_GT(vectors, 0U);
    std::string rays = "ox,oy,oz,dx,dy,dz,length\n";
    std::string boxes = "min_x,min_y,min_z,max_x,max_y,max_z\n";
    for (std::size_t i = 0; i < vectors; ++i) {
      const double x = static_cast<double>(i) / static_cast<double>(vectors);
      rays += fmt::format("{},0.25,-1,{},-0.125,1,{}\n", -x, x + 0.5, 1 + x);
      boxes += fmt::format("{},-0.5,-0.25,{},0.5,{}\n", -x, 1 - x, x);
    }
    rays_ = folder_.write("many_rays.csv", rays).string();
    boxes_ = folder_.write("many_boxes.csv", boxes).string();
    const Outcome made = operands(hex, {"--format", "json"}, design);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_GT(nlohmann::json::parse(made.out)["hits"], vectors / 10);
    const std::string command =
        fmt::format("cd {}/tb && iverilog -g2012 -o tb *_tb.*v ../{}.v && vvp tb >log", rtl, design);
    EXPECT_EQ(std::system(command.c_str()), 0);
    EXPECT_THAT(contents_of(rtl + "/tb/log"), HasSubstr(fmt::format("PASS {} vectors", vectors)));
  }
}

TEST_F(OperandsCommand, BadLineRejectedAndNothingIsWritten) {
  rays_ = folder_.write("bad.csv", two_rays + "0,0,0,0,0,0,1\n").string();
  boxes_ = folder_.write("three.csv", two_boxes + "0,0,0,1,1,1\n").string();
  rejected(operands(out("o.csv")),
           rays_ + ": line 4: the direction is (0, 0, 0) in binary32; one component must differ from 0");
}

/// Its own output is an input: the operands give the same results.
TEST_F(OperandsCommand, OfOnesOwnGetTheResultsOfTheUnit) {
  ASSERT_EQ(operands(out("o.csv")).exit_code, 0);
  const std::string words = "operands int_slabs --operands " + out("o.csv") + " --out ";
  EXPECT_EQ(
      printed(words + out("r.csv")),
      "design    int_slabs\nbits      20/24\ntests     2\nhits      1\noperands  " + out("r.csv") + "\n");
  const auto judged = lines_of(contents_of(out("o.csv")));
  const auto answered = lines_of(contents_of(out("r.csv")));
  ASSERT_EQ(answered.size(), judged.size());
  EXPECT_EQ("ray,box," + answered[0] + ",exact_hit", judged[0]);
  EXPECT_EQ("1,1," + answered[1] + ",1", judged[1]);
  EXPECT_THAT(hitpipe(words + "- --as json").out, HasSubstr("{\"irx\":-131071,\"iry\":0,"));
}

TEST_F(OperandsCommand, OneBoxIsTooFewForADesignOfTwo) {
  rejected(
      operands(out("o.csv"), {}, "int_major_pair"),
      boxes_ +
          ": line 1: column \"min_x\" is not known; the first line must name the columns "
          "min_x_0,min_y_0,min_z_0,max_x_0,max_y_0,max_z_0,min_x_1,min_y_1,min_z_1,max_x_1,max_y_1,max_z_1");
}

/// The page with the section of the foreign design, cut into its blocks of code and its sections.
class Page {
 public:
  Page() {
    std::istringstream page(contents_of(HITPIPE_SOURCE "/docs/operands.md") +
                            contents_of(HITPIPE_SOURCE "/tests/foreign_design/docs/operands.md"));
    std::string section;
    std::string before;
    std::string language;
    for (std::string line; std::getline(page, line);) {
      if (line.starts_with("```")) {
        const bool begins = language.empty();
        language = begins ? line.substr(3) : "";
        if (begins) blocks_.push_back({language, before, ""});
      } else if (!language.empty()) {
        blocks_.back().text += line + "\n";
      } else if (line.starts_with("#")) {
        section = line.substr(line.find_first_not_of("# "));
      }
      if (language.empty() && !line.empty()) before = line;
      sections_[section] += line + "\n";
    }
  }

  struct Block {
    std::string language;
    std::string before;  ///< the line above it
    std::string text;
  };
  [[nodiscard]] const std::vector<Block>& blocks() const { return blocks_; }
  [[nodiscard]] std::string section(const std::string& title) const {
    const auto found = sections_.find(title);
    return found == sections_.end() ? "" : found->second;
  }

 private:
  std::vector<Block> blocks_;
  std::map<std::string, std::string> sections_;
};

std::string without_blanks(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0; });
  return text;
}

TEST(OperandsPage, ShowsWhatItsCommandsPrint) {
  const sim::TemporaryFolder folder;
  const Page page;
  std::size_t examples = 0;
  for (std::size_t i = 0; i < page.blocks().size(); ++i) {
    const Page::Block& block = page.blocks()[i];
    if (block.language == "csv") folder.write(block.before.substr(1, block.before.size() - 2), block.text);
    if (block.language != "json") continue;
    std::istringstream words(page.blocks()[i - 1].text);
    std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
    ASSERT_EQ(arguments.at(0), "build/hitpipe");
    arguments.erase(arguments.begin());
    for (std::string& word : arguments)
      if (word.ends_with(".csv")) word = (folder.path() / word).string();
    const Outcome outcome = run_hitpipe(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(without_blanks(block.text), without_blanks(outcome.out)) << arguments[1];
    ++examples;
  }
  const auto& all = rtl::designs();
  EXPECT_EQ(std::ssize(all) - std::ranges::count(all, false, [](const auto& d) { return d.kind.of_boxes; }),
            static_cast<std::ptrdiff_t>(examples));
}

TEST(OperandsPage, NamesEveryPortOfEveryDesign) {
  const Page page;
  for (const rtl::Design& design : rtl::designs()) {
    const std::string section = page.section(std::string(design.name));
    for (const rtl::Port& port : design.ports(design.default_format))
      EXPECT_THAT(section, HasSubstr("`" + port.name + "`")) << design.name;
  }
}

}  // namespace
}  // namespace hitpipe::cli::operands_command_test
