#include "cli/report/core_facts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "area_model/figure.hpp"
#include "cli/options/core_options.hpp"
#include "cli/options/world_options.hpp"
#include "cli/text/trace_text.hpp"
#include "host/parallel.hpp"
#include "rtl_gen/catalogue/format.hpp"
#include "sim/core/memory_port.hpp"
#include "sim/core/native_core.hpp"

namespace hitpipe::cli {

namespace {

/// The longer side of the picture. All results of a usual scene are there in about 20 seconds then.
constexpr int most_pixels = 32;

constexpr std::array worlds{hls::WorldBits{16, 1, 16}, hls::WorldBits{20, 1, 20}};
constexpr std::array triangle_intervals{4, 8, 16};
constexpr std::array rays_of_rates{32, 128};
constexpr std::array rays_of_busy{8, 16, 32, 64, 128, 192, 256};
constexpr std::array latencies{20, 100, 200};
constexpr std::array caches{0, 4, 16, 64};
/// With the width of their bus, on which all requests have one identifier if it is not a block's.
struct Memory {
  const char* name;
  int data_bits;
};
constexpr std::array memories{Memory{"dram", 256}, Memory{"litedram-128", 128}, Memory{"axi-256", 256}};
int data_bits_of(const CoreSetting& setting) {
  for (const Memory& memory : memories)
    if (setting.memory == memory.name) return memory.data_bits;
  return rtl::CoreOptions{}.data_bits;
}

std::string name_of(const hls::WorldBits& world) {
  return rtl::to_string(rtl::Format(world));
}

void add_settings(CoreFacts& facts) {
  const auto add = [&](std::vector<std::size_t>& plot, const CoreSetting& setting) {
    const auto known = std::find_if(facts.results.begin(), facts.results.end(),
                                    [&](const CoreResult& result) { return result.setting == setting; });
    plot.push_back(static_cast<std::size_t>(known - facts.results.begin()));
    if (known == facts.results.end()) facts.results.push_back({.setting = setting, .price = {}, .trace = {}});
  };
  for (const hls::WorldBits& world : worlds)
    for (const int interval : triangle_intervals)
      for (const int rays : rays_of_rates)
        add(facts.rates, {.world = world, .triangle_interval = interval, .rays = rays});
  for (const int latency : latencies)
    for (const int rays : rays_of_busy) add(facts.busy, {.rays = rays, .latency = latency});
  for (const int cache : caches) add(facts.cache, {.cache_kib = cache});
  for (const Memory& memory : memories)
    for (const int cache : caches)
      add(facts.memories, {.rays = 32, .memory = memory.name, .cache_kib = cache});
}

/// The scene and its picture as a core gets them.
struct Traced {
  hls::WorldBits world;
  ref::CoreImage image;
  sim::PictureRays picture;
};

Traced traced_in_software(const ref::Scene& scene, const hls::WorldBits& world, const CoreFacts& facts,
                          const ref::HierarchyOptions& hierarchy) {
  const auto of_integers = std::make_shared<const ref::IntScene>(ref::int_scene(scene, world, hierarchy));
  ref::CoreImage image = ref::core_image(*of_integers);
  sim::PictureRays picture = sim::picture_rays(
      of_integers, image, {.world = world, .boxes = usual_box_format(world), .places = CoreChoice{}.places},
      {.width = facts.width, .height = facts.height});
  if (picture.jobs.empty()) throw std::runtime_error("its picture has no ray");
  return {world, std::move(image), std::move(picture)};
}

/// Cores that differ in rays in flight, cache and bus alone, and the results that they are for.
struct Family {
  const Traced* traced;
  std::vector<rtl::CoreOptions> options;
  std::vector<rtl::Core> cores;
  struct Use {
    std::size_t result, core;
  };
  std::vector<Use> uses;
};

std::vector<Family> families_of(const CoreFacts& facts, const std::vector<Traced>& traced) {
  std::vector<Family> families;
  for (std::size_t i = 0; i < facts.results.size(); ++i) {
    const CoreSetting& setting = facts.results[i].setting;
    rtl::CoreOptions options = CoreChoice{}.core();
    options.bits = usual_ray_format(setting.world);
    options.triangle_interval = setting.triangle_interval;
    options.rays = setting.rays;
    options.cache_kib = setting.cache_kib;
    options.data_bits = data_bits_of(setting);
    auto family = std::find_if(families.begin(), families.end(), [&](const Family& each) {
      return name_of(each.traced->world) == name_of(setting.world) &&
             each.options.front().triangle_interval == setting.triangle_interval;
    });
    if (family == families.end()) {
      const auto of_world = std::find_if(traced.begin(), traced.end(), [&](const Traced& each) {
        return name_of(each.world) == name_of(setting.world);
      });
      family = families.insert(families.end(), {&*of_world, {}, {}, {}});
    }
    sim::make_room(options, family->traced->image);
    const auto same =
        std::find_if(family->options.begin(), family->options.end(), [&](const rtl::CoreOptions& each) {
          return each.rays == options.rays && each.cache_kib == options.cache_kib &&
                 each.data_bits == options.data_bits;
        });
    family->uses.push_back({i, static_cast<std::size_t>(same - family->options.begin())});
    if (same == family->options.end()) family->options.push_back(options);
  }
  return families;
}

/// As `core trace --memory` has it.
std::string memory_text(const CoreSetting& setting) {
  return setting.memory == "ideal" ? fmt::format("ideal,latency={}", setting.latency) : setting.memory;
}

std::string command_of(const CoreMeasurement& how, const CoreFacts& facts, const CoreSetting& setting,
                       const std::vector<int>& rays) {
  return fmt::format(
      "hitpipe core trace --native {} --width {} --height {} --bits {} --triangle-ii {} --rays-in-flight {} "
      "--memory {}{}{}{} --format csv",
      how.scene_options, facts.width, facts.height, name_of(setting.world), setting.triangle_interval,
      fmt::join(rays, ","), memory_text(setting),
      data_bits_of(setting) == rtl::CoreOptions{}.data_bits
          ? ""
          : fmt::format(" --data-bits {}", data_bits_of(setting)),
      setting.cache_kib == 0 ? "" : fmt::format(" --cache {}", setting.cache_kib), how.library_option);
}

/// A command traces with all numbers of rays in flight.
std::vector<std::string> commands_of_all(const CoreMeasurement& how, const CoreFacts& facts) {
  std::vector<CoreSetting> settings;
  std::vector<std::vector<int>> rays;
  for (const CoreResult& result : facts.results) {
    CoreSetting setting = result.setting;
    setting.rays = 0;
    const auto known = std::find(settings.begin(), settings.end(), setting);
    const auto place = static_cast<std::size_t>(known - settings.begin());
    if (known == settings.end()) {
      settings.push_back(setting);
      rays.emplace_back();
    }
    rays[place].push_back(result.setting.rays);
  }
  std::vector<std::string> commands;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    std::sort(rays[i].begin(), rays[i].end());
    commands.push_back(command_of(how, facts, settings[i], rays[i]));
  }
  return commands;
}

Row row_of(const CoreMeasurement& how, const CoreFacts& facts, const rtl::Core& core,
           const CoreResult& result) {
  const CoreSetting& setting = result.setting;
  const bool cached = setting.cache_kib > 0;
  Row row{{"bits", rtl::to_string(rtl::Format(core.options.bits))},
          {"triangle_ii", setting.triangle_interval},
          {"memory", setting.memory},
          {"latency", setting.memory == "ideal" ? Row(setting.latency) : Row(nullptr)},
          {"cache_kib", setting.cache_kib}};
  row.update(trace_row(result.trace, cached));
  if (!cached) row["cache_hits_pct"] = nullptr;
  row["clock_ps"] = result.trace.clock_ps;
  if (how.library->chip() == nullptr) {
    row["area_mm2"] = Row::parse(area::area_mm2(result.price.area_um2));
  } else {
    row["luts"] = result.price.taken.luts;
    row["registers"] = result.price.taken.registers;
    row["multiplier_blocks"] = result.price.taken.blocks;
  }
  row["memory_bits"] = result.price.memory_bits;
  row["command"] = command_of(how, facts, setting, {setting.rays});
  return row;
}

}  // namespace

bool operator==(const CoreSetting& a, const CoreSetting& b) {
  return name_of(a.world) == name_of(b.world) && a.triangle_interval == b.triangle_interval &&
         a.rays == b.rays && a.memory == b.memory && a.latency == b.latency && a.cache_kib == b.cache_kib;
}

std::uint64_t CoreFacts::wrong() const {
  std::uint64_t count = 0;
  for (const CoreResult& result : results) count += result.trace.wrong;
  return count;
}

std::uint64_t CoreFacts::other_reads() const {
  return static_cast<std::uint64_t>(std::count_if(
      results.begin(), results.end(), [](const CoreResult& result) { return !result.trace.same_reads; }));
}

CoreFacts measure_core(const ref::Scene& scene, const CoreMeasurement& how) {
  CoreFacts facts;
  const double scale = std::min(1.0, static_cast<double>(most_pixels) / std::max(how.width, how.height));
  const auto scaled = [&](int side) { return std::max(1, static_cast<int>(std::lround(side * scale))); };
  facts.width = scaled(how.width);
  facts.height = scaled(how.height);
  add_settings(facts);
  struct Run {
    const Traced* traced;
    const rtl::Core* core;
  };
  std::vector<Run> runs(facts.results.size());
  std::vector<Traced> traced;
  std::vector<Family> families;
  try {
    for (const hls::WorldBits& world : worlds)
      traced.push_back(traced_in_software(scene, world, facts, how.hierarchy));
    families = families_of(facts, traced);
    host::for_each_index(families.size(), how.threads, [&](std::size_t i) {
      families[i].cores = rtl::make_cores(families[i].options, *how.library);
    });
    for (const Family& family : families)
      for (const auto& [result, core] : family.uses) {
        runs[result] = {family.traced, &family.cores[core]};
        facts.results[result].price = area::price(family.cores[core], *how.library).all;
      }
  } catch (const std::runtime_error& reason) {
    CoreFacts none;
    none.why_not = reason.what();
    return none;
  }
  host::for_each_index(
      runs.size(), how.threads,
      [&](std::size_t i) {
        CoreResult& result = facts.results[i];
        const auto& [of, core] = runs[i];
        sim::NativeCore machine(*core);
        const sim::MemoryPort memory = sim::memory_port(memory_text(result.setting));
        result.trace = sim::trace_core(*core, machine, of->image, of->picture,
                                       sim::memory_behind(memory, core->options));
      },
      how.progress);
  for (std::size_t i = 0; i < runs.size(); ++i)
    facts.rows.push_back(row_of(how, facts, *runs[i].core, facts.results[i]));
  facts.commands = commands_of_all(how, facts);
  return facts;
}

}  // namespace hitpipe::cli
