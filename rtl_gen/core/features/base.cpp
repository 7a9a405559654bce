// The core that every feature changes (docs/core.md): it traces integer rays from pins for their nearest or any hit,
// reads blocks from memory one by one, and tests triangles in a unit.
#include "rtl_gen/core/features/base.hpp"

#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "hls/machines/best_hits.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/door.hpp"
#include "hls/machines/pair_feed.hpp"
#include "hls/machines/reader.hpp"
#include "hls/machines/replies.hpp"
#include "hls/machines/requests.hpp"
#include "rtl_gen/core/feature.hpp"

namespace hitpipe::rtl::features::base {

namespace {

using namespace hls::channels;

constexpr std::array links{
    // A new ray begins.
    link<NewNumber>("door", "pair_feed"),
    link<NewNumber>("door", "replies"),
    link<NewRay>("door", "best_hits"),
    link<Starts>("best_hits", "walker"),
    // A ray goes to a record or a leaf.
    link<Goes>("walker", "reader"),
    link<hls::Join<Goes, WalkInterval>>("walker", "pair_feed"),
    // A record has come and is tested.
    link<hls::Join<Begins, Children>>("pair_feed", "walker"),
    // A hit was compared with the best one.
    link<Divided>("best_hits", "reader"),
    // A leaf is done.
    link<LeafDone>("reader", "best_hits"),
    link<Returns>("best_hits", "walker"),
    // A walk ends.
    link<Ended>("walker", "best_hits"),
    link<Answers>("best_hits", "replies"),
    // Blocks come from memory.
    link<Asks>("reader", "requests"),
    // A triangle is tested.
    link<NewNumber>("door", "triangle_feed"),
    link<TriangleRead>("triangle_feed", "best_hits"),
    link<TriangleFlaw>("triangle_feed", "reader"),
    link<Divides>("divider", "best_hits"),
    // An answer that has left frees its ray's number.
    link<Freed>("replies", "door"),
};

std::vector<CorePin> pins() {
  return {
      input(ray_valid, "a new ray, as the unit int_ray makes it"),
      output(ray_ready, "door", "it begins at a clock edge with both high"),
      input(ray_tag, "comes back with its answer"),
      input(ray_any, "1: any hit will do; 0: the nearest"),
      input(ray_error, "1: it is no ray; its answer has failed"),
      input(ray_major_y, "1: the major axis is y"),
      input(ray_major_z, "1: the major axis is z; x when both are 0"),
      input(ray_back_m, "1: the direction is negative on the major axis"),
      input(ray_back_a, "likewise on ray axis a"),
      input(ray_back_b, "likewise on ray axis b"),
      input(ray_origin_m, "on the grid of n+g bits, by ray axis"),
      input(ray_origin_a, ""),
      input(ray_origin_b, ""),
      input(ray_s_a, "slope, 0..2^S"),
      input(ray_s_b, ""),
      input(ray_floor_a, "lower bound of the slope's reciprocal"),
      input(ray_ceil_a, "upper bound"),
      input(ray_exp_a, "exponent of both"),
      input(ray_floor_b, ""),
      input(ray_ceil_b, ""),
      input(ray_exp_b, ""),
      input(ray_length, "largest T of the ray"),
      output(Hits::valid, "replies", "an answer; answers have any order"),
      input(Hits::ready, "it has left at a clock edge with both high"),
      output(Hits::tag, "replies", ""),
      output(Hits::failed, "replies",
             "0, or why it has failed: 1 no ray, 2 steps, 3 levels, 4 outside, 5 block not read"),
      output(Hits::number, "replies", "of the triangle; all ones: no hit"),
      output(Hits::t, "replies", "T of the hit; without one the ray's length"),
      output(request_valid, "requests", "a block of 32 bytes is wanted"),
      input(request_ready, "memory takes the request at a clock edge with both high"),
      output(request_address, "requests", "of bytes, a multiple of 32"),
      output(request_id, "requests", "a ray's number, and above it 1 for a triangle; one request a ray"),
      input(read_valid, "memory gives a block, in any order; it is taken at once"),
      input(read_id, "of the request"),
      input(read_word_0, "its first 8 bytes, the lowest address in the lowest bits"),
      input(read_word_1, ""),
      input(read_word_2, ""),
      input(read_word_3, ""),
      input(read_error, "1: it could not be read; its ray fails"),
      input(hls::channels::base,
            "address of the image, divided by 64; constant while rays are in flight, as all below"),
      input(last, "number of the image's last block"),
      input(most_steps, "records that a ray may test, 1 or more"),
      input(most_rays, "rays in flight; it only grows until the next reset"),
  };
}

void fill(CorePlan& plan, const CoreOptions& options) {
  const hls::RayBits& bits = options.bits;
  const int ray = options.ray_bits(), address = options.address_bits;
  const int t = bits.distance(), box = bits.boxes().length();
  const int number = options.number_bits, leaf = options.leaf_bits;
  hls::CoreBits triangles{bits.world(), ray};
  triangles.number = number;
  plan.parts = {
      {"door", "door", hls::DoorBits{.distance = t, .ray = ray}},
      {"walker", "walker",
       hls::WalkBits{box, address, options.levels, options.stack_bits, ray, leaf, options.step_bits}},
      {"reader", "reader", hls::ReaderBits{.address = address, .ray = ray, .leaf = leaf}},
      {"requests", "requests", hls::RequestBits{address, options.byte_bits, ray}},
      {"pair_feed", "pair_feed",
       hls::PairFeedBits{bits.coord, bits.finer, bits.mantissa, bits.box_fraction, address, ray, leaf}},
      {"triangle_feed", "triangle_feed", triangles},
      {"divider", "divider", triangles},
      {"best_hits", "best_hits",
       hls::BestBits{.distance = t,
                     .dropped = bits.finer + bits.fraction - bits.box_fraction,
                     .box = box,
                     .ray = ray,
                     .number = number}},
      {"replies", "replies",
       hls::ReplyBits{.distance = t, .tag = options.tag_bits, .ray = ray, .number = number}},
      {"pair", "int_major_pair", bits.boxes(), 1, FlowControl::none, ray},
      {"triangle", "int_triangle", bits.world(), options.triangle_interval, FlowControl::none, ray},
  };
  plan.add_links(links);
  plan.units = {{"pair_feed", "pair", {"walker"}}, {"triangle_feed", "triangle", {"reader", "divider"}}};
  plan.pins = pins();
  plan.bus = {.data_bits = options.data_bits,
              .burst_bits = CoreOptions::block_bits,
              .has_one_id = options.has_one_id()};
}

void check(const CoreOptions& options) {
  if (!options.bits.valid())
    throw std::runtime_error(fmt::format("core: there is no format {}; allowed is {}",
                                         to_string(Format(options.bits)),
                                         Format(options.bits).family().allowed()));
  const auto within = [](const char* what, int value, int least, int most) {
    if (value < least || value > most)
      throw std::runtime_error(fmt::format("{} {}: allowed is {} to {}", what, value, least, most));
  };
  within("rays in flight", options.rays, 1, CoreOptions::most_rays);
  within("bits of places on a stack", options.stack_bits, 1, 6);
  within("levels", options.levels, 2, CoreOptions::most_levels);
  within("bits of a block's number", options.address_bits, 4, 32);
  within("bits of an address", options.byte_bits, options.address_bits + 5, 64);
  within("bits of a triangle's number", options.number_bits, 4, hls::triangle_number_bits);
  within("bits of the number of triangles in a leaf", options.leaf_bits, 2, hls::child_count_bits);
  within("bits of the number of steps", options.step_bits, 4, hls::step_count_bits);
  within("block RAMs", options.block_rams, 0, CoreOptions::most_block_rams);
  within("bits of a tag", options.tag_bits, 1, 64);
  within("cycles from triangle to triangle", options.triangle_interval, CoreOptions::least_triangle_interval,
         CoreOptions::most_triangle_interval);
  if (options.data_bits < 64 || options.data_bits > 512 || (options.data_bits & (options.data_bits - 1)) != 0)
    throw std::runtime_error(
        fmt::format("bits of the memory bus {}: allowed is 64, 128, 256, 512", options.data_bits));
}

/// A field of CoreOptions with numbers from the least to the most.
template <auto Field>
CoreOption number_option(CoreOption::Group group, std::string_view name, int least, int most,
                         const std::string& help, std::string_view json) {
  return {.group = group,
          .name = name,
          .help = help,
          .get = number_at<Field>,
          .set = put_number<Field>,
          .least = least,
          .most = most,
          .json = json};
}

std::vector<CoreOption> base_options() {
  using enum CoreOption::Group;
  using Of = CoreOptions;
  return {
      number_option<&Of::rays>(rays, "--rays", 1, Of::most_rays, "Rays in flight", "rays"),
      {.group = core,
       .name = "--stack",
       .help = "Places of a ray's stack, a power of two",
       .get = [](const Of& options) { return 1 << options.stack_bits; },
       .set = [](Of& options, int places) { options.stack_bits = hls::count_bits(places); },
       .least = 2,
       .most = 64,
       .power_of_two = true,
       .json = "stack"},
      number_option<&Of::levels>(core, "--levels", 2, Of::most_levels, "Records on a path through the image",
                                 "levels"),
      number_option<&Of::address_bits>(ports, "--block-bits", 4, 32,
                                       "Bits of a block's number in the image; a block has 32 bytes",
                                       "address_bits"),
      number_option<&Of::byte_bits>(ports, "--address-bits", 9, 64,
                                    "Bits of an address, at least 5 more than of a block's number", ""),
      number_option<&Of::tag_bits>(ports, "--tag-bits", 1, 64, "Bits of a ray's tag", "tag_bits"),
      number_option<&Of::block_rams>(
          ports, "--block-rams", 0, Of::most_block_rams,
          "Mark memories for so many block RAMs of 16 bits, as iCE40 has them, where Yosys takes registers",
          ""),
      number_option<&Of::number_bits>(limits, "--number-bits", 4, hls::triangle_number_bits,
                                      "Bits of a triangle's number", "number_bits"),
      number_option<&Of::leaf_bits>(limits, "--leaf-bits", 2, hls::child_count_bits,
                                    "Bits of the number of triangles in a leaf", "leaf_bits"),
      number_option<&Of::step_bits>(limits, "--step-bits", 4, hls::step_count_bits,
                                    "Bits of the number of records that a ray may test", "step_bits"),
      {.group = bus,
       .name = "--data-bits",
       .help = "Width of the AXI bus to memory; a block has 256 bits",
       .get = number_at<&CoreOptions::data_bits>,
       .set = put_number<&CoreOptions::data_bits>,
       .words = {{"64", 64}, {"128", 128}, {"256", 256}, {"512", 512}}},
      {.group = bus,
       .name = "--in-order",
       .help = "All AXI requests have one identifier, so memory answers in their order; else each ray has "
               "its own. A "
               "bus that has not 256 bits is always so",
       .get = number_at<&CoreOptions::in_order>,
       .set = put_number<&CoreOptions::in_order>,
       .is_flag = true},
  };
}

void identify(CoreIdentity& identity, const CoreOptions& options) {
  const hls::RayBits& bits = options.bits;
  identity.put("coord", bits.coord);
  identity.put("finer", bits.finer);
  identity.put("fraction", bits.fraction);
  identity.put("slope", bits.slope);
  identity.put("mantissa", bits.mantissa);
  identity.put("rays", options.rays);
  identity.put("levels", options.levels);
  identity.put("block_bits", options.address_bits);
  identity.put("tag_bits", options.tag_bits);
  identity.put("byte_bits", options.byte_bits);
  identity.put("beat_bytes", options.data_bits / 8);
  identity.put("one_id", options.has_one_id() ? 1 : 0);
  identity.put("number_bits", options.number_bits);
  identity.put("leaf_bits", options.leaf_bits);
  identity.put("step_bits", options.step_bits);
  identity.put("stack_bits", options.stack_bits);
  identity.put("box_fraction", bits.box_fraction - hls::MajorBits::min_fraction);
}

std::vector<Failure> failures() {
  return {
      {"the Verilog gives a wrong T", "`core trace` and `core board` count it as wrong"},
      {"a core in a system of your own answers wrongly",
       "`core replay` says so, of a record of rays and answers"},
      {"the image has another grid than the core, or is none",
       "`core_read_image()` says so. Each ray that reads it fails: 5"},
      {"the image is cut or half written",
       "`core_read_image()` and `core image --check` say so. A ray that comes to nothing fails: 4 or 5"},
      {"the image does not begin at a multiple of 64", "`core_start()` says so, and bit 15 of the status"},
      {"the image has more blocks than the core has numbers for",
       "`core image --block-bits` and `core_read_image()` say so. A ray that is led there fails: 4"},
      {"the mesh has more triangles than the core has numbers for",
       "`core trace` and `core_read_image()` say so. A ray that reads a number without bits fails: 5"},
      {"a leaf has more triangles than the core can count",
       "`core trace` and `core_read_image()` say so. A ray that reads its record fails: 4"},
      {"a reset with reads on their way, of blocks or of rays",
       "a soft reset waits for them; after a hard one they are dropped"},
      {"memory answers with an error", "its ray fails: 5. Bit 14 of the status"},
      {"rays are offered before register 0x20 is written", "`tready` stays 0, and the core is idle"},
      {"the image changes with rays in flight", "`core_start()` refuses while the core has rays"},
      {"too large a number for rays or steps",
       "the register keeps the largest, and a core with fewer bits takes its own largest"},
      {"counters do not fit the answers", "they count rays that were taken, and no failed hits"},
      {"a triangle has no area on the grid",
       "its number stays free. FILE.json lists it, and the header counts it"},
      {"rays do not know where the mesh lies",
       "the header has offset and scale, and `--cube` chooses them. `core_make_mesh_ray()` takes the mesh's "
       "own units"},
      {"the core belongs to another header", "`core_start()` compares format, shape, ports and limits"},
      {"very many triangles lie in one place", "`core trace` waits for as many blocks as they have"}};
}

}  // namespace

const Feature& feature() {
  static const Feature feature{.name = "base",
                               .what = "a core",
                               .summary = "the core that all have",
                               .smallest = "",
                               .is_in = [](const CoreOptions&) { return true; },
                               .options = base_options(),
                               .check = check,
                               .change = fill,
                               .axi = axi,
                               .records = records,
                               .identify = identify,
                               .failures = failures(),
                               .promises = promises()};
  return feature;
}

}  // namespace hitpipe::rtl::features::base
