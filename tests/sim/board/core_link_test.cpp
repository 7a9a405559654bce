// A core on a board takes an image and rays over its serial line and answers as software does. Lost bytes
// cost something that is sent again; what is wrong is found: damaged Verilog, another core, a scene that does
// not fit.
#include "sim/board/core_link.hpp"

#include <memory>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/format.hpp"
#include "rtl_gen/board/core_top.hpp"
#include "rtl_gen/board/top.hpp"
#include "rtl_gen/component/library.hpp"
#include "sim/board/frame.hpp"
#include "sim/core/picture_rays.hpp"
#include "sim/cosim/counts.hpp"
#include "tests/message_of.hpp"
#include "tests/pseudo_terminal.hpp"
#include "tests/sim/board/served_board.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim::core_link_test {
namespace {

using std::chrono::milliseconds;

rtl::CoreOptions small_options() {
  rtl::CoreOptions options;
  options.bits = parse_bits<hls::RayBits>("12+0/7s12");
  options.rays = 2;
  options.stack_bits = 1;
  options.levels = 24;
  options.address_bits = 10;
  options.byte_bits = 15;
  options.tag_bits = 8;
  options.serial_triangle = true;
  options.clock_ps = 60'000;
  return options;
}

const rtl::Core& small_core() {
  static const rtl::Core core = rtl::make_core(small_options(), rtl::Library::thesis());
  return core;
}

/// The hills, their image, and the rays of a small picture with what software answers.
struct Picture {
  hls::RayBits bits = small_core().options.bits;
  std::shared_ptr<const ref::IntScene> scene = std::make_shared<const ref::IntScene>(
      ref::int_scene(hills(), bits.world(), {.build = ref::surface_area_build}));
  ref::CoreImage image = ref::core_image(*scene);
  PictureRays rays = picture_rays(
      scene, image,
      {.world = bits.world(), .boxes = bits.boxes(), .places = 1 << small_core().options.stack_bits},
      {.width = 12, .height = 12});
};
const Picture& picture() {
  static const Picture made;
  return made;
}

struct CoreBoard {
  std::string good{}, bad{};  ///< replaced in the Verilog, once
  std::function<bool(std::uint64_t)> loses = [](std::uint64_t) { return false; };
  std::function<bool(std::uint64_t)> loses_answer = [](std::uint64_t) { return false; };
};

SimulatedBoard::Options setup_of(const CoreBoard& board) {
  std::string verilog = rtl::core_board_top(small_core(), simulated_clocks_per_bit) +
                        rtl::to_verilog(small_core(), rtl::Library::thesis());
  // Throws when it is not there.
  if (!board.good.empty()) verilog.replace(verilog.find(board.good), board.good.size(), board.bad);
  return {.module = rtl::board_module(small_core().module),
          .verilog = verilog,
          .loses = board.loses,
          .loses_answer = board.loses_answer,
          .quiet_clocks = core_quiet_clocks};
}

struct Traced {
  FrameLink::Counts written, traced;
  std::uint64_t wrong = 0, hits = 0;
};

Traced trace(const CoreBoard& board = {}, milliseconds silence = std::chrono::seconds(10)) {
  const RunningBoard served(setup_of(board));
  host::SerialPort port = host::SerialPort::open(served.port(), 1'000'000);
  CoreLink link(port, small_core(), served.patience(silence, 40));
  link.require_same_core();
  Traced result;
  result.written = link.write(picture().image);
  std::vector<CoreAnswer> answers(picture().rays.jobs.size());
  result.traced = link.run(picture().rays.jobs, answers);
  result.wrong = picture().rays.wrong(answers);
  for (const CoreAnswer& answer : answers) result.hits += answer.hit.found() ? 1 : 0;
  return result;
}

TEST(CoreOnABoard, AnswersAsSoftware) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const Traced result = trace();
  EXPECT_EQ(result.written.answered, 4 * picture().image.blocks.size() + 1);
  EXPECT_EQ(result.written.resent, 0U);
  EXPECT_EQ(result.traced.answered, picture().rays.jobs.size());
  EXPECT_EQ(result.traced.resent, 0U);
  EXPECT_EQ(result.wrong, 0U);
  EXPECT_GT(result.hits, 20U);
  EXPECT_LT(result.hits, picture().rays.jobs.size() - 20);
}

TEST(CoreOnABoard, LostBytesAreSentAgain) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const auto some = [](std::uint64_t byte) { return byte % 701 == 700; };
  const Traced there = trace({.loses = some}, milliseconds{150});
  EXPECT_EQ(there.wrong, 0U);
  EXPECT_GT(there.written.resent, 0U);
  EXPECT_GT(there.traced.resent, 0U);
  const Traced back = trace({.loses_answer = some}, milliseconds{150});
  EXPECT_EQ(back.wrong, 0U);
  EXPECT_GT(back.written.resent, 0U);
  EXPECT_GT(back.traced.resent, 0U);
}

TEST(CoreOnABoard, AnswersByteForByte) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const RunningBoard served(setup_of({}));
  host::SerialPort port = host::SerialPort::open(served.port(), 1'000'000);
  const auto answer_to = [&](std::string bytes, std::size_t length) {
    std::string answer;
    for (int tries = 0; tries < 60'000 && answer.size() < length; ++tries)
      answer += port.exchange(bytes, milliseconds{10});
    return answer;
  };
  const std::string who = to_frame("I?" + rtl::core_identity(small_core()));
  // Noise, a wrong check sequence, an unknown kind and a body that is too short get no answer.
  EXPECT_EQ(
      answer_to("noise\x7eI?MX\x7e" + to_frame("Xa") + to_frame("M1short") + "\x7eI?MW\x7e", who.size()),
      who);
  const std::string stored = to_frame("M1") + to_frame("M}") + to_frame("S3");
  EXPECT_EQ(answer_to(to_frame("M1" + std::string(10, '\x7e')) + to_frame("M}" + std::string(10, '\0')) +
                          to_frame(std::string("S3\x05\0", 4)),
                      stored.size()),
            stored);
}

struct Fault {
  const char *name, *good, *bad;
};
class DamagedCoreBoard : public testing::TestWithParam<Fault> {};

TEST_P(DamagedCoreBoard, IsSeen) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  EXPECT_GT(trace({.good = GetParam().good, .bad = GetParam().bad}).wrong, 0U);
}
INSTANTIATE_TEST_SUITE_P(Faults, DamagedCoreBoard,
                         testing::Values(Fault{"NumberOfAnother", "hit_number, hit_failed}",
                                               "hit_number ^ 32'd1, hit_failed}"},
                                         Fault{"WordOfAnother", "assign read_word_1 = read_word_1_1",
                                               "assign read_word_1 = read_word_0_1"},
                                         Fault{"ShortImage", "last <= operands", "last <= 10'd3 & operands"}),
                         [](const testing::TestParamInfo<Fault>& each) { return each.param.name; });

TEST(CoreLink, OtherCoreIsRefused) {
  SKIP_WITHOUT_PSEUDO_TERMINAL();
  const RunningBoard served(setup_of({}));
  host::SerialPort port = host::SerialPort::open(served.port(), 1'000'000);
  rtl::CoreOptions options = small_options();
  options.levels = 25;
  const rtl::Core other = rtl::make_core(options, rtl::Library::thesis());
  CoreLink link(port, other, served.patience());
  EXPECT_EQ(message_of<std::runtime_error>([&] { link.require_same_core(); }),
            fmt::format("{}: the board has \"{}\", and the rays are for \"{}\"", served.port(),
                        rtl::core_identity(small_core()), rtl::core_identity(other)));
}

TEST(CoreLink, SceneThatDoesNotFitIsRefused) {
  ref::CoreImage image = picture().image;
  image.header.levels = 25;
  EXPECT_EQ(message_of<std::runtime_error>([&] { check_fits(small_core(), image); }),
            "the scene has 25 records on a path; the core on the board allows 24");
  image.blocks.resize(1025);
  EXPECT_EQ(message_of<std::runtime_error>([&] { check_fits(small_core(), image); }),
            "the scene's image has 1025 blocks of 32 bytes, and the memory of the board's chip has room for "
            "1024");
}

}  // namespace
}  // namespace hitpipe::sim::core_link_test
