#include "rtl_gen/core/system.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/core/c_header.hpp"
#include "rtl_gen/core/harness_text.hpp"

namespace hitpipe::rtl {

namespace {

std::string with_name(std::string text, const std::string& module) {
  constexpr std::string_view place = "core_module";
  for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + module.size()))
    text.replace(at, place.size(), module);
  return text;
}

/// Whether a hit has the weights of its ray.
std::string compared_weights(const Core& core) {
  const hls::WorldBits world = core.options.bits.world();
  const auto same = [](const char* name, int bits, int place) {
    return fmt::format("is_size(hit.{0}_high, hit.{0}_low, {1}, ray.weights[{2}], ray.weights[{3}])", name,
                       bits / 2, place, place + 1);
  };
  return fmt::format(R"(
// A number with a sign in two halves has that size.
bool is_size(int64_t high, uint64_t low, int low_bits, uint64_t size_high, uint64_t size_low) {{
  const uint64_t mask = (uint64_t{{1}} << low_bits) - 1;
  if (high < 0) {{
    low = (~low + 1) & mask;
    high = low == 0 ? -high : ~high;
  }}
  return static_cast<uint64_t>(high) == size_high && low == size_low;
}}
bool has_weights(const core_hit& hit, const Ray& ray) {{
  return {} &&
         {} &&
         {};
}}
)",
                     same("det", world.determinant(), 0), same("u", world.edge(), 2),
                     same("v", world.edge(), 4));
}

std::string number_text(Word value, const Port& port) {
  if (port.kind == hls::Kind::real)
    return fmt::format("{:a}", std::bit_cast<float>(static_cast<std::uint32_t>(value)));
  const auto bits = static_cast<std::uint64_t>(value) << (64 - port.width);
  return port.is_signed ? fmt::format("{}", static_cast<std::int64_t>(bits) >> (64 - port.width))
                        : fmt::format("{}", bits >> (64 - port.width));
}

}  // namespace

std::string scene_text(const Core& core, const CoreScene& scene) {
  std::string text;
  for (const std::array<std::uint64_t, 4>& block : scene.blocks)
    text += fmt::format("b {}\n", fmt::join(block, " "));
  const std::vector<Port> ports = ray_ports(core);
  for (const CoreScene::Ray& ray : scene.rays) {
    text += "r";
    for (std::size_t i = 0; i < ports.size(); ++i) text += " " + number_text(ray.fields[i], ports[i]);
    text += fmt::format(" {} {} {} {}{}{}\n", ray.number, ray.t, ray.records, ray.triangles,
                        ray.weights.empty() ? "" : " ", fmt::join(ray.weights, " "));
  }
  return text;
}

std::string system_program(const Core& core) {
  std::string fields;
  for (const Port& port : ray_ports(core)) fields += fmt::format("      read(file, ray.{});\n", port.name);
  std::string text =
      with_name(std::string(harness_registers).append(harness_system).append(harness_host), core.module);
  const auto put = [&](std::string_view place, const std::string& what) {
    text.replace(text.find(place), place.size(), what);
  };
  const bool has_ids = !core.options.has_one_id();
  put("RAY_FIELDS", fields);
  put("IDS", has_ids ? R"(uint32_t asked_id(const Top& top) { return top.m_axi_arid; }
void show_id(Top& top, uint32_t id) { top.m_axi_rid = id; }
)"
                     : R"(uint32_t asked_id(const Top&) { return 0; }
void show_id(Top&, uint32_t) {}
)");
  const bool rings = core.options.rings;
  put("DOOR_TYPE", rings ? std::string(harness_rings) : "using Doors = Top;");
  put("DOOR_MEMBERS", rings ? "Rings rings;\n  Doors& doors = rings.doors;" : "Doors& doors = top;");
  put("SPOIL", core.options.door == Door::binary32 ? "ray.dx = ray.dy = ray.dz = 0" : "ray.error = 1");
  const bool questions = core.options.questions;
  put("ASKS_ANY", questions ? "ray.ray.any && !ray.ray.once" : "ray.ray.any");
  const bool weights = core.options.weights;
  put("WEIGHTS_WANTED",
      weights ? "  uint64_t weights[6];  // |det|, |u| and |v| of a hit, the high half first\n" : "");
  put("WEIGHTS_COMPARED", weights ? compared_weights(core) : "");
  put("WEIGHTS_SAME", weights ? fmt::format(" && (hit.number == CORE_NO_HIT{} || has_weights(hit, ray))",
                                            questions ? " || ray.ray.once" : "")
                              : "");
  put("WEIGHTS_READ", weights ? "      for (uint64_t& half : line.weights) read(file, half);\n" : "");
  return text;
}

}  // namespace hitpipe::rtl
