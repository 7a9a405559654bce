// A folder of units: written again, it has what the new run writes, the user's files and other units.
#include "rtl_gen/emit/unit_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/emit/manifest.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/tool.hpp"
#include "tests/sim/environment.hpp"

namespace hitpipe::rtl::unit_folder_test {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::Not;

class UnitFolder : public testing::Test {
 protected:
  UnitFolder() { fs::create_directory(folder); }

  UnitFiles write(const DesignFormat& d, const EmitOptions& options = {},
                  const UnitOptions& of_unit = {}) const {
    return write_unit(folder, d.emitted(options, of_unit));
  }
  [[nodiscard]] bool has(const std::string& name) const { return fs::exists(folder / name); }
  /// Adds a name to the list of a manifest.
  void list(const std::string& manifest, const std::string& name) const {
    Json json = Json::parse(read_text(folder / manifest));
    json.at("files").push_back(name);
    write_text(folder / manifest, json.dump());
  }

  const ScratchFolder outside;
  const fs::path folder = outside / "rtl";
};

TEST_F(UnitFolder, ManifestListsEveryFileThatIsWritten) {
  const UnitFiles written = write({"int_slabs", "12/12"}, {.axi_stream = true, .hls = true});
  EXPECT_TRUE(written.drawn);
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), folder).string());
  EXPECT_THAT(head_of(read_text(folder / "int_slabs_12_12.json")).files,
              testing::UnorderedElementsAreArray(files));
  EXPECT_THAT(files, Contains("int_slabs_12_12_stage_1.svg"));
  EXPECT_EQ(files.size(), written.files.size());
}

TEST_F(UnitFolder, WrittenAgainHasOnlyWhatIsAskedFor) {
  write({"int_slabs", "12/12"}, {.axi_stream = true, .hls = true});
  EXPECT_TRUE(has("int_slabs_12_12_axis.v"));
  EXPECT_TRUE(has("hls/int_slabs_12_12.cpp"));
  write({"int_slabs", "12/12"});
  EXPECT_FALSE(has("int_slabs_12_12_axis.v"));
  EXPECT_FALSE(has("hls")) << "nothing is left in it";
  EXPECT_TRUE(has("int_slabs_12_12.v"));
  EXPECT_TRUE(has("tb/int_slabs_12_12_tb.sv"));
}

TEST_F(UnitFolder, AnotherDesignUnderTheSameNameLeavesNothingOfTheFirst) {
  write({"int_slabs", "12/12"}, {}, {.module = "box_test"});
  EXPECT_TRUE(has("box_test_stages_2-3.dot"));
  write({"fp_slabs", "fp32"}, {}, {.module = "box_test"});
  EXPECT_FALSE(has("box_test_stages_2-3.dot"));
  EXPECT_FALSE(has("box_test_stages_2-3.svg"));
  EXPECT_TRUE(has("box_test_stages_8-12.dot"));
}

TEST_F(UnitFolder, FilesOfTheUserStay) {
  write({"int_slabs", "12/12"}, {.axi_stream = true, .hls = true});
  write_text(folder / "top.v", "mine");
  write_text(folder / "int_slabs_12_12_notes.txt", "mine");
  write_text(folder / "hls" / "mine.cpp", "mine");
  write({"int_slabs", "12/12"});
  for (const char* const name : {"top.v", "int_slabs_12_12_notes.txt", "hls/mine.cpp"})
    EXPECT_TRUE(has(name)) << name;
  EXPECT_FALSE(has("hls/int_slabs_12_12.cpp"));
}

TEST_F(UnitFolder, UnitsOfOtherNamesStay) {
  write({"int_slabs", "12/12"}, {.axi_stream = true});
  write({"int_slabs", "6/6"}, {.axi_stream = true});
  list("int_slabs_6_6.json", "both.txt");
  list("int_slabs_12_12.json", "both.txt");
  write_text(folder / "both.txt", "listed by two manifests");
  write({"int_slabs", "6/6"});
  EXPECT_FALSE(has("int_slabs_6_6_axis.v"));
  EXPECT_TRUE(has("both.txt"));
  for (const std::string& name : head_of(read_text(folder / "int_slabs_12_12.json")).files)
    EXPECT_TRUE(has(name)) << name;
  write({"int_slabs", "12/12"});
  EXPECT_FALSE(has("both.txt")) << "the last that listed it";
}

TEST_F(UnitFolder, NothingIsRemovedOutsideTheFolder) {
  write({"int_slabs", "6/6"});
  write_text(outside / "x", "not ours");
  fs::create_directory(outside / "other");
  write_text(outside / "other" / "y", "not ours");
  fs::create_directory_symlink(outside / "other", folder / "link");
  fs::create_symlink(outside / "x", folder / "file_link");
  fs::create_directories(folder / "empty");
  fs::create_directories(folder / "tb" / "deep");
  for (const std::string& name :
       {std::string("../x"), std::string("tb/../../x"), (outside / "x").string(), std::string("link/y"),
        std::string("file_link"), std::string("empty"), std::string("tb"), std::string(""), std::string(".")})
    list("int_slabs_6_6.json", name);
  write({"int_slabs", "6/6"});
  EXPECT_TRUE(fs::exists(outside / "x"));
  EXPECT_TRUE(fs::exists(outside / "other" / "y"));
  for (const char* const name : {"link", "file_link", "empty", "tb/deep"}) EXPECT_TRUE(has(name)) << name;
}

TEST_F(UnitFolder, ADamagedManifestListsNothing) {
  for (const char* const text : {"no JSON", "{}", R"({"files": 3})"}) {
    write({"int_slabs", "6/6"}, {.axi_stream = true});
    write_text(folder / "int_slabs_6_6.json", text);
    write({"int_slabs", "6/6"});
    EXPECT_TRUE(has("int_slabs_6_6_axis.v")) << text;
  }
}

TEST_F(UnitFolder, WithoutGraphvizAllButThePicturesAreWritten) {
  write({"int_slabs", "6/6"});
  EXPECT_TRUE(has("int_slabs_6_6_stage_1.svg"));
  const sim::EnvironmentValue path("PATH", "/nowhere");
  const UnitFiles written = write({"int_slabs", "6/6"});
  EXPECT_FALSE(written.drawn);
  EXPECT_EQ(written.files.size(), (DesignFormat{"int_slabs", "6/6"}.emitted().files().size()));
  EXPECT_TRUE(has("int_slabs_6_6_stage_1.dot"));
  EXPECT_FALSE(has("int_slabs_6_6_stage_1.svg")) << "the old picture";
  EXPECT_THAT(head_of(read_text(folder / "int_slabs_6_6.json")).files,
              Not(Contains("int_slabs_6_6_stage_1.svg")));
}

}  // namespace
}  // namespace hitpipe::rtl::unit_folder_test
