// Rays and boxes from CSV files: what is read, how it is rounded, and the line for each thing that is wrong.
#include "sim/operands/rays_and_boxes.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::rays_and_boxes_test {
namespace {

class RaysAndBoxes : public testing::Test {
 protected:
  [[nodiscard]] std::string rays(const std::string& text) const {
    return folder_.write("r.csv", text).string();
  }
  [[nodiscard]] std::string boxes(const std::string& text) const {
    return folder_.write("b.csv", text).string();
  }

  [[nodiscard]] ref::Ray ray(const std::string& text, const Placement& placement = {}) const {
    RayFile file(rays(text), placement);
    return file.ray(file.lines().next().value());
  }
  [[nodiscard]] ref::Aabb box(const std::string& text, const Placement& placement = {}) const {
    BoxFile file(boxes(text), placement, 1);
    return file.boxes(file.lines().next().value())[0];
  }
  /// What is said of a file without its name.
  template <class Read>
  [[nodiscard]] std::string told(const std::string& name, Read&& read) const {
    const std::string message = message_of<std::runtime_error>(read);
    const std::string file = (folder_.path() / name).string() + ": ";
    EXPECT_EQ(message.substr(0, file.size()), file) << message;
    return message.substr(std::min(file.size(), message.size()));
  }
  void ray_rejected(const std::string& line, const std::string& message,
                    const Placement& placement = {}) const {
    EXPECT_EQ(told("r.csv", [&] { static_cast<void>(ray(header_ + line + "\n", placement)); }),
              "line 2: " + message);
  }
  void box_rejected(const std::string& line, const std::string& message,
                    const Placement& placement = {}) const {
    EXPECT_EQ(told("b.csv", [&] { static_cast<void>(box(box_header_ + line + "\n", placement)); }),
              "line 2: " + message);
  }

  const std::string header_ = "ox,oy,oz,dx,dy,dz,length\n";
  const std::string box_header_ = "min_x,min_y,min_z,max_x,max_y,max_z\n";
  const Placement metres_{ref::Bounds{{0, 0, 0}, {200, 100, 50}}};
  const TemporaryFolder folder_;
};

TEST_F(RaysAndBoxes, ColumnsHaveAnyOrderAndLengthMayBeMissing) {
  const ref::Ray one = ray("dz, dx,dy,oz,oy,ox\r\n3, 1 ,2,0.75,0.5,0.25\r\n");
  EXPECT_EQ(one.origin, glm::vec3(0.25F, 0.5F, 0.75F));
  EXPECT_EQ(one.direction, glm::vec3(1.0F, 2.0F, 3.0F));
  EXPECT_TRUE(one.is_infinite());
  EXPECT_EQ(ray("\xEF\xBB\xBF" + header_ + "0,0,0,1,0,0,2.5").length, 2.5F);
  EXPECT_TRUE(ray(header_ + "0,0,0,1,0,0,inf\n").is_infinite());
  EXPECT_TRUE(ray(header_ + "0,0,0,1,0,0,\n").is_infinite());
}

TEST_F(RaysAndBoxes, CommentsAndEmptyLinesCountOnlyAsLines) {
  RayFile file(rays("# rays of mine\n" + header_ + "\n# first\n0,0,0,1,0,0,1\n \n0,0,0,0,0,0,1\n"), {});
  EXPECT_EQ(file.ray(file.lines().next().value()).length, 1.0F);
  const NumberLine second = file.lines().next().value();
  EXPECT_EQ(second.number, 7U);
  EXPECT_EQ(file.lines().next(), std::nullopt);
}

TEST_F(RaysAndBoxes, RaysAreRoundedToNearestAndBoxesOutward) {
  EXPECT_EQ(ray(header_ + "0.1,0,0,0.3,0,0,0.7\n").origin.x, 0.1F);
  EXPECT_EQ(ray(header_ + "0.1,0,0,0.3,0,0,0.7\n").direction.x, 0.3F);
  EXPECT_EQ(ray(header_ + "0.1,0,0,0.3,0,0,0.7\n").length, 0.7F);
  const ref::Aabb tenth = box(box_header_ + "0.1,-0.1,0x1p-3,0.1,-0.1,0x1p-3\n");
  EXPECT_EQ(tenth.min, glm::vec3(std::nextafter(0.1F, 0.0F), -0.1F, 0.125F));
  EXPECT_EQ(tenth.max, glm::vec3(0.1F, -std::nextafter(0.1F, 0.0F), 0.125F));
}

TEST_F(RaysAndBoxes, BoundsMoveOriginAndBoxAndScaleTheLength) {
  const double scale = metres_.transform().scale;
  const ref::Ray one = ray(header_ + "50,60,20,0.1,-7,0.5,30\n", metres_);
  EXPECT_EQ(one.origin, glm::vec3(glm::dvec3(-50, 10, -5) * scale));
  EXPECT_EQ(one.direction, glm::vec3(0.1F, -7.0F, 0.5F));
  EXPECT_EQ(one.length, static_cast<float>(30 * scale));
  const ref::Aabb whole = box(box_header_ + "0,0,0,200,100,50\n", metres_);
  // The scale is a rounded number, so the place of a bound need not be a binary32.
  EXPECT_EQ(whole.min.x, std::nextafter(-1.0F + 0x1p-10F, -1.0F));
  EXPECT_EQ(whole.max.x, std::nextafter(1.0F - 0x1p-10F, 1.0F));
}

TEST_F(RaysAndBoxes, TwoBoxesALineHaveNumberedColumns) {
  BoxFile file(
      boxes("min_x_0,min_y_0,min_z_0,max_x_0,max_y_0,max_z_0,min_x_1,min_y_1,min_z_1,max_x_1,max_y_1,max_z_1"
            "\n0,0,0,0.25,0.25,0.25,0.5,0.5,0.5,1,1,1\n"),
      {}, 2);
  const Boxes both = file.boxes(file.lines().next().value());
  EXPECT_EQ(both[0].max, glm::vec3(0.25F));
  EXPECT_EQ(both[1].min, glm::vec3(0.5F));
  EXPECT_EQ(both[1].max, glm::vec3(1.0F));
}

TEST_F(RaysAndBoxes, FirstLineThatDoesNotNameTheColumnsRejected) {
  const auto refused = [&](const std::string& text, const std::string& message) {
    EXPECT_EQ(told("r.csv", [&] { static_cast<void>(ray(text)); }), message);
  };
  const std::string must = "the first line must name the columns ox,oy,oz,dx,dy,dz[,length]";
  refused("", "is empty; line 1 must be ox,oy,oz,dx,dy,dz[,length]");
  refused("ox,oy,oz,dx,dy\n", "line 1: column \"dz\" is missing; " + must);
  refused("ox,oy,oz,dx,dy,dz,ox\n", "line 1: column \"ox\" is there twice; " + must);
  refused("# mine\n0,0,0,1,0,0\n", "line 2: column \"0\" is not known; " + must);
}

TEST_F(RaysAndBoxes, BadRaysRejected) {
  const std::string numbers =
      ", which is no number; allowed are decimal numbers such as -0.25 and C's hexadecimal numbers such as "
      "-0x1p-2";
  ray_rejected("0,0,0,1,0,0", "has 6 cells; the first line names 7 columns");
  ray_rejected("0,0,0,1,0,0,1,1", "has 8 cells; the first line names 7 columns");
  ray_rejected("0,x,0,1,0,0,1", "oy is \"x\"" + numbers);
  ray_rejected("0,,0,1,0,0,1", "oy is \"\"" + numbers);
  ray_rejected("nan,0,0,1,0,0,1", "ox is \"nan\"" + numbers);
  ray_rejected("0,0,0,inf,0,0,1", "dx is \"inf\"" + numbers);
  ray_rejected("0,0,0,1,0,0,nan", "length is \"nan\"" + numbers);
  ray_rejected(
      "0,0,-1.00000001,1,0,0,1",
      "oz -1.00000001 lies outside the cube; allowed is -1 to 1; for other units give the bounds of all "
      "boxes");
  ray_rejected("0,0,0,1,0,1e39,1",
               "dz 1e39 is beyond binary32; a direction may have any length, so divide it");
  ray_rejected("0,0,0,0,-0,1e-60,1",
               "the direction is (0, 0, 0) in binary32; one component must differ from 0");
  ray_rejected("0,0,0,1,0,0,-1", "length -1 is negative; allowed is 0 or more, inf or nothing");
  ray_rejected("0,0,0,1,0,0,1e40", "length 1e40 is beyond binary32; for a ray without an end write inf");
  ray_rejected("0,200,0,1,0,0,1", "oy 200 lies beyond the bounds; allowed is -50.0977517 to 150.097752",
               metres_);
}

TEST_F(RaysAndBoxes, BadBoxesRejected) {
  box_rejected("0,0,0.5,1,1,0.25", "min_z 0.5 is above max_z 0.25");
  box_rejected(
      "0,0,0,1,1,1.0000000001",
      "max_z 1.0000000001 lies outside the cube; allowed is -1 to 1; for other units give the bounds of "
      "all boxes");
  box_rejected(
      "0,0,-1e999,1,1,1",
      "min_z -1e999 lies outside the cube; allowed is -1 to 1; for other units give the bounds of all "
      "boxes");
  box_rejected(
      "0,0,0,1,1,inf",
      "max_z is \"inf\", which is no number; allowed are decimal numbers such as -0.25 and C's hexadecimal "
      "numbers such as -0x1p-2");
}

TEST_F(RaysAndBoxes, LineWithoutAnEndRejected) {
  EXPECT_EQ(told("r.csv", [&] { static_cast<void>(ray(header_ + std::string(70'000, '1'))); }),
            "line 2 is longer than 65536 bytes");
  EXPECT_EQ(told("none.csv", [&] { static_cast<void>(RayFile((folder_.path() / "none.csv").string(), {})); }),
            "cannot read the file: No such file or directory");
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(RayFile(folder_.path().string(), {})); }),
            folder_.path().string() + ": cannot read the file: Is a directory");
}

}  // namespace
}  // namespace hitpipe::sim::rays_and_boxes_test
