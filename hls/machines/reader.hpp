// What rays read: records, and the triangles of leaves, one after the other (docs/core.md). The walker says
// where a ray goes; this machine asks memory for blocks. A ray has one block on its way at a time. When the
// test of a triangle has ended, the ray wants the leaf's next one, or it is done with the leaf.
//   goes     rays whose first block is to be asked for: a record, or the first triangle of a leaf
//   missed   rays whose triangle was not hit
//   divided  rays whose hit has been compared with the best one
// No block outside the image is asked for.
#pragma once

#include "hls/machines/id_queue.hpp"
#include "hls/machines/memory.hpp"
#include "hls/machines/walk_format.hpp"

namespace hitpipe::hls {

/// The format "aAiI", for example a24i5.
struct ReaderBits {
  int address = 24;  ///< A: bits of a block's number
  int ray = 5;       ///< I: bits of a ray's number

  static constexpr FormatField fields[] = {{"a", "A", 4, 32}, {"i", "I", 1, 8}};

  constexpr int rays() const { return power_of_two(ray); }
  /// Of a word in `leaves`: outside, triangles to come, the block of the next.
  constexpr int leaf() const { return 1 + child_count_bits + address; }
  friend constexpr bool operator==(const ReaderBits&, const ReaderBits&) = default;
};

namespace reader {

constexpr Data<"go"> go;  // the walker's `goes`
constexpr Data<"goer", &ReaderBits::ray> goer;
constexpr Data<"block", &ReaderBits::address> block;
constexpr Data<"triangles", child_count_bits> triangles;  // all ones: a record
constexpr Data<"tested"> tested;  // the test of a triangle has ended, with HIT or without
constexpr Data<"hit"> hit;
constexpr Data<"tester", &ReaderBits::ray> tester;
constexpr Data<"divides"> divides;  // a hit has been compared
constexpr Data<"divided_ray", &ReaderBits::ray> divided_ray;
constexpr Data<"stops"> stops;      // and the ray wants nothing else
constexpr Data<"granted"> granted;  // memory takes what `asks` asks for
constexpr Data<"last", &ReaderBits::address>
    last;  // the last block of the image; constant while rays are in flight

constexpr Data<"asks"> asks;  // for a block
constexpr Data<"wanted", &ReaderBits::address> wanted;
constexpr Data<"asker", &ReaderBits::ray> asker;
constexpr Data<"triangle"> triangle;  // it is one; else a record
constexpr Data<"done"> done;          // a ray is done with its leaf
constexpr Data<"of", &ReaderBits::ray> of;
constexpr Data<"stopped"> stopped;  // and wants nothing else
constexpr Data<"lost"> lost;        // because a block that it wants is not in the image

using Goes = IdQueue<"goes_">;
using Missed = IdQueue<"missed_">;
using Divided = IdQueue<"divided_">;
constexpr Control<"there_1"> there_1;  // a ray whose triangle has been tested
constexpr Data<"stops_1"> stops_1;
constexpr Data<"settled_1"> settled_1;  // no word was to be written when the leaf's was asked for
constexpr Data<"ray_1", &ReaderBits::ray> ray_1;
constexpr Control<"writes"> writes;  // what the leaf's word becomes, to be written
constexpr Data<"writer", &ReaderBits::ray> writer;
constexpr Data<"leaf", &ReaderBits::leaf> leaf;

constexpr Data<"outside"> outside;          // the block is not in the image
constexpr Data<"go_triangle"> go_triangle;  // it is a triangle
struct Go : List<goer, outside, go_triangle, block> {};
struct Compared : List<divided_ray, stops> {};
struct Leaf : List<outside, triangles, block> {};
constexpr BlockOf<"go_words", &ReaderBits::rays, Go> go_words;  // the queues
constexpr Block<"missed_rays", &ReaderBits::rays, &ReaderBits::ray> missed_rays;
constexpr BlockOf<"divided_rays", &ReaderBits::rays, Compared> divided_rays;
constexpr BlockOf<"leaves", &ReaderBits::rays, Leaf> leaves;  // by ray

struct Reader {
  static constexpr const char* name = "reader";
  static constexpr const char* summary = "asks memory for records, and for a leaf's triangles in turn";
  static constexpr const char* header = __FILE__;
  using Bits = ReaderBits;
  using BuiltIn = FormatList<Fixed<ReaderBits{24, 5}>, Fixed<ReaderBits{24, 7}>>;
  struct In
      : List<go, goer, block, triangles, tested, hit, tester, divides, divided_ray, stops, granted, last> {};
  struct Out : List<asks, wanted, asker, triangle, done, of, stopped, lost> {};
  struct State : Join<Goes::State, Missed::State, Divided::State,
                      List<there_1, stops_1, settled_1, ray_1, writes, writer, leaf>> {};
  struct Memory : List<go_words, missed_rays, divided_rays, leaves> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& memory, const auto& out) {
    const auto wants = wanted_by<D>(now, memory);
    out[asks] = wants.next | wants.go;
    out[wanted] = select(wants.next, wants.leaf[block], wants.first[block]);
    out[asker] = select(wants.next, now[ray_1], wants.first[goer]);
    out[triangle] = wants.next | wants.first[go_triangle];
    const auto is_lost = wants.next_lost | wants.go_lost;
    out[done] = wants.done | is_lost;
    out[of] = select(wants.go_lost, wants.first[goer], now[ray_1]);
    out[stopped] = now[stops_1] | is_lost;
    out[lost] = is_lost;
  }

  template <class D>
  static constexpr void step(const auto& /*f*/, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const auto one = D::lit(1, 1_w);
    const auto wants = wanted_by<D>(now, memory);

    // Into the queues. A block is outside where its number is larger than the last one's.
    const Bit record = as("record", is<D>(in[triangles], (1 << child_count_bits) - 1));
    memory[go_words].write(in[go], as("go_place", Goes::place(now)), in[goer], Bit(in[last] < in[block]),
                           Bit(~record), in[block]);
    const Bit misses = as("misses", in[tested] & ~in[hit]);
    memory[missed_rays].write(misses, as("missed_place", Missed::place(now)), in[tester]);
    memory[divided_rays].write(in[divides], as("divided_place", Divided::place(now)), in[divided_ray],
                               in[stops]);

    // The word of a leaf is written where the ray goes to it, and behind each of its triangles. The first has
    // precedence, the other waits. A ray whose block is outside is lost, whatever its leaf's word says.
    const Bit begins = as("begins_leaf", in[go] & ~record);
    const auto word_behind = [&](const auto& place, const auto& count) {
      return cat(Bit(place == in[last]), minus(count, one), plus(place, one));
    };
    memory[leaves].write(Bit(begins | now[writes]), select(begins, in[goer], now[writer]),
                         select(begins, word_behind(in[block], in[triangles]), now[leaf]));

    const Bit next_granted = as("next_granted", wants.next & in[granted]);
    const Bit go_granted = as("go_granted", wants.go & in[granted]);
    const Bit leaves_stage = as("leaves_stage", next_granted | wants.done | wants.next_lost);
    const Bit holds = as("holds", now[there_1] & ~leaves_stage);
    // The stage takes a ray when it is empty: few triangles are tested, and a shorter path is worth more.
    const Bit divided_there = now[Divided::there];
    const Bit divided = as("takes_divided", divided_there & ~now[there_1]);
    const Bit missed = as("takes_missed", now[Missed::there] & ~divided_there & ~now[there_1]);
    const auto compared = memory[divided_rays].word();
    const auto taken = as("taken", select(divided_there, compared[divided_ray], memory[missed_rays].word()));
    const auto ray = as("asked_leaf", select(now[there_1], now[ray_1], taken));
    memory[leaves].ask(ray);
    memory[go_words].ask(Goes::step<D>(now, next, in[go], Bit(go_granted | wants.go_lost)));
    memory[missed_rays].ask(Missed::step<D>(now, next, misses, missed));
    memory[divided_rays].ask(Divided::step<D>(now, next, in[divides], divided));
    next[stops_1] = select(now[there_1], now[stops_1], Bit(divided & Bit(compared[stops])));
    next[there_1] = holds | divided | missed;
    next[settled_1] = ~now[writes];
    next.where(next_granted)[writer] = now[ray_1];
    next.where(next_granted)[leaf] = word_behind(wants.leaf[block], wants.leaf[triangles]);
    next[writes] = next_granted | (now[writes] & begins);
    next[ray_1] = ray;
  }

 private:
  /// What the first of the rays want.
  template <class D>
  static constexpr auto wanted_by(const auto& now, const auto& memory) {
    using Bit = typename D::bit;
    struct Wants {
      Bit next, done, next_lost;  // the ray of stage 1: its leaf's next triangle, which may not be there
      decltype(memory[leaves].word()) leaf;
      Bit go, go_lost;  // the first of the queue `goes`
      decltype(memory[go_words].word()) first;
    };
    // Stage 1: the word of a leaf is there, unless one is to be written first.
    const auto its_leaf = memory[leaves].word();
    const Bit leaf_outside = its_leaf[outside];
    const Bit knows = as("knows", now[there_1] & now[settled_1] & ~now[writes]);
    const Bit is_done = as("leaf_done", knows & (now[stops_1] | ~any<D>(its_leaf[triangles])));
    const Bit wants_next = as("wants_next", knows & ~is_done & ~leaf_outside);
    const Bit next_lost = as("next_lost", knows & ~is_done & leaf_outside);

    const auto first = memory[go_words].word();
    const Bit first_outside = first[outside];
    const Bit wants_go = as("wants_go", now[Goes::there] & ~first_outside & ~wants_next);
    const Bit go_lost = as("go_lost", now[Goes::there] & first_outside & ~knows);
    return Wants{wants_next, is_done, next_lost, its_leaf, wants_go, go_lost, first};
  }
};

}  // namespace reader

using reader::Reader;

}  // namespace hitpipe::hls
