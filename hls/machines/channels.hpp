// The channels of a core (docs/core.md): what its machines give to each other and to the outside. A channel is
// said once. The machine that gives and those that take have ports with these names. In a channel the first
// field is 1 if the others mean something. `Back` is what the taker gives, for example that it takes.
#pragma once

#include <tuple>

#include "hls/machines/block_kind.hpp"
#include "hls/machines/failure.hpp"
#include "hls/machines/id_queue.hpp"
#include "hls/machines/record.hpp"
#include "hls/machines/walk_format.hpp"
#include "hls/world/core_format.hpp"

namespace hitpipe::hls::channels {

/// Bits of an origin, of a distance, of a box distance, of a block's number.
inline constexpr auto point_bits = [](const auto& format) { return format.point(); };
inline constexpr auto distance_bits = [](const auto& format) {
  if constexpr (requires { format.distance(); })
    return format.distance();
  else
    return format.distance;
};
/// Of the T of an answer. A sum of sides may need more bits.
inline constexpr auto answer_bits = [](const auto& format) {
  if constexpr (requires { format.answer_width(); })
    return format.answer_width();
  else
    return format.distance;
};
inline constexpr auto box_bits = [](const auto& format) {
  if constexpr (requires { format.box(); })
    return format.box();
  else
    return format.box;
};
inline constexpr auto address_bits = [](const auto& format) { return format.address; };
// A core that is fitted to scenes may have fewer bits than an image for these.
/// Of the number of triangles in a leaf; all ones is a record.
inline constexpr auto leaf_bits = [](const auto& format) { return format.leaf; };
/// Of a triangle's number; all ones is no triangle.
inline constexpr auto number_bits = [](const auto& format) { return format.number; };
/// Of the number of records that a walk may test.
inline constexpr auto step_bits = [](const auto& format) { return format.steps; };

/// The core answers the questions count and next too (docs/integer_world.md, Exactly once).
inline constexpr auto has_questions = [](const auto& format) {
  if constexpr (requires { format.crossings; })
    return format.crossings == 3;
  else
    return format.questions != 0;
};

// A new ray, as the unit int_ray makes it (hls/world/ray_operands.hpp).
constexpr Data<"ray_valid"> ray_valid;  // this and `ray_ready` are 1: the ray begins
constexpr Data<"ray_ready"> ray_ready;
inline constexpr auto tag_bits = [](const auto& format) { return format.tag; };
constexpr Data<"ray_tag", tag_bits> ray_tag;
constexpr Data<"ray_any"> ray_any;  // it wants any hit, else the nearest
// With `ray_any`: 0 and 0 the nearest hit, 0 and 1 any hit, 1 and 0 the next crossing, 1 and 1 their count.
constexpr DataIf<"ray_once", 1, has_questions> ray_once;
// The next crossing is the first that is not before this T and number.
constexpr DataIf<"ray_from_t", distance_bits, has_questions> ray_from_t;
constexpr DataIf<"ray_from_number", triangle_number_bits, has_questions> ray_from_number;
constexpr Data<"ray_error"> ray_error;  // it is no ray
constexpr Data<"ray_major_y"> ray_major_y;
constexpr Data<"ray_major_z"> ray_major_z;
constexpr Data<"ray_back_m"> ray_back_m;
constexpr Data<"ray_back_a"> ray_back_a;
constexpr Data<"ray_back_b"> ray_back_b;
constexpr SignedData<"ray_origin_m", point_bits> ray_origin_m;
constexpr SignedData<"ray_origin_a", point_bits> ray_origin_a;
constexpr SignedData<"ray_origin_b", point_bits> ray_origin_b;
inline constexpr auto slope_bits = [](const auto& format) { return format.slope + 1; };
constexpr Data<"ray_s_a", slope_bits> ray_s_a;
constexpr Data<"ray_s_b", slope_bits> ray_s_b;
inline constexpr auto mantissa_bits = [](const auto& format) { return format.mantissa; };
inline constexpr auto exponent_bits = [](const auto& format) { return format.exponent(); };
constexpr Data<"ray_floor_a", mantissa_bits> ray_floor_a;
constexpr Data<"ray_ceil_a", mantissa_bits> ray_ceil_a;
constexpr Data<"ray_exp_a", exponent_bits> ray_exp_a;
constexpr Data<"ray_floor_b", mantissa_bits> ray_floor_b;
constexpr Data<"ray_ceil_b", mantissa_bits> ray_ceil_b;
constexpr Data<"ray_exp_b", exponent_bits> ray_exp_b;
constexpr Data<"ray_length", distance_bits> ray_length;
constexpr Data<"begun_at", ray_bits> begun_at;  // the number that the next ray has
/// The door says so to those that keep something of each ray.
struct NewNumber : List<ray_ready, begun_at> {};
struct Begun : Join<List<ray_valid>, NewNumber> {};
/// What both tests want to know of it.
struct Direction : List<ray_major_y, ray_major_z, ray_back_m, ray_back_a, ray_back_b, ray_origin_m,
                        ray_origin_a, ray_origin_b> {};
struct Reciprocals : List<ray_floor_a, ray_ceil_a, ray_exp_a, ray_floor_b, ray_ceil_b, ray_exp_b> {};

// From the door to best_hits.
constexpr Data<"new_ray"> new_ray;
constexpr Data<"begun", ray_bits> begun;
constexpr Data<"length", distance_bits> length;
constexpr Data<"any"> any_hit;
constexpr DataIf<"counts", 1, has_questions> counts;  // it wants the number of its crossings
constexpr DataIf<"turned", 1, has_questions> turned;  // det of a test has the sign of a crossing's side
// A hit of the next crossing is not before this place. The T of one that is counted is not above it.
constexpr DataIf<"from_t", distance_bits, has_questions> from_t;
constexpr DataIf<"from_number", number_bits, has_questions> from_number;
constexpr Data<"takes"> takes;
struct NewRay : List<new_ray, begun, length, any_hit, counts, turned, from_t, from_number> {
  using Back = List<takes>;
};

// From best_hits to the walker: the new ray's walk starts at the root's own record.
constexpr Data<"starts"> starts;
constexpr Data<"start_ray", ray_bits> start_ray;
constexpr Data<"start_cut", box_bits> start_cut;  // its length as a box distance
constexpr Data<"walker_takes"> walker_takes;
struct Starts : List<starts, start_ray, start_cut> {
  using Back = List<walker_takes>;
};

// From the walker to reader and pair_feed: a ray wants a record, or the triangles of a leaf.
constexpr Data<"goes"> goes;
constexpr Data<"walk_ray", ray_bits> walk_ray;
constexpr Data<"wanted", address_bits> wanted;     // the block
constexpr Data<"triangles", leaf_bits> triangles;  // all ones: it is a record
struct Goes : List<goes, walk_ray, wanted, triangles> {};
constexpr Data<"enters_at", box_bits> enters_at;  // where the ray is within it
constexpr Data<"leaves_at", box_bits> leaves_at;
struct WalkInterval : List<enters_at, leaves_at> {};

// From the walker to best_hits: a ray's walk has ended.
constexpr Data<"ended"> ended;
constexpr Data<"failed", failure_bits> failed;  // a Failure
struct Ended : List<ended, walk_ray, failed> {};

// From the reader to requests: a block is wanted.
constexpr Data<"asks"> asks;
constexpr Data<"asked_block", address_bits> asked_block;
constexpr Data<"asker", ray_bits> asker;
constexpr Data<"triangle"> triangle;  // it is one; else a record
constexpr Data<"granted"> granted;
constexpr Data<"asks_triangle"> asks_triangle;  // `triangle` as a port of the core
struct Asks : List<asks, asked_block, asker, triangle> {
  using Back = List<granted>;
};

// To memory. Above the ray's number an identifier has a bit that is 1 for a triangle.
inline constexpr auto byte_bits = [](const auto& format) {
  if constexpr (requires { format.bytes(); })
    return format.bytes();
  else
    return format.bytes;
};
/// Of a block's place in memory.
inline constexpr auto block_place_bits = [](const auto& format) { return format.bytes - 5; };
constexpr Data<"request_valid"> request_valid;
constexpr Data<"request_address", byte_bits> request_address;  // a multiple of 32
constexpr Data<"request_id", ray_count_bits> request_id;
constexpr Data<"request_ready"> request_ready;
struct Request : List<request_valid, request_address, request_id> {
  using Back = List<request_ready>;
};

// A block that memory gives, which is taken at once: 32 bytes as four words, the first bytes in the low bits
// of word 0.
constexpr Data<"read_valid"> read_valid;
constexpr Data<"read_id", ray_count_bits> read_id;
constexpr Data<"read_word_0", 64> read_word_0;
constexpr Data<"read_word_1", 64> read_word_1;
constexpr Data<"read_word_2", 64> read_word_2;
constexpr Data<"read_word_3", 64> read_word_3;
constexpr Data<"read_error"> read_error;  // it could not be read, and the words mean nothing
struct BlockWords : List<read_word_0, read_word_1, read_word_2, read_word_3, read_error> {};
struct BlockRead : Join<List<read_valid, read_id>, BlockWords> {};

// A beat of a memory bus, of 64 to 512 bits. It is taken if both `beat_valid` and `beat_ready` are 1.
template <int Word>
inline constexpr auto beat_has = [](const auto& format) { return Word < format.data / 64; };
constexpr Data<"beat_valid"> beat_valid;
constexpr Data<"beat_ready"> beat_ready;
constexpr Data<"beat_error"> beat_error;  // it could not be read, and the words mean nothing
constexpr Data<"beat_0", 64> beat_0;
constexpr DataIf<"beat_1", 64, beat_has<1>> beat_1;
constexpr DataIf<"beat_2", 64, beat_has<2>> beat_2;
constexpr DataIf<"beat_3", 64, beat_has<3>> beat_3;
constexpr DataIf<"beat_4", 64, beat_has<4>> beat_4;
constexpr DataIf<"beat_5", 64, beat_has<5>> beat_5;
constexpr DataIf<"beat_6", 64, beat_has<6>> beat_6;
constexpr DataIf<"beat_7", 64, beat_has<7>> beat_7;
struct Beat : List<beat_valid, beat_error, beat_0, beat_1, beat_2, beat_3, beat_4, beat_5, beat_6, beat_7> {
  using Back = List<beat_ready>;
};

/// Who gets the block.
constexpr auto reader_of(const auto& in) {
  return slice(in[read_id], width_of(in[read_id]) - 2_w, 0_w);
}
constexpr auto reads_triangle(const auto& in) {
  return sign(in[read_id]);
}
/// Bits At .. At + Bits - 1 of the block.
template <int At, int Bits>
constexpr auto piece(const auto& in) {
  constexpr auto word = []<int I>(Width<I>) {
    return std::get<I>(std::tuple(read_word_0, read_word_1, read_word_2, read_word_3));
  };
  constexpr int first = At / 64, last = (At + Bits - 1) / 64, low = At % 64;
  const auto& lower = in[word(Width<first>())];
  if constexpr (first == last)
    return slice(lower, Width<low + Bits - 1>(), Width<low>());
  else
    return cat(slice(in[word(Width<last>())], Width<(At + Bits - 1) % 64>(), 0_w),
               slice(lower, 63_w, Width<low>()));
}
/// The block could not be read, or is not of this kind and grid.
template <class D>
constexpr typename D::bit is_unread(const auto& in, BlockKind kind, int coord_bits) {
  return in[read_error] | ~is<D>(piece<248, 8>(in), kind_byte(kind, coord_bits));
}
/// The coordinate with that number, in `width` bits.
template <int I>
constexpr auto coordinate(const auto& in, const auto& width) {
  return resize(as_signed(piece<24 * I, 24>(in)), width);
}

// From a feed: the test of a ray begins. Its unit and, of a record, the walker are told.
constexpr Data<"begins"> begins;
constexpr Data<"test_ray", ray_bits> test_ray;
constexpr Data<"unit_takes"> unit_takes;
struct Begins : List<begins, test_ray> {
  using Back = List<unit_takes>;
};
constexpr Data<"block", address_bits> block;  // of child 0; child 1 follows
constexpr Data<"count_0", leaf_bits> count_0;
constexpr Data<"count_1", leaf_bits> count_1;
constexpr Data<"flaw", lost_bits> flaw;  // a Lost: the ray is lost by this record
struct Children : List<block, count_0, count_1, flaw> {};

// Which test of a triangle it is. A tie of a ray with crossings is settled by tests of the same triangle with the
// origin moved, and then tested again as the ray is.
enum Test : std::uint8_t { first_test, moved_along_a, moved_along_b, last_test };
constexpr int test_bits = 2;
constexpr DataIf<"test_is", test_bits, has_questions> test_is;
constexpr DataIf<"test_once", 1, has_questions> test_once;  // the ray wants crossings
constexpr DataIf<"test_down", 1, has_questions> test_down;  // the origin was moved down
struct Testing : List<test_is, test_once, test_down> {};

// From a unit, or a machine in its place: the test of a ray has ended, with HIT or without.
constexpr Data<"tested"> tested;
constexpr Data<"tester", ray_bits> tester;
constexpr Data<"hit"> hit;
struct Tested : List<tested, hit, tester> {};
constexpr DataIf<"again", 1, has_questions> again;  // its triangle is to be tested again, and this was no hit

// From ties to the reader and the divider: the same, once ties are settled.
constexpr Data<"settled"> settled;
constexpr Data<"settled_hit"> settled_hit;
constexpr Data<"settler", ray_bits> settler;
constexpr Data<"settled_again"> settled_again;
struct Settled : List<settled, settled_hit, settler, settled_again> {};
// And to triangle_feed: the ray's next test is this one.
constexpr DataIf<"retests", 1, has_questions> retests;
constexpr DataIf<"retest_ray", ray_bits, has_questions> retest_ray;
constexpr DataIf<"retest_is", test_bits, has_questions> retest_is;
struct Retests : List<retests, retest_ray, retest_is> {};

/// A number with a sign has two ports: the high half has the sign, and the low half may have a bit less.
template <auto Bits>
struct LowHalf {
  constexpr int operator()(const auto& format) const { return number_in<Bits>(format) / 2; }
};
template <auto Bits>
struct HighHalf {
  constexpr int operator()(const auto& format) const { return (number_in<Bits>(format) + 1) / 2; }
};
template <Name N, auto Bits>
struct Halves {
  static constexpr SignedData<N + Name("_high"), HighHalf<Bits>{}> high{};
  static constexpr Data<N + Name("_low"), LowHalf<Bits>{}> low{};
  using Items = List<high, low>;
};

// From triangle_feed to best_hits and to the reader: a triangle has been read for a ray.
constexpr Data<"reads"> reads;
constexpr Data<"read_ray", ray_bits> read_ray;
constexpr Data<"number", number_bits> number;
constexpr Data<"unread"> unread;  // it was none, so its test means nothing
struct TriangleRead : List<reads, read_ray, number> {};
struct TriangleFlaw : List<reads, read_ray, unread> {};

// From the divider to best_hits: what a hit is. Back comes what the ray `asked` has, in the next cycle: the
// number of the triangle that it was tested with, T of its best hit, which is its length before the first one,
// and that hit's number, which is all ones before the first one.
constexpr Data<"asked", ray_bits> asked;
constexpr Data<"done"> done;  // 1: `asked`, `t` and `closer` are an answer
constexpr Data<"t", distance_bits> t;
constexpr Data<"closer"> closer;  // (T, number) is less than (best, best_number)
constexpr Data<"asked_number", number_bits> asked_number;
constexpr Data<"best", distance_bits> best;
constexpr Data<"best_number", number_bits> best_number;
struct Divides : List<asked, done, t, closer> {
  using Back = List<asked_number, best, best_number>;
};

// And for questions, det of the hit is negative; back come what the ray wants.
constexpr DataIf<"hit_back", 1, has_questions> hit_back;
constexpr DataIf<"asked_counts", 1, has_questions> asked_counts;
constexpr DataIf<"asked_from_t", distance_bits, has_questions> asked_from_t;
constexpr DataIf<"asked_from_number", number_bits, has_questions> asked_from_number;
struct Compares : List<hit_back> {
  using Back = List<asked_counts, asked_from_t, asked_from_number>;
};

// From best_hits to the reader: a hit has been compared.
constexpr Data<"divided"> divided;
constexpr Data<"divided_ray", ray_bits> divided_ray;
constexpr Data<"divided_stops"> divided_stops;  // the ray wants nothing else
struct Divided : List<divided, divided_ray, divided_stops> {};

// From the reader to best_hits: a ray is done with its leaf.
constexpr Data<"leaf_done"> leaf_done;
constexpr Data<"leaf_ray", ray_bits> leaf_ray;
constexpr Data<"leaf_stops"> leaf_stops;           // it wants nothing else
constexpr Data<"leaf_lost", lost_bits> leaf_lost;  // a Lost, because of a block that it wants
struct LeafDone : List<leaf_done, leaf_ray, leaf_stops, leaf_lost> {};

// From best_hits to the walker: the same a cycle later, with the ray's length now as a box distance.
constexpr Data<"returns"> returns;
constexpr Data<"return_ray", ray_bits> return_ray;
constexpr Data<"return_cut", box_bits> return_cut;
constexpr Data<"return_stops"> return_stops;
constexpr Data<"return_lost", lost_bits> return_lost;
struct Returns : List<returns, return_ray, return_cut, return_stops, return_lost> {};

// From best_hits to replies: a ray's answer.
constexpr Data<"answers"> answers;
constexpr Data<"answered", ray_bits> answered;
constexpr Data<"answer_t", answer_bits> answer_t;            // of a count the sum of sides
constexpr Data<"answer_number", number_bits> answer_number;  // all ones: no hit
constexpr Data<"answer_failed", failure_bits> answer_failed;
struct Answers : List<answers, answered, answer_t, answer_number, answer_failed> {};

/// An answer that leaves, with the tag of its ray. With weights it passes through two machines.
template <Name Prefix>
struct HitsOf {
  static constexpr Data<Prefix + Name("valid")> valid{};
  static constexpr Data<Prefix + Name("tag"), tag_bits> tag{};
  static constexpr Data<Prefix + Name("t"), answer_bits> t{};
  static constexpr Data<Prefix + Name("number"), triangle_number_bits> number{};  // all ones: no hit
  static constexpr Data<Prefix + Name("failed"), failure_bits> failed{};          // a Failure
  static constexpr Data<Prefix + Name("ready")> ready{};
  using Items = List<valid, tag, t, number, failed>;
  using Back = List<ready>;
};
using Hits = HitsOf<"hit_">;
/// It has left, and its ray's number is free.
template <Name Prefix>
struct FreedOf {
  static constexpr Data<Prefix + Name("freed")> is{};
  static constexpr Data<Prefix + Name("freed_ray"), ray_bits> ray{};
  using Items = List<is, ray>;
};
using Freed = FreedOf<"">;
using HitsToWeights = HitsOf<"reply_">;
using FreedToWeights = FreedOf<"reply_">;

// What the host says. None may change while rays are in flight but `most_rays`, which may grow.
inline constexpr auto base_bits = [](const auto& format) { return format.bytes - 6; };
constexpr Data<"base", base_bits> base;                    // the image's address, divided by 64
constexpr Data<"last", address_bits> last;                 // the image's last block
constexpr Data<"most_steps", step_count_bits> most_steps;  // records that a walk may test
constexpr Data<"most_rays", ray_count_bits> most_rays;     // in flight, 1 or more
struct Settings : List<base, last, most_steps, most_rays> {};
// And to a core with a cache. These may change at any time.
constexpr int line_count_bits = 6;
constexpr Data<"most_lines", line_count_bits> most_lines;  // on their way, 1 or more
constexpr Data<"empties_cache"> empties_cache;             // 1 in a cycle: what it holds is forgotten
constexpr Data<"lets_asks"> lets_asks;                     // 0: rays do not ask for blocks any more
struct CacheSettings : List<most_lines, empties_cache, lets_asks> {};

// And to a core that reads its rays from memory.
constexpr int ring_count_bits = 16;
inline constexpr auto ring_base_bits = [](const auto& format) { return format.bytes - 7; };
constexpr Data<"rays_at", ring_base_bits> rays_at;        // the address of the ring of rays, divided by 128
constexpr Data<"answers_at", ring_base_bits> answers_at;  // that of the ring of answers
constexpr Data<"ring_last", ring_count_bits>
    ring_last;  // places of each ring, less 1; they are 2^k, 4 or more
constexpr Data<"rays_offered", ring_count_bits> rays_offered;  // in all
constexpr Data<"lets_fetches"> lets_fetches;                   // 0: no ray is read any more
constexpr Data<"lets_rings"> lets_rings;                       // 0: and no answer is written
struct RingSettings : List<rays_at, answers_at, ring_last, rays_offered, lets_fetches, lets_rings> {};
// What it says of them.
constexpr Data<"ray_begins"> ray_begins;                       // a ray has begun in the cycle before
constexpr Data<"ring_answers", ring_count_bits> ring_answers;  // that are in memory, in all
constexpr Data<"ring_busy"> ring_busy;    // rays have not begun, or answers are not in memory
constexpr Data<"ring_quiet"> ring_quiet;  // nothing is being read or written
/// Above each other: a read has had an error in the cycle before; a write has had one; too many rays were offered.
constexpr int ring_flaw_bits = 3;
constexpr Data<"ring_flaws", ring_flaw_bits> ring_flaws;
struct RingState : List<ray_begins, ring_answers, ring_busy, ring_quiet, ring_flaws> {};

// What a cache has done in the cycle before.
constexpr Data<"cache_hit"> cache_hit;    // a ray has come to a line that was there
constexpr Data<"cache_join"> cache_join;  // a ray has come to a line that is on its way
struct CacheEvents : List<cache_hit, cache_join> {};

}  // namespace hitpipe::hls::channels
