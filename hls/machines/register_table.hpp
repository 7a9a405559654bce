// The registers of a core (registers.hpp): what each word and each of its bits says, once. The machine takes
// places and reset values from here. So do the C header, the manifest and the SystemRDL file
// (rtl_gen/core/registers.hpp), and the model of the registers in a core's harness. Words have 32 bits. A word
// that is not in the table reads as 0, and to write it changes nothing.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "hls/box/format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"

namespace hitpipe::hls {

/// The format "aAhHiIcC", for example a24h32i5c40, and behind it "k1" with a cache and "r1" with rings.
struct RegisterBits {
  int address = 24;  ///< A: bits of a block's number
  int bytes = 32;    ///< H: bits of an address, of bytes, at least A + 5
  int ray = 5;       ///< I: bits of a ray's number
  int counter = 40;  ///< C: bits of a counter
  int cache = 0;     ///< K: 1: the core has a cache
  int rings = 0;     ///< R: 1: rays come from memory, and answers go to it

  static constexpr FormatField fields[] = {{"a", "A", 4, 32},
                                           {"h", "H", 9, 64},
                                           {"i", "I", 1, 8},
                                           {"c", "C", 1, 64},
                                           {"k", "K", 0, 1, nullptr, true},
                                           {"r", "R", 0, 1, nullptr, true}};
  static constexpr const char* condition = "H at least A+5";

  constexpr bool valid() const { return bytes >= address + 5; }
  friend constexpr bool operator==(const RegisterBits&, const RegisterBits&) = default;
};

namespace registers {

/// What a core has if it has a register, or some of its bits.
enum class Feature : std::uint8_t { always, cache, rings };
constexpr bool has(const RegisterBits& bits, Feature feature) {
  return feature == Feature::always || (feature == Feature::cache ? bits.cache : bits.rings) != 0;
}

/// What software may do with bits.
enum class Access : std::uint8_t {
  constant,    ///< read what never changes
  read,        ///< read
  read_write,  ///< read what it has written
  clear,       ///< read, and write 1 to what the core has set, to make it 0
  command,     ///< write 1, so that something happens; they read as 0
  any_write    ///< write anything, even no byte, so that something happens; they read as 0
};
/// In the order of the enumeration.
inline constexpr std::array<std::string_view, 6> access_names{"constant", "ro", "rw", "w1c", "w1", "wo"};

/// What a write makes of a register that keeps it.
enum class Fit : std::uint8_t {
  largest,   ///< a number that has too many bits becomes the largest
  from_one,  ///< likewise, and 0 becomes 1
  cut        ///< it loses the bits that the register does not have, as an address does
};
/// What a soft reset does to bits that software writes.
enum class SoftReset : std::uint8_t {
  keeps,
  clears,  ///< they become 0 at its end
  holds    ///< they are 0 as long as it lasts
};

using BitCount = int (*)(const RegisterBits&);

struct RegisterField {
  std::string_view name;
  int low;                    ///< its lowest bit
  BitCount width;             ///< bits; the field is not there if they are none
  std::string_view sentence;  ///< empty if that of the register says it
  Access access = Access::read;
  std::uint64_t reset = 0;            ///< of a constant: what it is, unless it is another in each core
  Feature feature = Feature::always;  ///< beside that of its register
  SoftReset soft_reset = SoftReset::keeps;
};

struct Register {
  std::string_view name;  ///< in C behind CORE_REG_, and of a counter behind CORE_COUNT_
  int place;              ///< of words, not of bytes
  std::string_view sentence;
  std::span<const RegisterField> fields;  ///< from the lowest bit on
  Feature feature = Feature::always;
  int words = 1;  ///< 2: a counter, the low word first
  Fit fit = Fit::largest;
  bool begins = false;  ///< what is written sets the core to work

  constexpr bool is_counter() const { return words == 2; }
};

constexpr std::int64_t identity = 0x48697470;  ///< "Hitp"
constexpr std::int64_t version = 3;
constexpr int word_place_bits = 6;  ///< words up to 0xfc
/// Low bits of the address of an image, and of a ring, which are 0.
constexpr Width<6> image_zeros;
constexpr Width<7> ring_zeros;
constexpr int ring_counts = channels::ring_count_bits;

namespace detail {

template <int N>
constexpr int bits(const RegisterBits& /*format*/) {
  return N;
}
constexpr int counter_bits(const RegisterBits& format) {
  return format.counter;
}
/// Of an address that is a multiple of 2^Zeros: its bits in the low and in the high word.
template <int Zeros>
constexpr int low_bits(const RegisterBits& format) {
  return min(format.bytes, 32) - Zeros;
}
constexpr int high_bits(const RegisterBits& format) {
  return max(format.bytes, 32) - 32;
}

inline constexpr RegisterField identity_fields[]{{"identity", 0, bits<32>, "", Access::constant, identity}};
inline constexpr RegisterField version_fields[]{{"version", 0, bits<32>, "", Access::constant, version}};

inline constexpr RegisterField status_fields[]{
    {"idle", 0, bits<1>, "no ray is in the core", Access::read, 1},
    {"resetting", 1, bits<1>, "a soft reset is on its way"},
    {"failed", 8 + int{no_ray}, bits<int{unread_block}>, "an answer has failed, by reason 1 to 5",
     Access::clear},
    {"bus_error", 14, bits<1>, "a block could not be read", Access::clear},
    {"base_error", 15, bits<1>, "a base address was written that is no multiple of 64", Access::clear},
    {"ring_error", 16, bits<1>, "a ray could not be read, so it has failed", Access::clear, 0,
     Feature::rings},
    {"unwritten", 17, bits<1>, "an answer could not be written, and none is after it: reset the core",
     Access::clear, 0, Feature::rings},
    {"overfull", 18, bits<1>,
     "more rays were offered than a ring has places, or some were taken back: reset the core", Access::clear,
     0, Feature::rings}};
inline constexpr RegisterField control_fields[]{
    {"soft_reset", 0, bits<1>, "begins a soft reset", Access::command},
    {"empty_cache", 1, bits<1>, "empties the cache", Access::command, 0, Feature::cache}};

inline constexpr RegisterField base_low_fields[]{
    {"base_low", image_zeros, low_bits<image_zeros>, "", Access::read_write}};
inline constexpr RegisterField base_high_fields[]{{"base_high", 0, high_bits, "", Access::read_write}};
inline constexpr RegisterField last_block_fields[]{
    {"last_block", 0, channels::address_bits, "", Access::read_write}};
inline constexpr RegisterField most_steps_fields[]{
    {"most_steps", 0, bits<step_count_bits>, "", Access::read_write, low_mask(step_count_bits)}};
inline constexpr RegisterField most_rays_fields[]{
    {"most_rays", 0, ray_count_bits, "", Access::read_write, 0, Feature::always, SoftReset::holds}};
inline constexpr RegisterField clear_fields[]{{"clear", 0, bits<32>, "", Access::any_write}};
inline constexpr RegisterField most_lines_fields[]{
    {"most_lines", 0, bits<channels::line_count_bits>, "", Access::read_write, 8}};

// What rtl_gen/core/feature.hpp says of a core.
inline constexpr RegisterField format_fields[]{{"coord", 0, bits<8>, "n", Access::constant},
                                               {"finer", 8, bits<4>, "g", Access::constant},
                                               {"fraction", 12, bits<4>, "F", Access::constant},
                                               {"slope", 16, bits<8>, "S", Access::constant},
                                               {"mantissa", 24, bits<8>, "p", Access::constant}};
inline constexpr RegisterField shape_fields[]{
    {"rays", 0, bits<15>, "rays in flight", Access::constant},
    {"questions", 15, bits<1>, "rays may ask count and next", Access::constant},
    {"levels", 16, bits<8>, "levels of records", Access::constant},
    {"block_bits", 24, bits<8>, "bits of a block's number", Access::constant}};
inline constexpr RegisterField ports_fields[]{
    {"tag_bits", 0, bits<8>, "bits of a tag", Access::constant},
    {"byte_bits", 8, bits<8>, "bits of an address", Access::constant},
    {"beat_bytes", 16, bits<7>, "bytes of a beat", Access::constant},
    {"rings", 23, bits<1>, "rays in memory", Access::constant},
    {"floats", 24, bits<1>, "floats at the door", Access::constant},
    {"weights", 25, bits<1>, "weights of corners", Access::constant},
    {"serial", 26, bits<1>, "one multiplier for triangles", Access::constant},
    {"one_id", 27, bits<1>, "one identifier", Access::constant},
    {"cache_size", 28, bits<3>, "0, or the cache's KiB as a power of two", Access::constant},
    {"short_lines", 31, bits<1>, "lines of 32 bytes", Access::constant}};
inline constexpr RegisterField limits_fields[]{
    {"number_bits", 0, bits<6>, "bits of a triangle's number", Access::constant},
    {"leaf_bits", 6, bits<4>, "bits of the number of triangles in a leaf", Access::constant},
    {"step_bits", 10, bits<5>, "bits of the number of records that a ray may test", Access::constant},
    {"stack_bits", 15, bits<3>, "bits of a place on a stack", Access::constant},
    {"box_fraction", 18, bits<3>, "B + 2", Access::constant},
    {"triangle_ii", 21, bits<7>, "cycles from triangle to triangle", Access::constant},
    {"eight_ways", 28, bits<1>, "a cache of 8 ways", Access::constant}};

inline constexpr RegisterField count_fields[]{{"count", 0, counter_bits, ""}};

inline constexpr RegisterField rays_low_fields[]{
    {"rays_low", ring_zeros, low_bits<ring_zeros>, "", Access::read_write}};
inline constexpr RegisterField rays_high_fields[]{{"rays_high", 0, high_bits, "", Access::read_write}};
inline constexpr RegisterField answers_low_fields[]{
    {"answers_low", ring_zeros, low_bits<ring_zeros>, "", Access::read_write}};
inline constexpr RegisterField answers_high_fields[]{{"answers_high", 0, high_bits, "", Access::read_write}};
inline constexpr RegisterField ring_last_fields[]{
    {"ring_last", 0, bits<ring_counts>, "", Access::read_write}};
inline constexpr RegisterField offered_fields[]{
    {"offered", 0, bits<ring_counts>, "", Access::read_write, 0, Feature::always, SoftReset::clears}};
inline constexpr RegisterField interrupt_fields[]{
    {"answers", 0, bits<ring_counts>, "from how many answers on `irq` is 1", Access::read_write},
    {"enable", ring_counts, bits<1>, "whether it may be", Access::read_write}};
inline constexpr RegisterField answered_fields[]{{"answered", 0, bits<ring_counts>, ""}};

}  // namespace detail

/// By their places.
inline constexpr Register table[]{
    {"IDENTITY", 0, "\"Hitp\"", detail::identity_fields},
    {"VERSION", 1, "version", detail::version_fields},
    {"STATUS", 2, "what the core does, and what has gone wrong", detail::status_fields},
    {"CONTROL", 3, "what the core is to do", detail::control_fields},
    {"BASE_LOW", 4, "address of the image, low word: a multiple of 64", detail::base_low_fields,
     Feature::always, 1, Fit::cut},
    {"BASE_HIGH", 5, "address of the image, high word", detail::base_high_fields, Feature::always, 1,
     Fit::cut},
    {"LAST_BLOCK", 6,
     "number of the image's last block: nothing behind it is read. With a cache it is the last of a line",
     detail::last_block_fields},
    {"MOST_STEPS", 7, "records that a ray may test; a ray that wants more fails", detail::most_steps_fields},
    {"MOST_RAYS", 8, "rays in flight. While it is 0, no ray is taken. For fewer, reset the core",
     detail::most_rays_fields},
    {"CLEAR_COUNTERS", 9, "a write makes all counters 0", detail::clear_fields},
    {"FORMAT", 10, "format of rays, boxes and triangles", detail::format_fields},
    {"SHAPE", 11, "what the core has room for", detail::shape_fields},
    {"PORTS", 12, "ports, units and cache", detail::ports_fields},
    {"MOST_LINES", 13, "lines that the cache may read at a time. 0 becomes 1", detail::most_lines_fields,
     Feature::cache, 1, Fit::from_one},
    {"LIMITS", 14, "limits of what it works with", detail::limits_fields},
    {"CYCLES", 16, "cycles", detail::count_fields, Feature::always, 2},
    {"RAYS", 18, "rays that the core has taken", detail::count_fields, Feature::always, 2},
    {"ANSWERS", 20, "answers", detail::count_fields, Feature::always, 2},
    {"HITS", 22, "answers with a hit that have not failed", detail::count_fields, Feature::always, 2},
    {"RECORDS", 24, "records that rays ask memory, or the cache, for", detail::count_fields, Feature::always,
     2},
    {"TRIANGLES", 26, "triangles that rays ask memory, or the cache, for", detail::count_fields,
     Feature::always, 2},
    {"IDLE", 28, "cycles without such a request", detail::count_fields, Feature::always, 2},
    {"REFUSED", 30, "cycles in which memory, or the cache, took none", detail::count_fields, Feature::always,
     2},
    {"CACHE_HITS", 32, "blocks that were in the cache", detail::count_fields, Feature::cache, 2},
    {"CACHE_JOINS", 34, "blocks that were on their way to the cache", detail::count_fields, Feature::cache,
     2},
    {"CACHE_LINES", 36, "lines that the cache has read; with CACHE_JOINS its misses", detail::count_fields,
     Feature::cache, 2},
    {"RAYS_LOW", 38, "address of the ring of rays, low word: a multiple of 128", detail::rays_low_fields,
     Feature::rings, 1, Fit::cut},
    {"RAYS_HIGH", 39, "address of the ring of rays, high word", detail::rays_high_fields, Feature::rings, 1,
     Fit::cut},
    {"ANSWERS_LOW", 40, "address of the ring of answers, low word: a multiple of 128",
     detail::answers_low_fields, Feature::rings, 1, Fit::cut},
    {"ANSWERS_HIGH", 41, "address of the ring of answers, high word", detail::answers_high_fields,
     Feature::rings, 1, Fit::cut},
    {"RING_LAST", 42, "places of each ring less 1: 2^k - 1, from 3 to 32,767", detail::ring_last_fields,
     Feature::rings},
    {"OFFERED", 43, "rays that were offered, of all, in one write", detail::offered_fields, Feature::rings, 1,
     Fit::largest, true},
    {"INTERRUPT", 44, "when there is an interrupt", detail::interrupt_fields, Feature::rings},
    {"ANSWERED", 45, "answers that are in memory, of all", detail::answered_fields, Feature::rings}};

/// For constants: one that wants a name which the table does not have does not compile.
constexpr const Register& called(std::string_view name) {
  const Register* each = std::begin(table);
  while (each->name != name) ++each;
  return *each;
}
constexpr const RegisterField& field_called(std::string_view name, std::string_view field) {
  const RegisterField* each = called(name).fields.data();
  while (each->name != field) ++each;
  return *each;
}
/// Of words.
template <Name Register>
inline constexpr int at = called(Register.text).place;
/// The lowest bit of a field.
template <Name Register, Name Field>
inline constexpr Width<field_called(Register.text, Field.text).low> bit{};
/// Of a register's first field.
template <Name Register>
inline constexpr std::int64_t reset = static_cast<std::int64_t>(called(Register.text).fields.front().reset);

static_assert(bit<"STATUS", "bus_error"> == bit<"STATUS", "failed"> + int{unread_block});
static_assert(bit<"STATUS", "base_error"> == bit<"STATUS", "bus_error"> + 1);
static_assert(channels::ring_flaw_bits == bit<"STATUS", "overfull"> - bit<"STATUS", "ring_error"> + 1);

}  // namespace registers
}  // namespace hitpipe::hls
