#include "sim/board/core_link.hpp"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "rtl_gen/board/core_top.hpp"
#include "rtl_gen/board/top.hpp"
#include "sim/board/frame.hpp"

namespace hitpipe::sim {

namespace {

/// Words of the image on their way. They are answered in their order, so one is lost when a later one is
/// answered.
constexpr FrameLink::Kind word_kind{.letter = 'M', .noun = "word", .answer_bytes = 0, .most_waiting = 64};
constexpr FrameLink::Kind end_kind{.letter = 'S', .noun = "image", .answer_bytes = 0, .most_waiting = 1};
/// A ray may take longer than many others.
constexpr std::size_t most_overtaken = 32;
constexpr std::size_t words_of_block = 4;

std::string little_endian(std::uint64_t number, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>((number >> 8 * i) & 0xffU);
  return text;
}

void add(FrameLink::Counts& sum, const FrameLink::Counts& counts) {
  sum.answered += counts.answered;
  sum.resent += counts.resent;
  sum.bytes_sent += counts.bytes_sent;
  sum.bytes_received += counts.bytes_received;
  sum.seconds += counts.seconds;
}

}  // namespace

void check_fits(const rtl::Core& core, const ref::CoreImage& image) {
  const std::size_t room = rtl::board_blocks(core);
  if (image.blocks.size() > room)
    throw std::runtime_error(fmt::format(
        "the scene's image has {} blocks of {} bytes, and the memory of the board's chip has room for {}",
        image.blocks.size(), ref::core_block_bytes, room));
  if (image.header.levels > core.options.levels)
    throw std::runtime_error(
        fmt::format("the scene has {} records on a path; the core on the board allows {}",
                    image.header.levels, core.options.levels));
}

CoreLink::CoreLink(host::SerialPort& port, const rtl::Core& core, const Patience& patience)
    : core_(core), link_(port, patience) {}

void CoreLink::require_same_core() {
  link_.require(rtl::core_identity(core_), "rays");
}

FrameLink::Counts CoreLink::write(const ref::CoreImage& image, const Progress& progress) {
  check_fits(core_, image);
  const std::size_t count = image.blocks.size() * words_of_block;
  std::size_t given = 0, taken = 0;
  FrameLink::Counts counts = link_.run(
      word_kind,
      [&]() -> std::optional<FrameLink::Question> {
        if (given == count) return std::nullopt;
        const std::size_t number = given++;
        const std::uint64_t word = image.blocks[number / words_of_block][number % words_of_block];
        return FrameLink::Question{number, little_endian(number, 2) + little_endian(word, 8)};
      },
      [&](std::uint64_t, std::string_view) {
        if (++taken % 256 == 0 && progress) progress(static_cast<double>(taken) / static_cast<double>(count));
      });
  bool asked = false;
  add(counts, link_.run(
                  end_kind,
                  [&]() -> std::optional<FrameLink::Question> {
                    if (asked) return std::nullopt;
                    asked = true;
                    return FrameLink::Question{0, little_endian(image.blocks.size() - 1, 2)};
                  },
                  [](std::uint64_t, std::string_view) {}));
  return counts;
}

FrameLink::Counts CoreLink::run(std::span<const CoreJob> jobs, std::span<CoreAnswer> answers,
                                const Progress& progress) {
  const std::vector<rtl::Port> ray = rtl::board_ray_ports(core_), hit = rtl::board_hit_ports(core_);
  std::size_t given = 0, taken = 0;
  return link_.run(
      {.letter = 'T',
       .noun = "ray",
       .answer_bytes = static_cast<std::size_t>(rtl::packed_bytes(hit)),
       .most_waiting = static_cast<std::size_t>(rtl::rays_on_their_way(core_)),
       .overtaken = most_overtaken},
      [&]() -> std::optional<FrameLink::Question> {
        if (given == jobs.size()) return std::nullopt;
        std::vector<std::int64_t> values;
        for (const rtl::Word field : ray_fields(core_, jobs[given]))
          values.push_back(static_cast<std::int64_t>(field));
        return FrameLink::Question{given++, pack(ray, values)};
      },
      [&](std::uint64_t number, std::string_view body) {
        const std::vector<std::int64_t> fields = unpack(hit, body);
        answers[number] = {.hit = {.triangle = static_cast<std::uint32_t>(fields[1]), .t = fields[2]},
                           .failed = static_cast<hls::Failure>(fields[0])};
        if (++taken % 64 == 0 && progress)
          progress(static_cast<double>(taken) / static_cast<double>(jobs.size()));
      });
}

}  // namespace hitpipe::sim
