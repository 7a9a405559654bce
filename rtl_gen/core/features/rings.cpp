// Rays come from a ring in memory, and answers go to another (hls/machines/rings.hpp), by a port of its own. The unit
// `ray` takes rays from the machine `rings`.
#include "hls/machines/rings.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hls/machines/epoch.hpp"
#include "hls/num/bits.hpp"
#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/core/axi_plan.hpp"
#include "rtl_gen/core/core.hpp"
#include "rtl_gen/core/feature.hpp"

namespace hitpipe::rtl::features::rings {

namespace {

using namespace hls::channels;

constexpr int most_bits = 128;  // of the bus to the rings

// A ray and an answer in memory, in bytes.
constexpr int ray_bytes = 32, hit_bytes = 16, tag_bytes = 3;
constexpr int ray_tag_at = 28, any_at = 31;
constexpr int hit_number_at = 0, hit_tag_at = 4, hit_failed_at = 7, hit_t_at = 8;

constexpr std::array links{link<Hits>("replies", "rings")};

/// In place of those of rays and answers.
std::vector<CorePin> pins() {
  using namespace hls::rings;
  return {
      input(rays_at, "address of the ring of rays, divided by 128; constant while rays are in flight"),
      input(answers_at, "of the ring of answers"),
      input(ring_last, "places of each ring, less 1: 2^k - 1, 3 or more"),
      input(rays_offered, "rays that are in memory, of all; counts go round at 2^16"),
      input(lets_fetches, "0: no more rays are read"),
      input(lets_rings, "0: no more answers are written; what has begun ends"),
      output(fetch_valid, "rings", "rays are wanted"),
      input(fetch_ready, "memory takes the request at a clock edge with both high"),
      output(fetch_address, "rings", "of bytes"),
      output(fetch_four, "rings", "1: four rays of 32 bytes; 0: one"),
      input(fetched_valid, "memory gives a beat of them, in order; it is taken at once"),
      input(fetched_error, "1: it could not be read; its ray fails"),
      input(fetched_0, "its first 8 bytes, the lowest address in the lowest bits"),
      input(fetched_1, ""),
      output(store_valid, "rings", "answers are to be written"),
      input(store_ready, "memory takes the address at a clock edge with both high"),
      output(store_address, "rings", "of bytes"),
      output(store_four, "rings", "1: four answers of 16 bytes; 0: one"),
      output(put_valid, "rings", "a beat of them"),
      input(put_ready, "memory takes it at a clock edge with both high"),
      output(put_last, "rings", "it is the last"),
      output(put_0, "rings", "its first 8 bytes"),
      output(put_1, "rings", ""),
      input(stored_valid, "they are in memory"),
      input(stored_error, "1: they could not be written"),
      output(ray_begins, "rings", "a ray has begun in the cycle before; what follows is for registers"),
      output(Hits::valid, "replies", "an answer"),
      output(Hits::ready, "rings", "it leaves at a clock edge with both high"),
      output(Hits::failed, "replies", "0, or why it has failed"),
      output(Hits::number, "replies", "of the triangle; all ones: no hit"),
      output(ring_answers, "rings", "answers that are in memory, of all"),
      output(ring_busy, "rings", "rays have not begun, or answers are not in memory"),
      output(ring_quiet, "rings", "nothing is being read or written"),
      output(ring_flaws, "rings",
             "bit 0: a ray could not be read; 1: an answer not written; 2: too many offered"),
  };
}

int bits_of(const CoreOptions& options) {
  return std::min(options.data_bits, most_bits);
}

void change(CorePlan& plan, const CoreOptions& options) {
  plan.add_behind("replies", {"rings", "rings",
                              hls::RingBits{.bytes = options.byte_bits,
                                            .tag = options.tag_bits,
                                            .distance = options.bits.distance(),
                                            .data = bits_of(options)}});
  plan.add_links(links);
  for (const CorePin& pin : plan.pins)
    if (pin.part == "ray" && pin.is_input) plan.wires.push_back({"rings", pin.name, "ray", pin.of});
  plan.wires.push_back({"ray", "in_ready", "rings", std::string(hls::rings::ray_taken.name())});
  std::vector<CorePin> own = pins();
  // A bus of 64 bits has no second word.
  if (bits_of(options) < most_bits)
    std::erase_if(own, [](const CorePin& pin) { return pin.name == hls::rings::put_1.name(); });
  plan.replace_pins(
      [](const CorePin& pin) { return pin.name.starts_with("ray_") || pin.name.starts_with("hit_"); },
      std::move(own));
}

void check(const CoreOptions& options) {
  if (options.tag_bits > hls::RingBits::most_tag)
    throw std::runtime_error(fmt::format("bits of a tag {}: with rays from memory, allowed is 1 to {}",
                                         options.tag_bits, hls::RingBits::most_tag));
}

/// Channels of its own. Where reads of blocks have identifiers, reads and writes have one too: the epoch.
void add_channels(AxiPlan& plan) {
  const int data = bits_of(plan.core.options), bytes = plan.core.options.byte_bits;
  const auto add = [&](AxiChannel channel) {
    if (plan.has_part("epoch")) channel.data.insert(channel.data.begin(), {"id", hls::EpochBits{}.epoch});
    plan.add_channel(channel);
  };
  const std::vector<std::pair<std::string, int>> burst{{"addr", bytes}, {"len", 8},   {"size", 3},
                                                       {"burst", 2},    {"cache", 4}, {"prot", 3}};
  add({"m_axi_ring_ar", false, burst});
  add({"m_axi_ring_r", true, {{"data", data}, {"resp", 2}, {"last", 1}}});
  add({"m_axi_ring_aw", false, burst});
  plan.add_channel({"m_axi_ring_w", false, {{"data", data}, {"strb", data / 8}, {"last", 1}}});
  add({"m_axi_ring_b", true, {{"resp", 2}}});
}

/// The number of beats of one record or of four, less 1.
Source length(const AxiPlan& plan, const char* is_four, int record_bytes) {
  const int beats = 8 * record_bytes / bits_of(plan.core.options);
  const int low = hls::count_bits(beats);
  const Source four = plan.all("core", is_four);
  return AxiPlan::beside({AxiPlan::constant(static_cast<std::uint64_t>(beats - 1), low), four, four,
                          AxiPlan::constant(0, 8 - low - 2)});
}

void axi(AxiPlan& plan) {
  add_channels(plan);
  const int data = bits_of(plan.core.options);
  for (const auto& [to, from] : {std::pair{"fetch_ready", "m_axi_ring_arready"},
                                 {"store_ready", "m_axi_ring_awready"},
                                 {"put_ready", "m_axi_ring_wready"}})
    plan.join("core", to, "", from);
  for (const auto& [to, from] : {std::pair{"arvalid", "fetch_valid"},
                                 {"araddr", "fetch_address"},
                                 {"awvalid", "store_valid"},
                                 {"awaddr", "store_address"},
                                 {"wvalid", "put_valid"},
                                 {"wlast", "put_last"}})
    plan.join("", fmt::format("m_axi_ring_{}", to), "core", from);
  plan.join("core", "fetched_valid", plan.valid_now("m_axi_ring_r"));
  plan.join("core", "fetched_error", plan.some("", "m_axi_ring_rresp", 1, 1));
  plan.join_beat("core", "fetched", "m_axi_ring_rdata");
  plan.join("core", "stored_valid", plan.valid_now("m_axi_ring_b"));
  plan.join("core", "stored_error", plan.some("", "m_axi_ring_bresp", 1, 1));
  std::vector<Source> words{plan.all("core", "put_0")};
  if (plan.has("core", "put_1")) words.push_back(plan.all("core", "put_1"));
  plan.join("", "m_axi_ring_wdata", AxiPlan::beside(words));
  plan.join("", "m_axi_ring_wstrb", AxiPlan::constant((1U << data / 8) - 1, data / 8));
  plan.join_burst("m_axi_ring_ar", length(plan, "fetch_four", ray_bytes), data / 8);
  plan.join_burst("m_axi_ring_aw", length(plan, "store_four", hit_bytes), data / 8);
  if (plan.has_part("epoch"))
    for (const char* const id : {"m_axi_ring_arid", "m_axi_ring_awid"}) plan.join("", id, "epoch", "present");
  // It has room for what it asks for.
  for (const char* const ready : {"m_axi_ring_rready", "m_axi_ring_bready"})
    plan.join("", ready, AxiPlan::constant(1, 1));
  plan.join("core", "lets_fetches", "registers", "lets_rays");
  plan.join("registers", "ray_valid", "core", "ray_begins");
  plan.join("registers", "ray_ready", AxiPlan::constant(1, 1));
  plan.add_output("irq", "registers", "irq");
}

CoreRecords records(const Core& core) {
  const Part& unit = core.part("ray");
  std::vector<Port> ray{{"any", 1, false}};
  ray.front().comment = "1: any hit will do; 0: the nearest";
  std::vector<StreamField> in_ray{{"any", 8 * any_at, 1}};
  for (const Port& operand : unit.design->ports(unit.format)) {
    in_ray.push_back({operand.name, static_cast<int>(ray.size() - 1) * operand.width, operand.width});
    ray.push_back(operand);
    ray.back().comment = description(operand);
  }
  std::vector<Port> hit = ports_of(core, "hit_");
  hit.push_back({"t", core.options.bits.distance(), false});
  hit.back().comment = "T of the hit; without one the ray's length";
  const int places[] = {hit_failed_at, hit_number_at, hit_t_at};
  std::vector<StreamField> in_hit;
  for (std::size_t i = 0; i < hit.size(); ++i) in_hit.push_back({hit[i].name, 8 * places[i], hit[i].width});
  return {{ray, in_ray, ray_bytes, fmt::format("a ray, with the tag from bit {} on", 8 * ray_tag_at),
           "ray in memory"},
          {hit, in_hit, hit_bytes, fmt::format("an answer, with the tag from bit {} on", 8 * hit_tag_at),
           "answer in memory"},
          "rings in memory"};
}

CHeaderPart c_header(const Core& core) {
  return {
      .constants = fmt::format("#define CORE_RING_BEAT_BYTES {}\n"
                               "#define CORE_RING_LINE_BYTES {} /* a ring begins at a multiple of it */\n",
                               bits_of(core.options) / 8, 4 * ray_bytes),
      .functions = fmt::format(R"(
/* The tag in a ray's bytes, and that in an answer's. */
static inline void core_put_tag(uint8_t* bytes, uint32_t tag) {{
  core_put(bytes + {0}, {1}, tag);
}}
static inline uint32_t core_get_tag(const uint8_t* bytes) {{
  return (uint32_t)core_get(bytes + {2}, {1});
}}
)",
                               ray_tag_at, tag_bytes, hit_tag_at)};
}

}  // namespace

const Feature& feature() {
  static const Feature feature{
      .name = "rings",
      .what = "rays from memory",
      .summary = "rays come from memory, and answers go there",
      .smallest = "--rings",
      .is_in = [](const CoreOptions& options) { return options.rings; },
      .options =
          {{.group = CoreOption::Group::core,
            .name = "--rings",
            .help =
                "The core reads rays from a ring in memory and writes answers to another, by a port of its "
                "own; with --door float",
            .get = number_at<&CoreOptions::rings>,
            .set = put_number<&CoreOptions::rings>,
            .is_flag = true,
            .json = "rings"}},
      .needs = {{"float_door", "integers"}},
      .check = check,
      .change = change,
      .axi = axi,
      .registers = [](hls::RegisterBits& bits) { bits.rings = 1; },
      .axi_json = [](Json& json, const Core& core) { json["ring_bits"] = bits_of(core.options); },
      .records = records,
      .identify = [](CoreIdentity& identity,
                     const CoreOptions& options) { identity.put("rings", options.rings ? 1 : 0); },
      .c_constant = "HAS_RINGS",
      .c_value = [](const CoreOptions& options) { return options.rings ? 1 : 0; },
      .c_header = c_header,
      .harness = "rings",
      .harness_otherwise = "streams",
      .failures = {{"a ray in memory cannot be read", "it fails: 1. Bit 16 of the status"},
                   {"an answer cannot be written to memory",
                    "register 0xb4 stops before it, and so does the core. Bit 17 of the status; "
                    "`core_answers()` says so"},
                   {"more rays are offered than a ring has places",
                    "none of them begins. Bit 18 of the status; `core_answers()` says so"}},
      .promises = {{"rays and answers once, as they are",
                    "rings",
                    "h9g1t4d64",
                    {{"s/spoilt_now = .*;/spoilt_now = rings_and_4;/"}}},
                   {"rays and answers once, in wider beats",
                    "rings",
                    "h9g1t4d128",
                    {{"s/four_rays_or_2 = .*;/four_rays_or_2 = held[4];/",
                      "four rays, of which one has no room"}}},
                   {"no ray is read without a place for its answer",
                    "rings",
                    "h10g1t4d128",
                    {{"s/full_and_5 = .*;/full_and_5 = 0;/", "rays without an answer are not compared"}}},
                   {"each access once, with rings",
                    "registers",
                    "a4h9i1c34r1",
                    {{"s/next_offered_r_value = .*;/next_offered_r_value = next_offered_r_value_or_2;/"}}},
                   {.what = "a hard reset, and the identifiers of `m_axi_ring`",
                    .test = "PairedCore.PassesInAllTools"}}};
  return feature;
}

}  // namespace hitpipe::rtl::features::rings
