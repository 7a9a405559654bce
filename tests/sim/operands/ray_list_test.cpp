// Lists of rays: CSV and binary say the same, rays are moved into the cube, and each wrong file gets a line.
#include "sim/operands/ray_list.hpp"

#include <bit>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rays/exact/box_referee.hpp"
#include "sw_ref/scene/noise.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::ray_list_test {
namespace {

constexpr float inf = ref::Ray::infinite;
const ref::Normalisation unmoved{};

std::string little_endian(std::uint64_t word, std::size_t bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i) text += static_cast<char>(word >> (8 * i) & 0xff);
  return text;
}

std::string in_binary(const AskedRay& asked) {
  const ref::Ray& ray = asked.ray;
  std::string text;
  for (const float number : {ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
                             ray.direction.z, ray.length})
    text += little_endian(std::bit_cast<std::uint32_t>(number), 4);
  return text + little_endian(asked.query == ref::Query::any ? 1 : 0, 4);
}

std::string in_binary(const std::vector<AskedRay>& rays) {
  std::string text = "hprays1\n" + little_endian(rays.size(), 8);
  for (const AskedRay& asked : rays) text += in_binary(asked);
  return text;
}

std::string in_csv(const std::vector<AskedRay>& rays) {
  std::string text = "ox,oy,oz,dx,dy,dz,length,any\n";
  for (const AskedRay& asked : rays) {
    const ref::Ray& ray = asked.ray;
    text +=
        fmt::format("{},{},{},{},{},{},{},{}\n", ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x,
                    ray.direction.y, ray.direction.z, ray.length, asked.query == ref::Query::any ? 1 : 0);
  }
  return text;
}

std::vector<AskedRay> random_rays() {
  ref::Dice dice(3);
  std::vector<AskedRay> rays(200);
  for (AskedRay& asked : rays) {
    for (int axis = 0; axis < 3; ++axis) {
      asked.ray.origin[axis] = static_cast<float>(dice.between(-1.0, 1.0));
      asked.ray.direction[axis] = static_cast<float>(dice.between(-9.0, 9.0));
    }
    if (dice.chance(0.5)) asked.ray.length = static_cast<float>(dice.between(0.0, 3.0));
    if (dice.chance(0.5)) asked.query = ref::Query::any;
  }
  return rays;
}

class RayList : public testing::Test {
 protected:
  [[nodiscard]] std::vector<AskedRay> read(const std::string& name, const std::string& text,
                                           const ref::Normalisation& to_cube = unmoved) const {
    return read_ray_list(folder_.write(name, text).string(), to_cube);
  }
  [[nodiscard]] ref::Ray ray(const std::string& cells, const ref::Normalisation& to_cube = unmoved) const {
    return read("r.csv", "ox,oy,oz,dx,dy,dz,length\n" + cells + "\n", to_cube).at(0).ray;
  }
  /// What is said of a file without its name.
  void rejected(const std::string& name, const std::string& text, const std::string& message,
                const ref::Normalisation& to_cube = unmoved) const {
    EXPECT_EQ(message_of<std::runtime_error>([&] { (void)read(name, text, to_cube); }),
              (folder_.path() / name).string() + ": " + message);
  }

  const TemporaryFolder folder_;
};

TEST_F(RayList, IsTheSameInCsvAndInBinary) {
  const std::vector<AskedRay> rays = random_rays();
  for (const std::vector<AskedRay>& again :
       {read("r.csv", in_csv(rays)), read("r.txt", in_csv(rays)), read("r.bin", in_binary(rays)),
        read("r.rays", in_binary(rays))}) {
    ASSERT_EQ(again.size(), rays.size());
    EXPECT_EQ(in_binary(again), in_binary(rays));
  }
}

TEST_F(RayList, ColumnsHaveAnyOrderAndTheLastTwoMayBeMissing) {
  const AskedRay one = read("r.csv", "dz,dx,dy,oz,oy,ox\n# a comment\n3,1,2,0.75,0.5,0.25\n").at(0);
  EXPECT_EQ(one.ray.origin, glm::vec3(0.25F, 0.5F, 0.75F));
  EXPECT_EQ(one.ray.direction, glm::vec3(1.0F, 2.0F, 3.0F));
  EXPECT_EQ(one.ray.length, inf);
  EXPECT_EQ(one.query, ref::Query::closest);
  EXPECT_EQ(read("r.csv", "any,ox,oy,oz,dx,dy,dz\n1,0,0,0,1,0,0\n").at(0).query, ref::Query::any);
}

/// Points of a ray move with the scene, and its direction stays.
TEST_F(RayList, CellsMayBeInQuotes) {
  const std::string plain =
      "ox,oy,oz,dx,dy,dz,length,any\n0.5,0,0,1,-1,0,2,1\n0,0,0,0,1,0,inf,0\n0,0,0,0,1,0,,\n";
  std::string quoted;
  for (const char c : plain) {
    if (quoted.empty() || quoted.ends_with('\n')) quoted += '"';
    quoted += c == ',' ? "\",\"" : c == '\n' ? "\"\r\n" : std::string(1, c);
  }
  EXPECT_EQ(in_binary(read("quoted.csv", quoted)), in_binary(read("plain.csv", plain)));
  const std::string head = "\xEF\xBB\xBF\"ox\", \"oy\" ,oz,dx,dy,dz\r\n";
  EXPECT_EQ(read("some.csv", head + "\" 1 \",0,\"0\",1,\"-1e-3\",0\r\n").at(0).ray.direction.y, -1e-3F);
  rejected("a.csv", head + "\"1,5\",0,0,1,0,0\n", "line 2: ox is \"1,5\", which is no number");
  rejected("a.csv", head + "\"1\"\"5\",0,0,1,0,0\n", "line 2: ox is \"1\"\"5\", which is no number");
  rejected("a.csv", head + "1,\"0,0,1,0,0\n", "line 2: a quote is not closed; a cell must end in its line");
  rejected("a.csv", "\"ox, far\",oy,oz,dx,dy,dz\n",
           "line 1: column \"ox, far\" is not known; the first line must name the columns "
           "ox,oy,oz,dx,dy,dz[,length,any]");
}

TEST_F(RayList, MovesIntoTheCubeWithTheScene) {
  const ref::Normalisation metres{{10.0, 20.0, 30.0}, 0.125};
  const ref::Ray one = ray("12,20,30,0,4,0,1.5", metres);
  EXPECT_EQ(one.origin, glm::vec3(0.25F, 0.0F, 0.0F));
  EXPECT_EQ(one.direction, glm::vec3(0.0F, 4.0F, 0.0F));
  EXPECT_EQ(one.length, 0.1875F);
  const glm::dvec3 end = metres.to_cube({12.0, 20.0 + 4.0 * 1.5, 30.0});
  EXPECT_EQ(glm::dvec3(one.origin + one.length * one.direction), end);
}

TEST_F(RayList, RaysFromOutsideStartWhereTheyEnterTheCube) {
  const ref::Ray enters = ray("-5,0.5,0,2,0,0,inf");
  EXPECT_EQ(enters.origin, glm::vec3(-1.0F, 0.5F, 0.0F));
  EXPECT_EQ(enters.length, inf);
  EXPECT_EQ(ray("-5,0.5,0,2,0,0,2.5").length, 0.5F);  // 4 of 5 units are outside
  EXPECT_EQ(ray("-5,0.5,0,2,0,0,2").length, 0.0F);
  const glm::vec3 corner(1.0F, 1.0F, -1.0F);
  for (const char* const missing : {"-5,0.5,0,2,0,-0.0,1.5", "-5,0.5,0,1,1,-0.0,inf", "5,0,0,1,0,-0.0,inf"}) {
    const ref::Ray misses = ray(missing);
    EXPECT_TRUE(ref::acceptable(misses));
    EXPECT_EQ(misses.origin, corner) << missing;
    for (int axis = 0; axis < 3; ++axis) EXPECT_GE(misses.origin[axis] * misses.direction[axis], 0.0F);
  }
}

TEST_F(RayList, KnowsWhatLiesOutsideTheCube) {
  const auto outside = [&](const std::string& cells) {
    return read("r.csv", "ox,oy,oz,dx,dy,dz,length\n" + cells + "\n").at(0).outside;
  };
  EXPECT_EQ(outside("-5,0.5,0,2,0,0,inf"), 2.0);
  EXPECT_EQ(outside("0.1,0.5,0,2,0,0,inf"), 0.0);
  EXPECT_EQ(outside("5,0,0,1,0,0,inf"), 0.0);
}

TEST_F(RayList, WrongCsvGetsALine) {
  const std::string header = "ox,oy,oz,dx,dy,dz,length,any\n0,0,0,1,0,0,inf,0\n";
  const auto line = [&](const std::string& cells, const std::string& message) {
    rejected("r.csv", header + cells + "\n", "line 3: " + message);
  };
  line("0,0,0,1,0", "has 5 cells; the first line names 8 columns");
  line("one,0,0,1,0,0,1,0", "ox is \"one\", which is no number");
  line("0,nan,0,1,0,0,1,0", "oy is \"nan\", which is no number");
  line("0,0,0,inf,0,0,1,0", "dx is \"inf\", which is no number");
  line("0,0,0,1e39,0,0,1,0", "dx is inf in binary32; a direction may have any length, but a finite one");
  line("0,0,0,0,-0,1e-50,1,0", "the direction is (0, 0, 0) in binary32; one component must differ from 0");
  line("0,0,0,1,0,0,-1,0", "length -1; allowed is 0 or more, or inf for a ray without an end");
  line("0,0,0,1,0,0,1e39,0", "length 1e+39 is beyond binary32; for a ray without an end write inf");
  line("0,0,0,1,0,0,far,0", "length is \"far\", which is no number");
  line("0,0,0,1,0,0,1,2", "any is \"2\"; allowed are 0, the closest hit, and 1, any hit");
  line("0,0,2e6,1,0,0,1,0", "oz 2000000 lies more than 2^20 times as far away as the scene's cube is wide");
  line("0,1e999,0,1,0,0,1,0", "oy is inf, which is no place");
  rejected("r.csv", "ox,oy,oz,dx,dy,dz\n", "holds no ray");
  rejected("r.csv", "", "is empty; line 1 must be ox,oy,oz,dx,dy,dz[,length,any]");
  rejected("r.csv", "ox,oy,oz,dx,dy\n",
           "line 1: column \"dz\" is missing; the first line must name the columns "
           "ox,oy,oz,dx,dy,dz[,length,any]");
}

TEST_F(RayList, WrongBinaryGetsALine) {
  const std::string no_head =
      "does not begin with the 8 bytes hprays1\\n and a count; a file of CSV needs a name that does not end "
      "in "
      ".bin or .rays";
  rejected("r.bin", "", no_head);
  rejected("r.bin", "hprays1\n1234567", no_head);
  rejected("r.rays", "ox,oy,oz,dx,dy,dz\n0,0,0,1,0,0\n", no_head);
  rejected("r.bin", in_binary(std::vector<AskedRay>{}), "holds no ray");
  const AskedRay good{{{0, 0, 0}, {1, 0, 0}, inf}};
  rejected("r.bin", in_binary({good, good}) + "x", "announces 2 rays of 32 bytes, but 65 bytes follow");
  rejected("r.bin", "hprays1\n" + little_endian(std::uint64_t{1} << 59U, 8),
           "announces 576460752303423488 rays of 32 bytes, but 0 bytes follow");
  const auto second = [&](const ref::Ray& ray, const std::string& message) {
    rejected("r.bin", in_binary({good, {ray}}), "ray 2: " + message);
  };
  second({{NAN, 0, 0}, {1, 0, 0}}, "ox is nan, which is no place");
  second({{0, -inf, 0}, {1, 0, 0}}, "oy is -inf, which is no place");
  second({{0, 0, 0}, {1, NAN, 0}},
         "dy is nan in binary32; a direction may have any length, but a finite one");
  second({{0, 0, 0}, {0, 0, 0}}, "the direction is (0, 0, 0) in binary32; one component must differ from 0");
  second({{0, 0, 0}, {1, 0, 0}, NAN}, "length nan; allowed is 0 or more, or inf for a ray without an end");
  second({{0, 0, 0}, {1, 0, 0}, -0x1p-9F},
         "length -0.001953125; allowed is 0 or more, or inf for a ray without an end");
  rejected("r.bin", "hprays1\n" + little_endian(1, 8) + in_binary(good).substr(0, 28) + little_endian(2, 4),
           "ray 1: any is 2; allowed are 0, the closest hit, and 1, any hit");
  EXPECT_EQ(message_of<std::runtime_error>([&] { (void)read_ray_list("/none/r.bin", unmoved); }),
            "/none/r.bin: cannot read the file");
}

}  // namespace
}  // namespace hitpipe::sim::ray_list_test
