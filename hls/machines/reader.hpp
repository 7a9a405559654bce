// What rays read: records, and the triangles of leaves, one after the other (docs/core.md). The walker says
// where a ray goes; this machine asks memory for blocks. A ray has one block on its way at a time. When the
// test of a triangle has ended, the ray wants the leaf's next one, or it is done with the leaf.
//   goes     rays whose first block is to be asked for: a record, or the first triangle of a leaf
//   missed   rays whose triangle was not hit
//   divided  rays whose hit has been compared with the best one
// No block outside the image is asked for. The test of what is no triangle means nothing, so its ray is lost.
#pragma once

#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"
#include "hls/num/levels.hpp"

namespace hitpipe::hls {

/// The format "aAiI", for example a24i5, or "aAiIqQeE".
struct ReaderBits {
  int address = 24;   ///< A: bits of a block's number
  int ray = 5;        ///< I: bits of a ray's number
  int questions = 0;  ///< Q: rays may test a triangle again
  int leaf =
      child_count_bits;  ///< E: bits of the number of triangles in a leaf; not written: those of an image

  static constexpr FormatField fields[] = {{"a", "A", 4, 32},
                                           {"i", "I", 1, 8},
                                           {"q", "Q", 1, 1, nullptr, true},
                                           {"e", "E", 2, child_count_bits, nullptr, true}};

  constexpr int rays() const { return power_of_two(ray); }
  /// Of a word in `leaves`: outside, triangles to come, the block of the next.
  constexpr int leaf_word() const { return 1 + leaf + address; }
  friend constexpr bool operator==(const ReaderBits&, const ReaderBits&) = default;
};

namespace reader {

using namespace channels;

using GoQueue = IdQueue<"goes_">;
using MissQueue = IdQueue<"missed_">;
using DivideQueue = IdQueue<"divided_">;
constexpr Control<"there_1"> there_1;  // a ray whose triangle has been tested
constexpr Data<"stops_1"> stops_1;
constexpr Data<"settled_1"> settled_1;  // no word was to be written when the leaf's was asked for
constexpr Data<"ray_1", ray_bits> ray_1;
constexpr DataIf<"again_1", 1, has_questions> again_1;  // it wants the same triangle again
constexpr Control<"writes"> writes;                     // what the leaf's word becomes, to be written
constexpr Data<"writer", ray_bits> writer;
constexpr Data<"leaf", &ReaderBits::leaf_word> leaf;

constexpr Data<"outside"> outside;          // the block is not in the image
constexpr Data<"go_triangle"> go_triangle;  // it is a triangle
struct Go : List<walk_ray, outside, go_triangle, block> {};
struct Compared : List<divided_ray, divided_stops> {};
struct Leaf : List<outside, triangles, block> {};
constexpr BlockOf<"go_words", &ReaderBits::rays, Go> go_words;  // the queues
constexpr Block<"missed_rays", &ReaderBits::rays, ray_bits> missed_rays;
constexpr BlockOf<"divided_rays", &ReaderBits::rays, Compared> divided_rays;
constexpr BlockOf<"leaves", &ReaderBits::rays, Leaf> leaves;  // by ray
constexpr Block<"flaws", &ReaderBits::rays, 1> flaws;         // by ray: its last triangle was none
constexpr BlockIf<"missed_again", &ReaderBits::rays, 1, has_questions> missed_again;  // beside missed_rays

struct Reader {
  static constexpr const char* name = "reader";
  static constexpr const char* summary = "asks memory for records, and for a leaf's triangles in turn";
  using Bits = ReaderBits;
  using BuiltIn = FormatList<Fixed<ReaderBits{24, 5}>, Fixed<ReaderBits{24, 7}>>;
  struct In : Join<Goes, TriangleFlaw, Tested, Divided, Asks::Back, List<last, again>> {};
  struct Out : Join<Asks, LeafDone> {};
  struct State : Join<GoQueue::State, MissQueue::State, DivideQueue::State,
                      List<there_1, stops_1, settled_1, ray_1, writes, writer, leaf, again_1>> {};
  struct Memory : List<go_words, missed_rays, divided_rays, leaves, flaws, missed_again> {};

  template <class D>
  static constexpr void outputs(const auto& f, const auto& now, const auto& memory, const auto& out) {
    using Bit = typename D::bit;
    const auto wants = wanted_by<D>(f, now, memory);
    out[asks] = wants.next | wants.go;
    // The leaf's word has the block behind the triangle that was tested.
    const auto next_block =
        change_if(has_questions(ReaderBits(f)), wants.leaf[block],
                  [&](const auto& behind) { return as("next_block", minus(behind, now[again_1])); });
    out[asked_block] = select(wants.next, next_block, wants.first[block]);
    out[asker] = select(wants.next, now[ray_1], wants.first[walk_ray]);
    out[triangle] = wants.next | wants.first[go_triangle];
    const Bit is_lost = wants.next_lost | wants.go_lost;
    out[leaf_done] = wants.done | is_lost;
    out[leaf_ray] = select(wants.go_lost, wants.first[walk_ray], now[ray_1]);
    out[leaf_stops] = now[stops_1] | is_lost;
    out[leaf_lost] = cat(is_lost, Bit(wants.next_lost & wants.unread));
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const auto one = D::lit(1, 1_w);
    const auto wants = wanted_by<D>(f, now, memory);
    const bool has_again = has_questions(ReaderBits(f));

    // Into the queues. A block is outside where its number is larger than the last one's.
    const Bit record = as("record", is<D>(in[triangles], power_of_two(leaf_bits(ReaderBits(f))) - 1));
    memory[go_words].write(in[goes], as("go_place", GoQueue::place(now)), in[walk_ray],
                           Bit(in[last] < in[wanted]), Bit(~record), in[wanted]);
    const Bit misses = as("misses", in[tested] & ~in[hit]);
    const auto missed_place = as("missed_place", MissQueue::place(now));
    memory[missed_rays].write(misses, missed_place, in[tester]);
    if (has_again) memory[missed_again].write(misses, missed_place, in[again]);
    memory[divided_rays].write(in[divided], as("divided_place", DivideQueue::place(now)), in[divided_ray],
                               in[divided_stops]);

    // The word of a leaf is written where the ray goes to it, and behind each of its triangles. The first has
    // precedence, the other waits. A ray whose block is outside is lost, whatever its leaf's word says.
    const Bit begins = as("begins_leaf", in[goes] & ~record);
    const auto word_behind = [&](const auto& place, const auto& count) {
      return cat(Bit(place == in[last]), minus(count, one), plus(place, one));
    };
    memory[leaves].write(Bit(begins | now[writes]), select(begins, in[walk_ray], now[writer]),
                         select(begins, word_behind(in[wanted], in[triangles]), now[leaf]));

    const Bit next_granted = as("next_granted", wants.next & in[granted]);
    const Bit go_granted = as("go_granted", wants.go & in[granted]);
    const Bit leaves_stage = as("leaves_stage", next_granted | wants.done | wants.next_lost);
    const Bit holds = as("holds", now[there_1] & ~leaves_stage);
    // The stage takes a ray when it is empty: few triangles are tested, and a shorter path is worth more.
    const Bit divided_there = now[DivideQueue::there];
    const Bit takes_divided = as("takes_divided", divided_there & ~now[there_1]);
    const Bit takes_missed = as("takes_missed", now[MissQueue::there] & ~divided_there & ~now[there_1]);
    const auto compared = memory[divided_rays].word();
    const auto taken = as("taken", select(divided_there, compared[divided_ray], memory[missed_rays].word()));
    const auto ray = as("asked_leaf", select(now[there_1], now[ray_1], taken));
    memory[leaves].ask(ray);
    memory[flaws].write(in[reads], in[read_ray], in[unread]);
    memory[flaws].ask(ray);
    memory[go_words].ask(GoQueue::step<D>(now, next, in[goes], Bit(go_granted | wants.go_lost)));
    const auto next_missed = MissQueue::step<D>(now, next, misses, takes_missed);
    memory[missed_rays].ask(next_missed);
    memory[divided_rays].ask(DivideQueue::step<D>(now, next, in[divided], takes_divided));
    next[stops_1] = select(now[there_1], now[stops_1], Bit(takes_divided & Bit(compared[divided_stops])));
    next[there_1] = holds | takes_divided | takes_missed;
    next[settled_1] = ~now[writes];
    next.where(next_granted)[writer] = now[ray_1];
    next.where(next_granted)[leaf] = word_behind(wants.leaf[block], wants.leaf[triangles]);
    // The word of a ray that tests a triangle again stays as it is.
    const Bit goes_on = change_if(has_again, next_granted, [&](const Bit& granted_one) {
      memory[missed_again].ask(next_missed);
      next[again_1] =
          select(now[there_1], now[again_1], Bit(takes_missed & Bit(memory[missed_again].word())));
      return as("goes_on", granted_one & ~now[again_1]);
    });
    next[writes] = goes_on | (now[writes] & begins);
    next[ray_1] = ray;
  }

 private:
  /// What the first of the rays want.
  template <class D>
  static constexpr auto wanted_by(const auto& f, const auto& now, const auto& memory) {
    using Bit = typename D::bit;
    struct Wants {
      Bit next, done, next_lost;  // the ray of stage 1: its leaf's next triangle, which may not be there
      Bit unread;                 // its last triangle could not be read, or was none
      decltype(memory[leaves].word()) leaf;
      Bit go, go_lost;  // the first of the queue `goes`
      decltype(memory[go_words].word()) first;
    };
    // Stage 1: the word of a leaf is there, unless one is to be written first.
    const auto its_leaf = memory[leaves].word();
    const bool has_again = has_questions(ReaderBits(f));
    const auto unless_again = [&](const Bit& x) {
      return change_if(has_again, x, [&](const Bit& bit) { return Bit(bit & ~now[again_1]); });
    };
    const Bit was_unread = memory[flaws].word();
    const Bit is_bad = as("leaf_is_bad", was_unread | unless_again(Bit(its_leaf[outside])));
    const Bit knows = as("knows", now[there_1] & now[settled_1] & ~now[writes]);
    const Bit is_done =
        as("leaf_ends", knows & ~was_unread & unless_again(now[stops_1] | ~any<D>(its_leaf[triangles])));
    const Bit wants_next = as("wants_next", knows & ~is_done & ~is_bad);
    const Bit next_lost = as("next_lost", knows & ~is_done & is_bad);

    const auto first = memory[go_words].word();
    const Bit first_outside = first[outside];
    const Bit wants_go = as("wants_go", now[GoQueue::there] & ~first_outside & ~wants_next);
    const Bit go_lost = as("go_lost", now[GoQueue::there] & first_outside & ~knows);
    return Wants{wants_next, is_done, next_lost, was_unread, its_leaf, wants_go, go_lost, first};
  }
};

}  // namespace reader

using reader::Reader;

}  // namespace hitpipe::hls
