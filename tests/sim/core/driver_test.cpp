// The driver of examples/core_system refuses what a core would answer wrongly, and says why.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "rays/image/core_image.hpp"
#include "rtl_gen/core/c_header.hpp"
#include "sim/core/recorded_answers.hpp"
#include "sim/operands/ray_list.hpp"
#include "tests/rtl_gen/tool.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim::driver_test {
namespace {

using testing::HasSubstr;

/// Registers that keep what is written. Prints what the driver says of an image in the file FILE at ADDRESS, and what
/// it wrote. REGISTER=VALUE changes a register before.
constexpr const char* program = R"(#include "driver.h"
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
static uint32_t words[64];
static int writes;
void bus_write(uint32_t address, uint32_t value) {
  words[(address - CORE_REGISTERS) / 4] = value;
  ++writes;
}
uint32_t bus_read(uint32_t address) {
  return words[(address - CORE_REGISTERS) / 4];
}
#if CORE_HAS_RINGS
void memory_write(uint64_t address, const uint8_t* bytes, uint32_t count) {
  words[63] += address + count + bytes[0] != 0;
}
void memory_read(uint64_t address, uint8_t* bytes, uint32_t count) {
  memset(bytes, (int)address, count);
}
/* What the driver says when so many answers are known. */
static void poll(struct core_rings* rings) {
  const uint32_t there = core_answers(rings);
  printf("%" PRIu32 " there, %s\n", there, rings->wrong ? rings->wrong : "right");
}
static void poll_rings(void) {
  struct core_rings rings;
  if (core_start_rings(&rings, 0x1000, 0x2000, 4)) return;
  words[CORE_REG_ANSWERED / 4] = 2;
  words[CORE_REG_STATUS / 4] = CORE_RING_ERROR;
  poll(&rings);
  poll(&rings);
  words[CORE_REG_STATUS / 4] = CORE_OVERFULL;
  poll(&rings);
  words[CORE_REG_STATUS / 4] = CORE_UNWRITTEN;
  poll(&rings);
}
#else
bool fifo_send(uint32_t tag, const uint8_t* bytes) {
  return tag == bytes[0];
}
bool fifo_take(uint32_t* tag, uint8_t* bytes) {
  return *tag == bytes[0];
}
static void poll_rings(void) {}
#endif
int main(int count, char** arguments) {
  static uint8_t bytes[1 << 20];
  struct core_image image;
  FILE* const file = count > 2 ? fopen(arguments[1], "rb") : NULL;
  if (!file) return 2;
  const size_t size = fread(bytes, 1, sizeof bytes, file);
  words[CORE_REG_IDENTITY / 4] = CORE_IDENTITY;
  words[CORE_REG_VERSION / 4] = CORE_VERSION;
  words[CORE_REG_FORMAT / 4] = CORE_FORMAT;
  words[CORE_REG_SHAPE / 4] = CORE_SHAPE;
  words[CORE_REG_PORTS / 4] = CORE_PORTS;
  words[CORE_REG_LIMITS / 4] = CORE_LIMITS;
  words[CORE_REG_STATUS / 4] = CORE_IDLE;
  for (int i = 3; i < count; ++i) {
    char* end;
    const unsigned long place = strtoul(arguments[i], &end, 0);
    words[place / 4] = (uint32_t)strtoul(end + 1, NULL, 0);
  }
  const char* refused = core_read_image(&image, bytes, size);
  if (!refused) refused = core_start(strtoull(arguments[2], NULL, 0), &image);
  if (refused) {
    printf("%s, %d writes", refused, writes);
  } else {
    printf("starts at 0x%" PRIx64 ", last %" PRIu32 ", rays %" PRIu32 ", %" PRIu32 " triangles, %" PRIu32
           " missing, scale %.17g, offset %.17g",
           (uint64_t)words[CORE_REG_BASE_HIGH / 4] << 32 | words[CORE_REG_BASE_LOW / 4],
           words[CORE_REG_LAST_BLOCK / 4], words[CORE_REG_MOST_RAYS / 4], image.triangles, image.missing,
           image.scale, image.offset[1]);
    poll_rings();
  }
  return 0;
}
)";

rtl::CoreOptions small_core() {
  return {.rays = 8, .levels = 30, .address_bits = 12, .byte_bits = 36, .number_bits = 9, .leaf_bits = 2};
}
rtl::CoreOptions with_rings() {
  rtl::CoreOptions options = small_core();
  options.float_door = true;
  options.rings = true;
  return options;
}

class CoreDriver : public testing::Test {
 protected:
  explicit CoreDriver(rtl::CoreOptions options = small_core()) {
    const rtl::Core core = rtl::make_core(options, rtl::library_called(rtl::default_library), "hitpipe_core");
    host::write_files(folder_.path(), {{"hitpipe_core.h", rtl::c_header(core)}, {"main.c", program}});
    const rtl::ToolResult built =
        rtl::run_tool(folder_.path(), "gcc", "cc",
                      "-std=c99 -Wall -Wextra -Wpedantic -Werror -I. -I" HITPIPE_SOURCE
                      "/examples/core_system main.c -o main");
    EXPECT_EQ(built.status, 0) << built.output;
  }
  /// Of an image that is in a file.
  std::string says(const std::string& bytes, const std::string& arguments) {
    host::write_file((folder_.path() / "image").string(), bytes);
    return rtl::run_tool(folder_.path(), "main", "./main", "image " + arguments).output;
  }
  /// Of blocks with that header.
  std::string of(std::vector<ref::CoreBlock> blocks, const ref::CoreHeader& header) {
    put_header(blocks, header);
    return says(ref::core_image_bytes(blocks), "0x40");
  }

  host::ScratchFolder folder_{"core-driver"};
  const ref::IntScene scene_ = [] {
    ref::Scene hills = sim::hills();
    hills.to_cube = {.offset = {0.1, 0.3, 0.7}, .scale = 1.0 / 3};
    return ref::int_scene(hills, {}, {.build = {.max_triangles = 2}});
  }();
  const ref::CoreImage image_ = ref::core_image(scene_);
  const std::string bytes_ = ref::core_image_bytes(image_.blocks);
};

TEST_F(CoreDriver, StartsWithAnImageThatTheCoreCanRead) {
  EXPECT_EQ(says(bytes_, "0xfffff0040"),
            fmt::format("starts at 0xfffff0040, last {}, rays 8, {} triangles, 0 missing, "
                        "scale 0.33333333333333331, offset 0.29999999999999999",
                        image_.blocks.size() - 1, scene_.mesh.triangles.size()));
  EXPECT_EQ(says(bytes_ + "more", "0x40"), says(bytes_, "0x40")) << "memory may be larger than the image";
}

TEST_F(CoreDriver, SaysWhyItDoesNotStart) {
  EXPECT_EQ(says(bytes_, "0x40 0x00=0x48697471"), "no core answers at that address, 0 writes");
  EXPECT_EQ(says(bytes_, "0x40 0x04=1"), "the core has another version than its header, 0 writes");
  for (const char* const reg : {"0x28", "0x2c", "0x30", "0x38"})
    EXPECT_EQ(says(bytes_, fmt::format("0x40 {}=0", reg)),
              "the core was made with other options than its header, 0 writes");
  EXPECT_EQ(says(bytes_, "0x40 0x08=0"), "the core has rays, 0 writes");
  for (const char* const address : {"0x44", "0x60"})
    EXPECT_EQ(says(bytes_, address), "the image does not begin at a multiple of 64, 0 writes");
  for (const char* const address : {"0xfffffffc0", "0x1000000000", "0xffffffffffffffc0"})
    EXPECT_EQ(says(bytes_, address), "the image ends above the core's last address, 0 writes");
}

TEST_F(CoreDriver, RefusesAnImageThatNeedsMoreBits) {
  ref::CoreHeader header = image_.header;
  ASSERT_EQ(header.triangles, 288U);
  ASSERT_EQ(header.most_in_leaf, 2);
  header.missing = 511 - header.triangles;
  EXPECT_THAT(of(image_.blocks, header), HasSubstr("starts at 0x40")) << "the largest number is 510";
  ++header.missing;
  EXPECT_EQ(of(image_.blocks, header), "the mesh has more triangles than the core has numbers for, 0 writes");
  header.missing = 0xffff'ffff;
  EXPECT_EQ(of(image_.blocks, header), "the mesh has more triangles than the core has numbers for, 0 writes");
  header = image_.header;
  for (const int most : {3, 6, 255}) {
    header.most_in_leaf = most;
    EXPECT_EQ(of(image_.blocks, header),
              "the image has leaves with more triangles than the core can count, 0 writes");
  }
}

TEST_F(CoreDriver, RefusesAnImageThatIsNotTheCores) {
  EXPECT_EQ(says(std::string(100'000, '\0'), "0x40"), "there is no image, 0 writes");
  EXPECT_EQ(says(bytes_.substr(0, 100), "0x40"), "there is no image, 0 writes");
  EXPECT_EQ(says(bytes_.substr(0, bytes_.size() - 1), "0x40"), "the image is cut, 0 writes");
  std::string half = bytes_;
  std::fill(half.begin() + static_cast<std::ptrdiff_t>(half.size() / 2), half.end(), '\0');
  EXPECT_EQ(says(half, "0x40"), "the image was changed or half written, 0 writes");
  std::string later = bytes_;
  later[39] = '\1';
  EXPECT_EQ(says(later, "0x40"), "the image has another version than the core's header, 0 writes");
  ref::CoreHeader header = image_.header;
  header.coord_bits = 16;
  EXPECT_EQ(of(image_.blocks, header), "the image has another grid than the core, 0 writes");
  header = image_.header;
  header.levels = 31;
  EXPECT_EQ(of(image_.blocks, header), "the image has more levels than the core, 0 writes");
  std::vector<ref::CoreBlock> large = image_.blocks;
  large.resize(4097);
  EXPECT_EQ(of(large, image_.header), "the image has more blocks than the core can name, 0 writes");
  large.resize(4096);
  EXPECT_NE(of(large, image_.header).find("starts at 0x40, last 4095"), std::string::npos);
  large.resize(101);
  EXPECT_EQ(of(large, image_.header), "the image does not end where a line does, 0 writes");
  large.resize(2);
  EXPECT_EQ(says(ref::core_image_bytes(large), "0x40"), "there is no image, 0 writes");
}

/// Records three rays, and their answers in another order.
constexpr const char* recorder = R"(#include "driver.h"
void bus_write(uint32_t address, uint32_t value) {
  (void)address, (void)value;
}
uint32_t bus_read(uint32_t address) {
  return address;
}
bool fifo_send(uint32_t tag, const uint8_t* bytes) {
  return tag == bytes[0];
}
bool fifo_take(uint32_t* tag, uint8_t* bytes) {
  return *tag == bytes[0];
}
int main(void) {
  const double origin[3] = {0.1, 0.3, 0.7};
  const float direction[3] = {0.1f, -1, 1e-30f};
  struct core_hit hit;
  FILE *const rays = fopen("rays.csv", "w"), *const answers = fopen("answers.csv", "w");
  if (!rays || !answers) return 2;
  memset(&hit, 0, sizeof hit);
  core_begin_records(rays, answers);
  for (int i = 0; i < 3; ++i) core_record_ray(rays, origin, direction, i == 0 ? 1 / 0.0f : 0.1f, i == 1);
  hit.failed = 4;
  core_record_answer(answers, 2, &hit);
  hit.failed = 0;
  hit.number = CORE_NO_HIT;
  core_record_answer(answers, 1, &hit);
  hit.number = 70000;
  hit.t = 123456;
  core_record_answer(answers, 0, &hit);
  return fclose(rays) != 0 || fclose(answers) != 0;
}
)";

TEST_F(CoreDriver, RecordsRaysAndAnswersForReplay) {
  host::write_file((folder_.path() / "recorder.c").string(), recorder);
  const rtl::ToolResult built = rtl::run_tool(
      folder_.path(), "gcc", "cc",
      "-std=c99 -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion "
      "-Werror -DCORE_RECORDS -I. -I" HITPIPE_SOURCE "/examples/core_system recorder.c -o recorder");
  ASSERT_EQ(built.status, 0) << built.output;
  ASSERT_EQ(rtl::run_tool(folder_.path(), "recorder", "./recorder", "").status, 0);
  const std::string rays_file = folder_.path() / "rays.csv";
  const std::vector<AskedRay> rays = read_ray_list(rays_file, {.offset = {0.1, 0.3, 0.7}, .scale = 1.0 / 3});
  ASSERT_EQ(rays.size(), 3U);
  EXPECT_EQ(rays[0].ray.origin, glm::vec3(0)) << "no bit of the origin is lost";
  EXPECT_EQ(rays[0].ray.direction, glm::vec3(0.1F, -1, 1e-30F));
  EXPECT_TRUE(rays[0].ray.is_infinite());
  EXPECT_EQ(rays[1].ray.length, static_cast<float>(double{0.1F} * (1.0 / 3)));
  EXPECT_EQ(rays[1].query, ref::Query::any);
  const std::vector<AnswerOfRay> answers =
      read_recorded_answers(folder_.path() / "answers.csv", rays, rays_file);
  ASSERT_EQ(answers.size(), 3U);
  EXPECT_EQ(answers[0].ray, 2U);
  EXPECT_EQ(answers[0].answer.failed, hls::outside_image);
  EXPECT_TRUE(answers[1].answer.given);
  EXPECT_EQ(answers[1].answer.triangle, std::nullopt);
  EXPECT_EQ(answers[2].answer.triangle, 70'000U);
  EXPECT_EQ(answers[2].answer.t, 123'456);
}

class RingDriver : public CoreDriver {
 protected:
  RingDriver() : CoreDriver(with_rings()) {}
};

TEST_F(RingDriver, SaysWhyNoFurtherAnswerComes) {
  const std::string said = says(bytes_, "0x40");
  EXPECT_EQ(said.substr(said.find("offset")),
            "offset 0.299999999999999992 there, right\n2 there, right\n"
            "2 there, more rays were offered than a ring has places\n"
            "2 there, an answer could not be written to memory\n");
}

}  // namespace
}  // namespace hitpipe::sim::driver_test
