#include "rtl_gen/core/c_header.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <vector>

#include <fmt/format.h>

#include "hls/machines/registers.hpp"
#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/core/axi_rings.hpp"
#include "rtl_gen/core/c_image.hpp"
#include "rtl_gen/core/c_ray.hpp"
#include "rtl_gen/core/identity.hpp"

namespace hitpipe::rtl {

namespace {

bool is_float(const Port& port) {
  return port.kind == hls::Kind::real;
}

std::string c_fields(const std::vector<Port>& ports) {
  std::string text;
  for (const Port& port : ports)
    text += fmt::format("  {} {};{}\n",
                        is_float(port)   ? "float"
                        : port.is_signed ? "int64_t"
                                         : "uint64_t",
                        port.name, port.comment.empty() ? "" : fmt::format(" /* {} */", port.comment));
  return text;
}

/// Empty for a core without weights.
std::string weights_function(const Core& core) {
  if (!core.options.weights) return "";
  hls::WorldBits world = core.options.bits.world();
  const auto size = [](const char* name, int bits) {
    return fmt::format("fabs(ldexp((double)hit->{0}_high, {1}) + (double)hit->{0}_low)", name, bits / 2);
  };
  return fmt::format(R"(
/* Weights of corners 1 and 2 where the ray hits its triangle; that of corner 0 is the rest to 1. */
static inline void core_weights(const struct core_hit* hit, double* weight_1, double* weight_2) {{
  const double det = ldexp({0}, {1});
  *weight_1 = {2} / det;
  *weight_2 = {3} / det;
}}
)",
                     size("det", world.determinant()), world.finer, size("u", world.edge()),
                     size("v", world.edge()));
}

/// The tag of a ray and of an answer in memory. Empty for a core without rings.
std::string ring_functions(const Core& core) {
  if (!core.options.rings) return "";
  return fmt::format(R"(
/* The tag in a ray's bytes, and that in an answer's. */
static inline void core_put_tag(uint8_t* bytes, uint32_t tag) {{
  core_put(bytes + {0}, {1}, tag);
}}
static inline uint32_t core_get_tag(const uint8_t* bytes) {{
  return (uint32_t)core_get(bytes + {2}, {1});
}}
)",
                     ring_ray_tag_at, ring_tag_bytes, ring_hit_tag_at);
}

}  // namespace

std::string c_header(const Core& core) {
  std::string guard = core.module + "_h";
  for (char& letter : guard) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  const hls::RayBits& bits = core.options.bits;
  const CoreIdentity identity = identity_of(core.options);
  std::string registers, pack, unpack;
  const auto at = [&](const char* what, int place) {
    registers += fmt::format("#define CORE_{} 0x{:02x}\n", what, 4 * place);
  };
  at("REG_IDENTITY", hls::registers::identity_at);
  at("REG_VERSION", hls::registers::version_at);
  at("REG_STATUS", hls::registers::status_at);
  at("REG_CONTROL", hls::registers::control_at);
  at("REG_BASE_LOW", hls::registers::base_at);
  at("REG_BASE_HIGH", hls::registers::high_base_at);
  at("REG_LAST_BLOCK", hls::registers::last_at);
  at("REG_MOST_STEPS", hls::registers::most_steps_at);
  at("REG_MOST_RAYS", hls::registers::most_rays_at);
  at("REG_CLEAR_COUNTERS", hls::registers::clear_at);
  at("REG_FORMAT", hls::registers::format_at);
  at("REG_SHAPE", hls::registers::shape_at);
  at("REG_PORTS", hls::registers::ports_at);
  if (core.options.has_cache()) at("REG_MOST_LINES", hls::registers::most_lines_at);
  if (core.options.rings) {
    at("REG_RAYS_LOW", hls::registers::rays_low_at);
    at("REG_RAYS_HIGH", hls::registers::rays_high_at);
    at("REG_ANSWERS_LOW", hls::registers::answers_low_at);
    at("REG_ANSWERS_HIGH", hls::registers::answers_high_at);
    at("REG_RING_LAST", hls::registers::ring_last_at);
    at("REG_OFFERED", hls::registers::offered_at);
    at("REG_INTERRUPT", hls::registers::interrupt_at);
    at("REG_ANSWERED", hls::registers::answered_at);
  }
  int place = hls::registers::counters_at;
  std::vector<const char*> counters{"CYCLES",  "RAYS",      "ANSWERS", "HITS",
                                    "RECORDS", "TRIANGLES", "IDLE",    "REFUSED"};
  if (core.options.has_cache()) counters.insert(counters.end(), {"CACHE_HITS", "CACHE_JOINS", "CACHE_LINES"});
  for (const char* const counter : counters) {
    at(fmt::format("COUNT_{}", counter).c_str(), place);
    place += 2;
  }
  const std::vector<Port> ray = ray_ports(core);
  const std::string bits_of = std::none_of(ray.begin(), ray.end(), is_float) ? "" : R"(
static inline uint64_t core_bits_of(float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
})";
  const std::vector<StreamField> in_ray = ray_fields(core);
  for (std::size_t i = 0; i < ray.size(); ++i) {
    const std::string value = is_float(ray[i]) ? fmt::format("core_bits_of(ray->{})", ray[i].name)
                                               : fmt::format("(uint64_t)ray->{}", ray[i].name);
    pack += fmt::format("  core_put(bytes + {}, {}, {});\n", in_ray[i].offset / 8, (in_ray[i].width + 7) / 8,
                        value);
  }
  const std::vector<Port> hit = hit_ports(core);
  const std::vector<StreamField> in_hit = hit_fields(core);
  for (std::size_t i = 0; i < hit.size(); ++i) {
    const std::string got =
        fmt::format("core_get(bytes + {}, {})", in_hit[i].offset / 8, (in_hit[i].width + 7) / 8);
    const int above = 64 - in_hit[i].width;
    unpack += hit[i].is_signed
                  ? fmt::format("  hit->{0} = (int64_t)({1} << {2}) >> {2};\n", hit[i].name, got, above)
                  : fmt::format("  hit->{} = {};\n", hit[i].name, got);
  }
  std::string of_options;
  if (core.options.has_cache())
    of_options += fmt::format("#define CORE_EMPTY_CACHE {}u\n", 1 << hls::registers::empties_bit);
  if (core.options.rings)
    of_options += fmt::format(
        "#define CORE_RING_ERROR 0x{:x}u /* a ray could not be read, or an answer not written */\n"
        "#define CORE_RING_BEAT_BYTES {}\n#define CORE_RING_LINE_BYTES {} /* a ring begins at a multiple of "
        "it */\n",
        1U << hls::registers::ring_bit, core.options.ring_bits() / 8, 4 * ring_ray_bytes);
  return fmt::format(
      R"(/* Registers and records of {module}_axi, {bits}, {rays} rays in flight. Generated by hitpipe; do not edit. */
#ifndef {guard}
#define {guard}

{more_includes}#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Registers of 32 bits; a counter has two, the low one first. */
{registers}
#define CORE_IDENTITY 0x{identity:08x}u
#define CORE_VERSION {version}u
/* What the registers CORE_REG_FORMAT, _SHAPE and _PORTS say of this core. */
#define CORE_FORMAT 0x{format:08x}u
#define CORE_SHAPE 0x{shape:08x}u
#define CORE_PORTS 0x{ports:08x}u
/* Bits of CORE_REG_STATUS. All but the first two stay until a 1 is written to them. */
#define CORE_IDLE 0x{idle:x}u      /* no ray is in the core */
#define CORE_RESETTING 0x{resetting:x}u /* a soft reset is on its way */
#define CORE_FAILED(why) (0x{failed:x}u << (why)) /* an answer has failed by this, 1 to {most_failed} */
#define CORE_BUS_ERROR 0x{bus:x}u  /* a block could not be read */
#define CORE_BASE_ERROR 0x{base:x}u /* a base address was written that is no multiple of 64 */
#define CORE_SOFT_RESET 1u /* to CORE_REG_CONTROL */
{of_options}#define CORE_RAYS {rays}
#define CORE_TAG_BITS {tag_bits}
#define CORE_ADDRESS_BITS {byte_bits}
#define CORE_BLOCK_BITS {block_bits} /* of the number of a block */
#define CORE_BLOCK_BYTES 32
#define CORE_LINE_BYTES 64 /* an image begins at a multiple of it */
#define CORE_BEAT_BYTES {beat_bytes}
#define CORE_HAS_ONE_ID {has_one_id}
#define CORE_CACHE_KIB {cache_kib}
#define CORE_HAS_RINGS {has_rings}
#define CORE_BURST_BYTES {burst_bytes} /* that a read of memory has */
#define CORE_NO_HIT 0xffffffffu
/* T from the middle of the cube to its side, along the largest component of the direction. */
#define CORE_T_ONE {t_one}

#define CORE_RAY_BYTES {ray_bytes}
#define CORE_HIT_BYTES {hit_bytes}

/* What a {ray_place} says. */
struct core_ray {{
{ray_fields}}};
/* What a {hit_place} says. */
struct core_hit {{
{hit_fields}}};

static inline void core_put(uint8_t* bytes, int count, uint64_t value) {{
  for (int i = 0; i < count; ++i) bytes[i] = (uint8_t)(value >> 8 * i);
}}
static inline uint64_t core_get(const uint8_t* bytes, int count) {{
  uint64_t value = 0;
  for (int i = 0; i < count; ++i) value |= (uint64_t)bytes[i] << 8 * i;
  return value;
}}{bits_of}

static inline void core_pack_ray(uint8_t* bytes, const struct core_ray* ray) {{
{pack}}}
static inline void core_unpack_hit(struct core_hit* hit, const uint8_t* bytes) {{
{unpack}}}
{rings}{rays_of_floats}{weights}{image}
#endif
)",
      fmt::arg("module", core.module), fmt::arg("bits", to_string(Format(bits))),
      fmt::arg("rays", core.options.rays), fmt::arg("guard", guard),
      fmt::arg("more_includes", core.options.weights ? "#include <math.h>\n" : ""),
      fmt::arg("registers", registers), fmt::arg("identity", hls::registers::identity),
      fmt::arg("version", hls::registers::version), fmt::arg("format", identity.format),
      fmt::arg("shape", identity.shape), fmt::arg("ports", identity.ports),
      fmt::arg("idle", 1U << hls::registers::idle_bit),
      fmt::arg("resetting", 1U << hls::registers::resetting_bit),
      fmt::arg("failed", 1U << hls::registers::failed_bit), fmt::arg("most_failed", int{hls::unread_block}),
      fmt::arg("bus", 1U << hls::registers::bus_bit), fmt::arg("base", 1U << hls::registers::base_bit),
      fmt::arg("block_bits", core.options.address_bits), fmt::arg("tag_bits", core.options.tag_bits),
      fmt::arg("byte_bits", core.options.byte_bits), fmt::arg("beat_bytes", core.options.data_bits / 8),
      fmt::arg("has_one_id", core.options.has_one_id() ? 1 : 0),
      fmt::arg("has_rings", core.options.rings ? 1 : 0), fmt::arg("cache_kib", core.options.cache_kib),
      fmt::arg("burst_bytes", core.options.burst_bits() / 8), fmt::arg("of_options", of_options),
      fmt::arg("t_one", ((std::int64_t{1} << (bits.coord - 2)) - 1) << (bits.finer + bits.fraction)),
      fmt::arg("ray_bytes", ray_bytes(core)), fmt::arg("hit_bytes", hit_bytes(core)),
      fmt::arg("ray_place", core.options.rings ? "ray in memory" : "beat of s_axis_ray"),
      fmt::arg("hit_place", core.options.rings ? "answer in memory" : "beat of m_axis_hit"),
      fmt::arg("ray_fields", c_fields(ray)), fmt::arg("hit_fields", c_fields(hit)),
      fmt::arg("bits_of", bits_of), fmt::arg("pack", pack), fmt::arg("unpack", unpack),
      fmt::arg("rings", ring_functions(core)), fmt::arg("rays_of_floats", c_ray(core)),
      fmt::arg("weights", weights_function(core)), fmt::arg("image", c_image(core)));
}

}  // namespace hitpipe::rtl
