// Materials of MTL files, and what they mean to the renderer.
#include "rays/files/mtl_reader.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/message_of.hpp"

namespace hitpipe::ref::mtl_reader_test {
namespace {

MtlMaterials read(std::string_view text) {
  MtlMaterials materials;
  EXPECT_EQ(read_mtl(text, materials), std::vector<std::string>());
  return materials;
}
/// Of the material m of a text.
std::optional<Material> surface(const std::string& lines) {
  return surface_of(read("newmtl m\n" + lines).at("m"));
}
/// Why a line behind "newmtl m" is left out.
std::vector<std::string> reasons(const std::string& line) {
  MtlMaterials materials;
  return read_mtl("# made by a test\nnewmtl m\n" + line, materials);
}

TEST(MtlReader, SurfacesAreWhatTheFileSays) {
  const auto red = surface("Kd 0.8 0.1 0.2\nKs 0.5 0.5 0.5\nillum 2\n");
  ASSERT_TRUE(red);
  EXPECT_EQ(red->albedo, glm::vec3(0.8F, 0.1F, 0.2F));
  EXPECT_EQ(red->reflect, glm::vec3(0.0F));  // highlights are no mirror
  // Ks is cut to 1. The parts add up to 1.25 at most, so all are divided by that.
  const auto mirror = surface("\tKd 0.25\n  Ks .75 0.5 1.5 # mirror\r\nillum 3\n");
  ASSERT_TRUE(mirror);
  EXPECT_EQ(mirror->albedo, glm::vec3(0.25F) / 1.25F);
  EXPECT_EQ(mirror->reflect, glm::vec3(0.75F, 0.5F, 1.0F) / 1.25F);
  const auto glass = surface("Kd 0.4 0.8 0.4\nd 0.25\nTf 1 0.5 1\nNi 1.5\nillum 6\n");
  ASSERT_TRUE(glass);
  EXPECT_EQ(glass->albedo, 0.25F * glm::vec3(0.4F, 0.8F, 0.4F));
  EXPECT_EQ(glass->transmit, glm::vec3(0.75F, 0.375F, 0.75F));
  EXPECT_EQ(glass->refractive_index, 1.5F);
}

TEST(MtlReader, OpacityIsDOrOneLessTr) {
  for (const char* const line : {"d 0.25", "d -halo 0.25", "Tr 0.75"}) {
    const auto made = surface(fmt::format("Kd 1 1 1\nNi 1.5\nillum 4\n{}\n", line));
    ASSERT_TRUE(made);
    EXPECT_EQ(made->transmit, glm::vec3(0.75F)) << line;
    EXPECT_EQ(made->refractive_index, 1.0F) << "it goes straight on";
  }
}

TEST(MtlReader, DIsStrongerThanTr) {
  for (const char* const lines : {"d 0.25\nTr 1\n", "Tr 1\nd 0.25\n", "Tr 0\nnewmtl m\nd 0.25\n"}) {
    const auto made = surface(fmt::format("Kd 1 1 1\n{}", lines));
    ASSERT_TRUE(made);
    EXPECT_EQ(made->transmit, glm::vec3(0.75F)) << lines;
  }
}

TEST(MtlReader, ColoursMayBeXyz) {
  const auto white = surface("Kd xyz 0.95047 1 1.08883\n");
  ASSERT_TRUE(white);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(white->albedo[k], 1, 1e-3);
  const auto made = surface("Ks xyz 0.3 0.4 0.5\nTf xyz 0.1\nd 0.5\nillum 3.0\n");
  ASSERT_TRUE(made);
  // Of IEC 61966-2-1: 3.2406 * 0.3 - 1.5372 * 0.4 - 0.4986 * 0.5 and so on.
  const glm::vec3 specular(0.108F, 0.48040F, 0.46361F);
  const glm::vec3 filter(0.12048F, 0.09484F, 0.09087F);
  const float sum = 0.3F + specular.y + 0.5F * filter.y;
  ASSERT_LT(sum, 1.0F);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(made->reflect[k], specular[k], 1e-4);
    EXPECT_NEAR(made->transmit[k], 0.5F * filter[k], 1e-4);
  }
}

TEST(MtlReader, WithoutColourIsNoSurface) {
  EXPECT_FALSE(surface(""));
  EXPECT_FALSE(surface("Ns 10\nmap_Kd wood.png\n"));
  const auto grey = surface("Ks 0 0 0\n");
  ASSERT_TRUE(grey);
  EXPECT_EQ(grey->albedo, glm::vec3(0.6F));
}

TEST(MtlReader, WordsThatAreNotReadAreSkipped) {
  const auto made = surface(
      "aniso x\nanisor 0\nadobe_metallic 1\nmap_Kd -s 1 1 1 a b.png\nnorm n.png\nPr 0.5\nPm q\nKa spectral "
      "a.rfl\n"
      "Kt 1\nsharpness 60\nKd 0.5 0.5 0.5\nrefl -type sphere c.png\n");
  ASSERT_TRUE(made);
  EXPECT_EQ(made->albedo, glm::vec3(0.5F));
}

TEST(MtlReader, NamesMayHaveBlanksAndLaterLinesReplace) {
  const MtlMaterials materials =
      read("Kd 9 9 9\nnewmtl  my red \nKd 0.1 0 0\nnewmtl b\nKd 0.2 0 0\nnewmtl my red\nKd 0.3 0 0\n");
  ASSERT_EQ(materials.size(), 2U);
  EXPECT_EQ(materials.at("my red").diffuse, glm::vec3(0.3F, 0, 0));
  EXPECT_EQ(materials.at("b").diffuse, glm::vec3(0.2F, 0, 0));
}

TEST(MtlReader, OddNumbersStayInRange) {
  const auto made = surface("Kd -1 nan 1e30\nKs inf 0 0\nd -3\nNi 0\nillum 6\n");
  ASSERT_TRUE(made);
  for (int k = 0; k < 3; ++k) {
    EXPECT_GE(made->albedo[k], 0.0F);
    EXPECT_LE(made->albedo[k] + made->reflect[k] + made->transmit[k], 1.0F);
  }
  EXPECT_EQ(made->refractive_index, 1.0F);
}

TEST(MtlReader, ValuesThatAreNotReadAreLeftOut) {
  for (const auto& [line, text, word] :
       std::vector<std::array<const char*, 3>>{{"Kd 0,5 0 0", "0,5", "Kd"},
                                               {"Ks", "", "Ks"},
                                               {"Tf 1 0.5", "", "Tf"},
                                               {"Kd spectral a.rfl 0.5", "spectral", "Kd"},
                                               {"Tf spectral a.rfl", "spectral", "Tf"},
                                               {"Ks xyz 1 x 1", "x", "Ks"},
                                               {"d -halo", "", "d"},
                                               {"Tr x", "x", "Tr"},
                                               {"Ni", "", "Ni"},
                                               {"Ni 1.5.2", "1.5.2", "Ni"}})
    EXPECT_EQ(
        reasons(line),
        (std::vector<std::string>{fmt::format("line 3: \"{}\" behind {} is not a number", text, word)}));
  for (const char* const text : {"", "11", "-1", "2.5", "x"})
    EXPECT_EQ(reasons(fmt::format("illum {}\n", text)),
              (std::vector<std::string>{
                  fmt::format("line 3: \"{}\" behind illum is no model, which are 0 to 10", text)}));
  MtlMaterials materials;
  EXPECT_EQ(read_mtl("newmtl m\nKd 1 0 0\nKd x\nillum 11\nNi 2\n", materials).size(), 2U);
  EXPECT_EQ(materials.at("m").diffuse, glm::vec3(1, 0, 0));
  EXPECT_EQ(materials.at("m").index, 2.0F);
}

TEST(MtlReader, AFileThatIsUtf16IsNamed) {
  MtlMaterials materials;
  EXPECT_EQ(message_of([&] { static_cast<void>(read_mtl(std::string_view("\xFF\xFEn\0", 4), materials)); }),
            "is UTF-16 or UTF-32, not text in UTF-8 or ASCII; save it as UTF-8");
}

}  // namespace
}  // namespace hitpipe::ref::mtl_reader_test
