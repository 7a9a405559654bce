// A cache in front of memory (hls/machines/cache.hpp): it reads lines, in place of the machine `requests`, which reads
// blocks.
#include "hls/machines/cache.hpp"

#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "hls/num/bits.hpp"
#include "rtl_gen/core/axi_plan.hpp"
#include "rtl_gen/core/cache_options.hpp"
#include "rtl_gen/core/feature.hpp"

namespace hitpipe::rtl::features::cache {

namespace {

using namespace hls::channels;

constexpr std::array links{
    link<Asks>("reader", "cache"),
    link<BlockRead>("cache", "pair_feed"),
};
constexpr Link to_triangles(std::string_view taker) {
  return link<BlockRead>("cache", taker);
}

/// In place of those of blocks. The bus may not have all of these.
std::vector<CorePin> pins() {
  return {
      output(request_valid, "cache", "a line is wanted"),
      input(request_ready, "memory takes the request at a clock edge with both high"),
      output(request_address, "cache", "of bytes, a multiple of a line's"),
      output(request_id, "cache", "no line on its way has the same"),
      input(beat_valid, "memory gives a beat of a line, the first bytes first"),
      output(beat_ready, "cache", "it is taken at a clock edge with both high"),
      input(hls::cache::beat_id, "of the request; beats of several may mingle"),
      input(beat_error, "1: it could not be read; rays that wait for it fail"),
      input(beat_0, "its first 8 bytes, the lowest address in the lowest bits"),
      input(beat_1, ""),
      input(beat_2, ""),
      input(beat_3, ""),
      input(beat_4, ""),
      input(beat_5, ""),
      input(beat_6, ""),
      input(beat_7, ""),
      input(most_lines, "lines that may be on their way, 1 or more"),
      input(empties_cache, "1: the cache forgets what it has; no ray is in flight"),
      input(lets_asks, "0: rays ask for no block; those that were asked for still come"),
      output(asks, "reader", "a ray asks for a block; what follows is for counters"),
      output(granted, "cache", "the cache takes the question at a clock edge with both high"),
      output(triangle, "reader", "it is a triangle; else a record")
          .named(asks_triangle.name())
          .meant("want_asks"),
      output(read_valid, "cache", "a block is given to its ray"),
      output(read_error, "cache", "1: it could not be read"),
      output(cache_hit, "cache", "a block was there"),
      output(cache_join, "cache", "it was on its way; else its line is asked for"),
  };
}

hls::CacheBits bits_of(const CoreOptions& options) {
  const CacheOptions& cache = options.cache;
  const int lines = (cache.kib << 10) / cache.line;
  return {.address = options.address_bits,
          .bytes = options.byte_bits,
          .ray = options.ray_bits(),
          .set = hls::count_bits(lines / cache.ways),
          .ways = cache.ways,
          .blocks = 8 * cache.line / CoreOptions::block_bits,
          .data = options.data_bits,
          .ids = options.has_one_id() ? 0 : 1};
}

void change(CorePlan& plan, const CoreOptions& options) {
  plan.add_behind("requests", {"cache", "cache", bits_of(options)});
  plan.replace_pins(
      [](const CorePin& pin) { return pin.name.starts_with("request_") || pin.name.starts_with("read_"); },
      pins());
  plan.remove("requests");
  plan.add_links(links);
  for (const char* const taker : {"triangle_feed", "serial_triangle"})
    if (plan.has(taker)) plan.links.push_back(to_triangles(taker));
  plan.bus.burst_bits = 8 * options.cache.line;
  plan.bus.has_lines = true;
}

/// To the registers it is the memory.
void axi(AxiPlan& plan) {
  plan.join("", "m_axi_arvalid", "core", "request_valid");
  plan.join("core", "request_ready", "", "m_axi_arready");
  plan.join("core", "lets_asks", "registers", "lets_requests");
  plan.join("registers", "request_valid", "core", "asks");
  plan.join("registers", "request_ready", "core", "granted");
  plan.join("registers", "request_id",
            AxiPlan::beside(
                {AxiPlan::constant(0, plan.core.options.ray_bits()), plan.all("core", "asks_triangle")}));
  plan.join("registers", "line_asked",
            AxiPlan::through(plan.all("core", "request_valid"), plan.gate("", "m_axi_arready")));
  plan.join("core", "beat_valid", plan.valid_now("m_axi_r"));
  if (plan.has("core", "beat_id"))
    plan.join("core", "beat_id", plan.some("", "m_axi_rid", 0, plan.core.pin(request_id).width));
  plan.join("core", "beat_error", plan.some("", "m_axi_rresp", 1, 1));
  plan.join_beat("core", "beat", "m_axi_rdata");
  plan.join("", "m_axi_rready", "core", "beat_ready");
}

void check(const CoreOptions& options) {
  const auto& [kib, line, ways] = options.cache;
  if (kib < CacheOptions::least_kib || kib > CacheOptions::most_kib || (kib & (kib - 1)) != 0)
    throw std::runtime_error(fmt::format("a cache of {} KiB: allowed is 0, or a power of two from {} to {}",
                                         kib, CacheOptions::least_kib, CacheOptions::most_kib));
  if (line != 32 && line != 64)
    throw std::runtime_error(fmt::format("a cache's lines of {} bytes: allowed is 32, 64", line));
  if (ways != 4 && ways != 8)
    throw std::runtime_error(fmt::format("a cache with {} ways: allowed is 4, 8", ways));
  if (!bits_of(options).valid())
    throw std::runtime_error(
        fmt::format("a cache of {} KiB holds more blocks than {} bits number; allowed is a smaller one", kib,
                    options.address_bits));
}

std::vector<CoreOption> cache_options() {
  using enum CoreOption::Group;
  return {{.group = cache,
           .name = "--cache",
           .help = fmt::format("KiB of a cache in the core, a power of two from {} to {}; 0 is none",
                               CacheOptions::least_kib, CacheOptions::most_kib),
           .get = [](const CoreOptions& options) { return options.cache.kib; },
           .set = [](CoreOptions& options, int kib) { options.cache.kib = kib; },
           .least = CacheOptions::least_kib,
           .most = CacheOptions::most_kib,
           .words = {{"0", 0}},
           .power_of_two = true,
           .type = "KIB",
           .json = "cache_kib"},
          {.group = cache,
           .name = "--cache-line",
           .help = "Bytes of a line of the cache",
           .get = [](const CoreOptions& options) { return options.cache.line; },
           .set = [](CoreOptions& options, int bytes) { options.cache.line = bytes; },
           .words = {{"32", 32}, {"64", 64}},
           .needs = "--cache"},
          {.group = cache,
           .name = "--cache-ways",
           .help = "Lines of a set of the cache",
           .get = [](const CoreOptions& options) { return options.cache.ways; },
           .set = [](CoreOptions& options, int ways) { options.cache.ways = ways; },
           .words = {{"4", 4}, {"8", 8}},
           .needs = "--cache"}};
}

}  // namespace

const Feature& feature() {
  static const Feature feature{
      .name = "cache",
      .what = "a cache",
      .summary = "a cache in front of memory",
      .smallest = "--cache 2",
      .is_in = [](const CoreOptions& options) { return options.cache.kib != 0; },
      .options = cache_options(),
      .check = check,
      .change = change,
      .axi = axi,
      .registers = [](hls::RegisterBits& bits) { bits.cache = 1; },
      .identify =
          [](CoreIdentity& identity, const CoreOptions& options) {
            const auto& [kib, line, ways] = options.cache;
            identity.put("cache_size", kib != 0 ? hls::count_bits(kib) : 0);
            identity.put("short_lines", kib != 0 && line == 32 ? 1 : 0);
            identity.put("eight_ways", kib != 0 && ways == 8 ? 1 : 0);
          },
      .c_constant = "CACHE_KIB",
      .c_value = [](const CoreOptions& options) { return options.cache.kib; },
      .harness = "cache",
      .promises =
          {{"a block a ray, whatever comes first",
            "cache",
            "a5h10i2s1w4l2d256m1",
            {{"s/beat_failed = .*;/beat_failed = beat_error;/", "the error of a first beat is forgotten"}}},
           {"a block a ray, as memory has it",
            "cache",
            "a4h9i2s1w2l2d256",
            {{"s/may_join = look_there & ~fills/may_join = look_there/", "a ray joins as the list is taken"},
             {R"(s/takes_beat_and = ~gives_list \& ~empties/takes_beat_and = ~empties/)",
              "beats while a list is given"},
             {R"(s/value_and \& fill_error/value_and \& 1'b0/)", "a line with an error stays"}}},
           {"each access once, with a cache",
            "registers",
            "a4h9i1c34k1",
            {{R"(s/empties_r <= empties/empties_r <= empties \& ~writes/)"}}},
           {.what = "a hard reset with lines on their way", .test = "PairedCore.PassesInAllTools"}}};
  return feature;
}

}  // namespace hitpipe::rtl::features::cache
