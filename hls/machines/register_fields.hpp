// The ports and the state of the machine registers (registers.hpp).
#pragma once

#include "hls/machines/register_table.hpp"

namespace hitpipe::hls {

namespace registers {

using namespace channels;

/// Bits of the status that every core keeps until software clears them.
constexpr int first_sticky = bit<"STATUS", "failed">;
constexpr int sticky_bits = bit<"STATUS", "base_error"> - first_sticky + 1;

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
constexpr Data<"about_limits", 32> about_limits;
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
constexpr DataIf<"ring_flaws", ring_flaw_bits, &RegisterBits::rings> rings_flaws;
// Rings end what is offered even when no ray may begin.
constexpr DataIf<"lets_rings", 1, &RegisterBits::rings> lets_rings_given;

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
constexpr Control<"most_steps_r", step_count_bits, reset<"MOST_STEPS">> most_steps_r;
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
constexpr ControlIf<"most_lines_r", line_count_bits, &RegisterBits::cache, reset<"MOST_LINES">> most_lines_r;
constexpr ControlIf<"empties_r", 1, &RegisterBits::cache> empties_r;
constexpr ControlIf<"count_cache_hits", &RegisterBits::counter, &RegisterBits::cache> count_cache_hits;
constexpr ControlIf<"count_joins", &RegisterBits::counter, &RegisterBits::cache> count_joins;
constexpr ControlIf<"count_lines", &RegisterBits::counter, &RegisterBits::cache> count_lines;
constexpr ControlIf<"rays_at_r", ring_base_bits, &RegisterBits::rings> rays_at_r;
constexpr ControlIf<"answers_at_r", ring_base_bits, &RegisterBits::rings> answers_at_r;
constexpr ControlIf<"ring_last_r", ring_count_bits, &RegisterBits::rings> ring_last_r;
constexpr ControlIf<"offered_r", ring_count_bits, &RegisterBits::rings> offered_r;
constexpr ControlIf<"interrupt_r", ring_count_bits + 1, &RegisterBits::rings> interrupt_r;
constexpr ControlIf<"ring_flaws_r", ring_flaw_bits, &RegisterBits::rings> ring_flaws_r;
constexpr ControlIf<"interrupts_r", 1, &RegisterBits::rings> interrupts_r;

}  // namespace registers

}  // namespace hitpipe::hls
