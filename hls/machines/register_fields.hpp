// What the registers of a core (registers.hpp) are made of: their places and bits, and the machine's fields.
#pragma once

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

using namespace channels;

constexpr std::int64_t identity = 0x48697470;  ///< "Hitp"
constexpr std::int64_t version = 2;
constexpr int word_place_bits = 6;  ///< words up to 0xfc
/// Of words, not of bytes.
enum Place {
  identity_at,
  version_at,
  status_at,
  control_at,
  base_at,
  high_base_at,
  last_at,
  most_steps_at,
  most_rays_at,
  clear_at,
  format_at,
  shape_at,
  ports_at,
  most_lines_at,
  rays_low_at = 38,
  rays_high_at,
  answers_low_at,
  answers_high_at,
  ring_last_at,
  offered_at,
  interrupt_at,
  answered_at
};
/// Bits of the control.
enum ControlBit { soft_reset_bit, empties_bit };
/// Bits of the status. From `failed_bit` on they stay until software clears them.
enum Status {
  idle_bit,                                      ///< no ray is in the core, so the image may change
  resetting_bit,                                 ///< a soft reset is on its way
  failed_bit = 8,                                ///< and a Failure: an answer has failed by it
  bus_bit = failed_bit + int{unread_block} + 1,  ///< a block could not be read
  base_bit,  ///< an address of an image was written that is no multiple of 64
  ring_bit   ///< a ray could not be read, or an answer not written
};
constexpr int first_sticky = failed_bit + int{no_ray}, sticky_bits = base_bit - first_sticky + 1;
constexpr int counters_at = 16;

constexpr Data<"awvalid"> awvalid;
constexpr Data<"awaddr", word_place_bits + 2> awaddr;
constexpr Data<"wvalid"> wvalid;
constexpr Data<"wdata", 32> wdata;
constexpr Data<"wstrb", 4> wstrb;
constexpr Data<"bready"> bready;
constexpr Data<"arvalid"> arvalid;
constexpr Data<"araddr", word_place_bits + 2> araddr;
constexpr Data<"rready"> rready;
constexpr Data<"awready"> awready;
constexpr Data<"wready"> wready;
constexpr Data<"bvalid"> bvalid;
constexpr Data<"bresp", 2> bresp;
constexpr Data<"arready"> arready;
constexpr Data<"rvalid"> rvalid;
constexpr Data<"rdata", 32> rdata;
constexpr Data<"rresp", 2> rresp;
// What the core is.
constexpr Data<"about_format", 32> about_format;
constexpr Data<"about_shape", 32> about_shape;
constexpr Data<"about_ports", 32> about_ports;
// What passes between the core and its surroundings, and the reset of the core.
constexpr Data<"lets_rays"> lets_rays;
constexpr Data<"lets_requests"> lets_requests;
constexpr Data<"lets_answers"> lets_answers;
constexpr Data<"resets"> resets;
// With a cache: what it is told, and what it has done. `line_asked`: memory takes a request.
constexpr DataIf<"most_lines", line_count_bits, &RegisterBits::cache> most_lines_given;
constexpr DataIf<"empties_cache", 1, &RegisterBits::cache> empties_given;
constexpr DataIf<"cache_hit", 1, &RegisterBits::cache> hit_happens;
constexpr DataIf<"cache_join", 1, &RegisterBits::cache> join_happens;
constexpr DataIf<"line_asked", 1, &RegisterBits::cache> line_asked;
// With rings: where they are, what has become of them, and an interrupt.
constexpr DataIf<"rays_at", ring_base_bits, &RegisterBits::rings> rays_place;
constexpr DataIf<"answers_at", ring_base_bits, &RegisterBits::rings> answers_place;
constexpr DataIf<"ring_last", ring_count_bits, &RegisterBits::rings> last_place;
constexpr DataIf<"rays_offered", ring_count_bits, &RegisterBits::rings> offered;
constexpr DataIf<"irq", 1, &RegisterBits::rings> interrupt;
constexpr DataIf<"ring_answers", ring_count_bits, &RegisterBits::rings> answers_there;
constexpr DataIf<"ring_busy", 1, &RegisterBits::rings> rings_busy;
constexpr DataIf<"ring_quiet", 1, &RegisterBits::rings> rings_quiet;
constexpr DataIf<"ring_error", 1, &RegisterBits::rings> rings_error;

// A write: its address and its word come in any order.
constexpr Control<"has_place"> has_place;
constexpr Control<"has_word"> has_word;
constexpr Data<"write_place", word_place_bits> write_place;
constexpr Data<"written_word", 32> written_word;
constexpr Data<"strobes", 4> strobes;
constexpr Control<"written"> written;  // its answer is given
constexpr Control<"has_read"> has_read;
constexpr Control<"gives"> gives;
constexpr Data<"read_place", word_place_bits> read_place;
constexpr Data<"given", 32> given;
constexpr Control<"base_r", base_bits> base_r;
constexpr Control<"last_r", address_bits> last_r;
constexpr Control<"most_steps_r", step_count_bits, low_mask(step_count_bits)> most_steps_r;
constexpr Control<"most_rays_r", ray_count_bits> most_rays_r;
constexpr Control<"sticky_r", sticky_bits> sticky_r;
/// Some rays wait in front of those in flight.
inline constexpr auto flying_bits = [](const RegisterBits& f) { return f.ray + 5; };
constexpr Control<"flying", flying_bits> flying;       // rays in the core
constexpr Control<"reading", ray_count_bits> reading;  // blocks on their way
constexpr Control<"stops"> stops;                      // a soft reset has begun
constexpr Control<"offers_requests", 1, 1> offers_requests;
constexpr Control<"offers_answers", 1, 1> offers_answers;
constexpr Control<"resets_r"> resets_r;
constexpr Control<"count_cycles", &RegisterBits::counter> count_cycles;
constexpr Control<"count_rays", &RegisterBits::counter> count_rays;
constexpr Control<"count_answers", &RegisterBits::counter> count_answers;
constexpr Control<"count_hits", &RegisterBits::counter> count_hits;
constexpr Control<"count_records", &RegisterBits::counter> count_records;
constexpr Control<"count_triangles", &RegisterBits::counter> count_triangles;
constexpr Control<"count_idle", &RegisterBits::counter> count_idle;
constexpr Control<"count_refused", &RegisterBits::counter> count_refused;
constexpr ControlIf<"most_lines_r", line_count_bits, &RegisterBits::cache, 8> most_lines_r;
constexpr ControlIf<"empties_r", 1, &RegisterBits::cache> empties_r;
constexpr ControlIf<"count_cache_hits", &RegisterBits::counter, &RegisterBits::cache> count_cache_hits;
constexpr ControlIf<"count_joins", &RegisterBits::counter, &RegisterBits::cache> count_joins;
constexpr ControlIf<"count_lines", &RegisterBits::counter, &RegisterBits::cache> count_lines;
constexpr ControlIf<"rays_at_r", ring_base_bits, &RegisterBits::rings> rays_at_r;
constexpr ControlIf<"answers_at_r", ring_base_bits, &RegisterBits::rings> answers_at_r;
constexpr ControlIf<"ring_last_r", ring_count_bits, &RegisterBits::rings> ring_last_r;
constexpr ControlIf<"offered_r", ring_count_bits, &RegisterBits::rings> offered_r;
constexpr ControlIf<"interrupt_r", ring_count_bits + 1, &RegisterBits::rings> interrupt_r;
constexpr ControlIf<"ring_failed_r", 1, &RegisterBits::rings> ring_failed_r;
constexpr ControlIf<"interrupts_r", 1, &RegisterBits::rings> interrupts_r;

}  // namespace registers

}  // namespace hitpipe::hls
