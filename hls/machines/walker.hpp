// The walk of rays through records of two boxes (docs/core.md): what a ray reads next, and when it has ended.
// Each ray has a trail and a stack of a few places (Laine, "Restart Trail for Stackless BVH Traversal",
// 2010). It is at one place at a time, so three queues with a place for each ray hold all that can happen to
// rays:
//   pairs   the boxes of its record have been tested
//   leaves  its triangles have been tested
//   others  a new ray, or one whose last place on the stack was of no use any more
// In each cycle one of them is taken up, in three stages:
//   0  the ray's words are asked for
//   1  which child it follows; the other goes onto the stack, or a place of the stack is asked for
//   2  the place of the stack is followed, or the walk begins again at the root, or it ends
// A trail has a bit for each level, that of the root's own record on top; 1 says that no child of that level
// waits. A level is named by the place of its bit.
#pragma once

#include "hls/machines/id_queue.hpp"
#include "hls/machines/machine.hpp"
#include "hls/machines/walk_format.hpp"
#include "hls/num/bits.hpp"
#include "hls/num/one_hot.hpp"

namespace hitpipe {
namespace hls {
namespace walker {

/// Widths as types, in a format.
template <class F>
struct Widths {
  static constexpr F format{};
  static constexpr auto level_of(const F& f) { return count_bits(f.levels + 1_w); }
  static constexpr auto walk_of(const F& f) {
    return f.levels + level_of(f) * 2_w + f.stack * 2_w + 1_w + Width<step_count_bits>();
  }
  static constexpr auto child_of(const F& f) { return f.address + Width<child_count_bits>(); }
  static constexpr auto entry_of(const F& f) { return child_of(f) + f.distance * 2_w; }

  using Ray = decltype(format.ray + 0_w);
  using Distance = decltype(format.distance + 0_w);
  using Address = decltype(format.address + 0_w);
  using Trail = decltype(format.levels + 0_w);
  using Level = decltype(level_of(format));
  using Entry = decltype(entry_of(format));
  using Used = decltype(format.stack + 1_w);
  using Top = decltype(format.stack + 0_w);
  using Count = decltype(format.ray * 0_w + Width<child_count_bits>());
  using Steps = decltype(format.ray * 0_w + Width<step_count_bits>());
};

/// A ray that is taken up, and what has happened to it; nothing: the stage is empty.
template <class D, class F>
struct Taken {
  using W = Widths<F>;
  Word<D, typename W::Ray> ray;
  typename D::bit pair, leaf, fresh, again;
  typename D::bit stops, lost;
  Word<D, typename W::Distance> cut;
};

template <class D, class F>
struct State {
  using bit = typename D::bit;
  using W = Widths<F>;

  IdQueue<D, F> pairs, leaves, others;
  Taken<D, F> taken;  ///< stage 1
  // Stage 2.
  Word<D, typename W::Ray> ray_2;
  bit there_2;
  bit descends_2, begins_2, pops_2, ends_2, lost_2;
  bit some_2;  ///< the stack has a place
  Word<D, typename W::Trail> trail_2, popped_2;
  Word<D, typename W::Level> level_2, resumed_2;
  Word<D, typename W::Used> used_2;
  Word<D, typename W::Top> top_2;
  Word<D, typename W::Steps> steps_2;
  Word<D, typename W::Distance> cut_2;
  Word<D, typename W::Entry> entry_2;
  // What leaves.
  Word<D, typename W::Ray> ray_3;
  bit goes, ended, failed, again;
  Word<D, typename W::Address> block;
  Word<D, typename W::Count> count;
  Word<D, typename W::Distance> near, far;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const WalkBits bits = format;
    const int level = Widths<WalkBits>::level_of(bits);
    IdQueue<D, F>::for_each({"pairs_used", "pairs_oldest", "pairs_there"}, bits.ray, self.pairs, visit);
    IdQueue<D, F>::for_each({"leaves_used", "leaves_oldest", "leaves_there"}, bits.ray, self.leaves, visit);
    IdQueue<D, F>::for_each({"others_used", "others_oldest", "others_there"}, bits.ray, self.others, visit);
    visit(data_field("ray_1", bits.ray), self.taken.ray);
    visit(control_field("pair_1", 1), self.taken.pair);
    visit(control_field("leaf_1", 1), self.taken.leaf);
    visit(control_field("fresh_1", 1), self.taken.fresh);
    visit(control_field("again_1", 1), self.taken.again);
    visit(data_field("stops_1", 1), self.taken.stops);
    visit(data_field("lost_1", 1), self.taken.lost);
    visit(data_field("cut_1", bits.distance), self.taken.cut);
    visit(data_field("ray_2", bits.ray), self.ray_2);
    visit(control_field("there_2", 1), self.there_2);
    visit(data_field("descends_2", 1), self.descends_2);
    visit(data_field("begins_2", 1), self.begins_2);
    visit(data_field("pops_2", 1), self.pops_2);
    visit(data_field("ends_2", 1), self.ends_2);
    visit(data_field("lost_2", 1), self.lost_2);
    visit(data_field("some_2", 1), self.some_2);
    visit(data_field("trail_2", bits.levels), self.trail_2);
    visit(data_field("popped_2", bits.levels), self.popped_2);
    visit(data_field("level_2", level), self.level_2);
    visit(data_field("resumed_2", level), self.resumed_2);
    visit(data_field("used_2", bits.stack + 1), self.used_2);
    visit(data_field("top_2", bits.stack), self.top_2);
    visit(data_field("steps_2", step_count_bits), self.steps_2);
    visit(data_field("cut_2", bits.distance), self.cut_2);
    visit(data_field("entry_2", Widths<WalkBits>::entry_of(bits)), self.entry_2);
    visit(data_field("ray_3", bits.ray), self.ray_3);
    visit(control_field("goes_3", 1), self.goes);
    visit(control_field("ended_3", 1), self.ended);
    visit(data_field("failed_3", 1), self.failed);
    visit(control_field("again_3", 1), self.again);
    visit(data_field("block_3", bits.address), self.block);
    visit(data_field("count_3", child_count_bits), self.count);
    visit(data_field("near_3", bits.distance), self.near);
    visit(data_field("far_3", bits.distance), self.far);
  }
};

template <class D, class F>
struct Inputs {
  using bit = typename D::bit;
  using W = Widths<F>;

  bit begins;  ///< a new ray, where `takes` was 1: it begins at the root's own record
  Word<D, typename W::Ray> begun;
  Word<D, typename W::Distance> length;
  bit reads;  ///< a record has been read for a ray: the blocks of its children
  Word<D, typename W::Ray> reader;
  Word<D, typename W::Address> block;  ///< of child 0; child 1 follows
  Word<D, typename W::Count> count_0, count_1;
  bit tested;  ///< int_major_pair has tested the boxes of that record, now or later
  Word<D, typename W::Ray> ray;
  bit hit_0, hit_1, second_first;
  Word<D, typename W::Distance> near_0, far_0, near_1, far_1;
  bit leaf;  ///< the triangles of a leaf have been tested
  Word<D, typename W::Ray> leaf_ray;
  Word<D, typename W::Distance> cut;      ///< the ray's length now, as a box distance
  bit stops;                              ///< nothing else is wanted of this ray
  bit lost;                               ///< with `stops`: it wanted a block that is not in the image
  Word<D, typename W::Steps> most_steps;  ///< records that a walk may test; constant while rays are in flight

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const WalkBits bits = format;
    visit(data_field("begins", 1), self.begins);
    visit(data_field("begun", bits.ray), self.begun);
    visit(data_field("length", bits.distance), self.length);
    visit(data_field("reads", 1), self.reads);
    visit(data_field("read_ray", bits.ray), self.reader);
    visit(data_field("block", bits.address), self.block);
    visit(data_field("count_0", child_count_bits), self.count_0);
    visit(data_field("count_1", child_count_bits), self.count_1);
    visit(data_field("tested", 1), self.tested);
    visit(data_field("ray", bits.ray), self.ray);
    visit(data_field("hit_0", 1), self.hit_0);
    visit(data_field("hit_1", 1), self.hit_1);
    visit(data_field("second_first", 1), self.second_first);
    visit(data_field("near_0", bits.distance), self.near_0);
    visit(data_field("far_0", bits.distance), self.far_0);
    visit(data_field("near_1", bits.distance), self.near_1);
    visit(data_field("far_1", bits.distance), self.far_1);
    visit(data_field("leaf", 1), self.leaf);
    visit(data_field("leaf_ray", bits.ray), self.leaf_ray);
    visit(data_field("cut", bits.distance), self.cut);
    visit(data_field("stops", 1), self.stops);
    visit(data_field("lost", 1), self.lost);
    visit(data_field("most_steps", step_count_bits), self.most_steps);
  }
};

template <class D, class F>
struct Outputs {
  using bit = typename D::bit;
  using W = Widths<F>;

  bit takes;                                ///< a new ray may begin in this cycle
  bit goes;                                 ///< the ray wants a record, or the triangles of a leaf
  bit ended;                                ///< the ray's walk has ended
  bit failed;                               ///< with `ended`: at a bound, of steps or of levels, or lost
  Word<D, typename W::Ray> of;              ///< the ray
  Word<D, typename W::Address> wanted;      ///< the block
  Word<D, typename W::Count> triangles;     ///< all ones: it is a record
  Word<D, typename W::Distance> near, far;  ///< where the ray is within it

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const WalkBits bits = format;
    visit(data_field("takes", 1), self.takes);
    visit(data_field("goes", 1), self.goes);
    visit(data_field("ended", 1), self.ended);
    visit(data_field("failed", 1), self.failed);
    visit(data_field("of", bits.ray), self.of);
    visit(data_field("wanted", bits.address), self.wanted);
    visit(data_field("triangles", child_count_bits), self.triangles);
    visit(data_field("enters_at", bits.distance), self.near);
    visit(data_field("leaves_at", bits.distance), self.far);
  }
};

template <class Memory>
struct Memories {
  Memory pair_rays, leaf_rays, other_rays;  ///< the queues
  Memory boxes_0, boxes_1;                  ///< by ray: what the boxes of its record are to it
  Memory children;                          ///< by ray: where they are
  Memory walks, cuts;                       ///< by ray
  Memory stacks;                            ///< by ray and place

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const WalkBits bits = format;
    using W = Widths<WalkBits>;
    const auto memory = [&](const char* name, int words, int width, Memory& of) {
      visit(MemoryShape{name, words, width, MemoryKind::block}, of);
    };
    const int rays = bits.rays();
    memory("pair_rays", rays, bits.ray, self.pair_rays);
    memory("leaf_rays", rays, bits.ray + 2 + bits.distance, self.leaf_rays);
    memory("other_rays", rays, bits.ray + 1 + bits.distance, self.other_rays);
    memory("boxes_0", rays, 2 + 2 * bits.distance, self.boxes_0);
    memory("boxes_1", rays, 1 + 2 * bits.distance, self.boxes_1);
    memory("children", rays, 2 * W::child_of(bits), self.children);
    memory("walks", rays, W::walk_of(bits), self.walks);
    memory("cuts", rays, bits.distance, self.cuts);
    memory("stacks", rays * bits.places(), W::entry_of(bits), self.stacks);
  }
};

struct Walker {
  static constexpr const char* name = "walker";
  static constexpr const char* summary = "walks of rays through boxes: trail, short stack, restart";
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = WalkBits;
  using BuiltIn = FormatList<WalkFormat<20, 24, 60, 3, 5>, WalkFormat<20, 24, 60, 3, 7>>;
  template <class D, class F>
  using State = walker::State<D, F>;
  template <class D, class F>
  using Inputs = walker::Inputs<D, F>;
  template <class D, class F>
  using Outputs = walker::Outputs<D, F>;
  template <class Memory>
  using Memories = walker::Memories<Memory>;

  template <class D, class F, class Memory>
  static constexpr Outputs<D, F> outputs(const F& /*format*/, const State<D, F>& state, Memories<Memory>&) {
    return {typename D::bit(~state.again),
            state.goes,
            state.ended,
            state.failed,
            state.ray_3,
            state.block,
            state.count,
            state.near,
            state.far};
  }

  template <class D, class F, class Memory>
  static constexpr void step(const F& format, State<D, F>& state, const Inputs<D, F>& in,
                             Memories<Memory>& memories) {
    record_words<D>(format, in, memories);
    const auto next = taken_up<D>(format, state, in, memories);
    follow<D>(format, state, in, memories);
    choose<D>(format, state, memories);
    state.taken = next;
  }

 private:
  static constexpr std::int64_t record_count = (1 << child_count_bits) - 1;

  /// What a ray's word in `walks` holds.
  template <class D, class F>
  struct Walk {
    using W = Widths<F>;
    Word<D, typename W::Trail> trail;
    Word<D, typename W::Level> level, resumed;  ///< `resumed`: the level that was taken up again last
    Word<D, typename W::Used> used;             ///< places of the stack that hold something
    Word<D, typename W::Top> top;               ///< the next place
    Word<D, typename W::Steps> steps;

    template <class X>
    static constexpr Walk of(const F& f, const X& word) {
      const auto level_bits = W::level_of(f);
      const auto top_at = Width<step_count_bits>() + f.ray * 0_w;
      const auto used_at = top_at + f.stack;
      const auto resumed_at = used_at + f.stack + 1_w;
      const auto level_at = resumed_at + level_bits;
      const auto trail_at = level_at + level_bits;
      return {slice(word, W::walk_of(f) - 1_w, trail_at), slice(word, trail_at - 1_w, level_at),
              slice(word, level_at - 1_w, resumed_at),    slice(word, resumed_at - 1_w, used_at),
              slice(word, used_at - 1_w, top_at),         slice(word, top_at - 1_w, 0_w)};
    }
    constexpr auto word() const { return cat(trail, cat(cat(level, resumed), cat(cat(used, top), steps))); }
  };

  /// The words of a ray whose record is read or tested.
  template <class D, class F, class M>
  static constexpr void record_words(const F& format, const Inputs<D, F>& in, M& memories) {
    using Bit = typename D::bit;
    const auto bits = width_of(in.count_0);
    const Bit record = as("first_is_record", Bit(in.count_0 == D::lit(record_count, bits)));
    const auto blocks = as("first_blocks", select(record, D::lit(1, bits), in.count_0));
    const auto second = as("second_block", as_unsigned(resize(in.block + blocks, format.address)));
    memories.children.write(in.reads, in.reader, cat(cat(second, in.count_1), cat(in.block, in.count_0)));
    memories.boxes_0.write(in.tested, in.ray, cat(cat(in.second_first, in.hit_0), cat(in.near_0, in.far_0)));
    memories.boxes_1.write(in.tested, in.ray, cat(in.hit_1, cat(in.near_1, in.far_1)));
  }

  /// Stage 0.
  template <class D, class F, class M>
  static constexpr Taken<D, F> taken_up(const F& format, State<D, F>& s, const Inputs<D, F>& in,
                                        M& memories) {
    using Bit = typename D::bit;
    const auto i = format.ray;
    const auto d = format.distance;
    const Bit enters = as("enters", in.begins | s.again);
    memories.pair_rays.write(in.tested, as("pair_place", s.pairs.place(i)), in.ray);
    memories.leaf_rays.write(in.leaf, as("leaf_place", s.leaves.place(i)),
                             cat(cat(in.leaf_ray, in.lost), cat(in.stops, in.cut)));
    memories.other_rays.write(enters, as("other_place", s.others.place(i)),
                              cat(select(s.again, s.ray_3, in.begun), cat(s.again, in.length)));

    // Leaves come first, because few of them wait.
    const Bit leaf = as("takes_leaf", s.leaves.there);
    const Bit other = as("takes_other", s.others.there & ~leaf);
    const Bit pair = as("takes_pair", s.pairs.there & ~leaf & ~s.others.there);
    const auto leaf_word = memories.leaf_rays.word(i + d + 2_w);
    const auto other_word = memories.other_rays.word(i + d + 1_w);
    const Bit was_there = bit_at(other_word, d);
    Taken<D, F> next;
    next.ray =
        as("taken_ray", select(leaf, slice(leaf_word, i + d + 1_w, d + 2_w),
                               select(other, slice(other_word, i + d, d + 1_w), memories.pair_rays.word(i))));
    next.pair = pair;
    next.leaf = leaf;
    next.fresh = other & ~was_there;
    next.again = other & was_there;
    next.stops = bit_at(leaf_word, d);
    next.lost = bit_at(leaf_word, d + 1_w);
    next.cut = select(leaf, slice(leaf_word, d - 1_w, 0_w), slice(other_word, d - 1_w, 0_w));
    memories.pair_rays.ask(s.pairs.step(i, in.tested, pair));
    memories.leaf_rays.ask(s.leaves.step(i, in.leaf, leaf));
    memories.other_rays.ask(s.others.step(i, enters, other));
    memories.boxes_0.ask(next.ray);
    memories.boxes_1.ask(next.ray);
    memories.children.ask(next.ray);
    memories.walks.ask(next.ray);
    memories.cuts.ask(next.ray);
    return next;
  }

  /// Stage 1.
  template <class D, class F, class M>
  static constexpr void choose(const F& format, State<D, F>& s, M& memories) {
    using Bit = typename D::bit;
    using W = Widths<F>;
    const auto d = format.distance;
    const auto& taken = s.taken;
    const auto walk = Walk<D, F>::of(format, memories.walks.word(W::walk_of(format)));
    const auto boxes_0 = memories.boxes_0.word(d * 2_w + 2_w);
    const auto boxes_1 = memories.boxes_1.word(d * 2_w + 1_w);
    const auto children = memories.children.word(W::child_of(format) * 2_w);
    const auto child_0 = slice(children, W::child_of(format) - 1_w, 0_w);
    const auto child_1 = slice(children, W::child_of(format) * 2_w - 1_w, W::child_of(format));
    const auto count_of = [](const auto& child) { return slice(child, Width<child_count_bits - 1>(), 0_w); };

    const Bit meets_0 = as("meets_0", Bit(bit_at(boxes_0, d * 2_w)) & any<D>(count_of(child_0)));
    const Bit meets_1 = as("meets_1", Bit(bit_at(boxes_1, d * 2_w)) & any<D>(count_of(child_1)));
    const Bit both = as("both", meets_0 & meets_1);
    const Bit one = as("one", meets_0 ^ meets_1);
    const auto here = as("here", slice(one_hot<D>(walk.level), format.levels - 1_w, 0_w));
    const Bit first_done = as("first_done", any<D>(walk.trail & here));
    const Bit is_resumed = as("is_resumed", Bit(walk.level == walk.resumed));
    // One child where a level is taken up again: it is the first, which is done.
    const Bit descends = as("descends", taken.pair & (both | (one & ~is_resumed)));
    const Bit second_first = bit_at(boxes_0, d * 2_w + 1_w);
    const Bit takes_1 = as("takes_1", select(both, Bit(second_first ^ first_done), meets_1));
    const Bit pushes = as("pushes", taken.pair & both & ~first_done);
    const Bit pops = as("pops", ~taken.fresh & ~descends);
    const auto entry_0 = cat(child_0, slice(boxes_0, d * 2_w - 1_w, 0_w));
    const auto entry_1 = cat(child_1, slice(boxes_1, d * 2_w - 1_w, 0_w));
    memories.stacks.write(pushes, cat(taken.ray, walk.top), select(takes_1, entry_0, entry_1));
    memories.stacks.ask(cat(taken.ray, as_unsigned(resize(walk.top - D::lit(1, 1_w), format.stack))));

    // A level of which one child is met, or none, has nothing that waits. To pop is to add 1 at the level:
    // the carry stops at the deepest level of which a child waits, and the bit there becomes 1.
    const auto marked = as("marked", walk.trail | (here & spread(Bit(taken.pair & ~both), format.levels)));
    const auto sum = as("sum", cat(D::lit(0, 1_w), marked) + here);
    const auto popped = slice(sum, format.levels - 1_w, 0_w);
    const auto kept = select(pops, popped, marked);
    s.trail_2 = kept & spread(Bit(~taken.fresh), format.levels);
    s.popped_2 = popped & ~marked;
    s.level_2 = walk.level;
    s.resumed_2 = select(taken.fresh, D::lit(format.levels, W::level_of(format)), walk.resumed);
    const Bit full = bit_at(walk.used, format.stack);
    const auto used = as_unsigned(resize(walk.used + Bit(pushes & ~full), format.stack + 1_w));
    s.used_2 = used & spread(Bit(~taken.fresh), format.stack + 1_w);
    s.some_2 = any<D>(walk.used);
    // Any place is as good as the first, but a simulator does not know what a new ray's word holds.
    s.top_2 = as_unsigned(resize(walk.top + pushes, format.stack)) & spread(Bit(~taken.fresh), format.stack);
    s.steps_2 = walk.steps & spread(Bit(~taken.fresh), width_of(walk.steps));
    s.cut_2 = as("cut_now", select(Bit(taken.leaf | taken.fresh), taken.cut, memories.cuts.word(d)));
    s.entry_2 = select(takes_1, entry_1, entry_0);
    s.ray_2 = taken.ray;
    s.there_2 = taken.pair | taken.leaf | taken.fresh | taken.again;
    s.descends_2 = descends;
    s.begins_2 = taken.fresh;
    s.pops_2 = pops;
    s.lost_2 = taken.leaf & taken.lost;
    s.ends_2 = (taken.leaf & taken.stops) | (pops & Bit(bit_at(sum, format.levels)));
  }

  /// Stage 2.
  template <class D, class F, class M>
  static constexpr void follow(const F& format, State<D, F>& s, const Inputs<D, F>& in, M& memories) {
    using Bit = typename D::bit;
    using W = Widths<F>;
    const auto d = format.distance;
    const auto level_bits = W::level_of(format);
    const auto stacked = memories.stacks.word(W::entry_of(format));
    const auto near_of = [&](const auto& entry) { return slice(entry, d * 2_w - 1_w, d); };

    const Bit resumes = as("resumes", s.pops_2 & s.some_2);
    const Bit is_met = as("is_met", Bit(near_of(stacked) <= s.cut_2));  // else the ray has become too short
    const Bit again = as("again", resumes & ~is_met);
    const Bit from_root = as("from_root", s.begins_2 | (s.pops_2 & ~s.some_2));
    const auto root =
        cat(cat(D::lit(0, format.address), D::lit(record_count, Width<child_count_bits>() + d * 0_w)),
            cat(D::lit(0, d), s.cut_2));
    const auto entry = as("entry", select(from_root, root, select(s.descends_2, s.entry_2, stacked)));
    const auto far = slice(entry, d - 1_w, 0_w);
    const auto count = slice(entry, d * 2_w + Width<child_count_bits - 1>(), d * 2_w);
    const Bit record = as("is_record", Bit(count == D::lit(record_count, width_of(count))));

    // A record is one level deeper than the record whose child it is; a leaf is of that level.
    const auto resumed = as("resumed", select(s.pops_2, place_of<D>(s.popped_2, level_bits), s.resumed_2));
    const auto parent = as("parent", select(s.pops_2, resumed, s.level_2));
    const auto level = select(from_root, D::lit(format.levels - 1_w, level_bits),
                              as_unsigned(resize(parent - Bit(record & ~again), level_bits)));
    const Bit too_deep = as("too_deep", ~from_root & ~any<D>(parent));
    const Bit too_long = as("too_long", Bit(s.steps_2 == in.most_steps));
    const Bit fails = as("fails", record & ~again & (too_deep | too_long));

    const Bit leaves_stack = as("leaves_stack", resumes);
    const Walk<D, F> walk{s.trail_2,
                          level,
                          resumed,
                          as_unsigned(resize(s.used_2 - leaves_stack, format.stack + 1_w)),
                          as_unsigned(resize(s.top_2 - leaves_stack, format.stack)),
                          as_unsigned(resize(s.steps_2 + Bit(record & ~again), width_of(s.steps_2)))};
    memories.walks.write(s.there_2, s.ray_2, walk.word());
    memories.cuts.write(s.there_2, s.ray_2, s.cut_2);
    s.ray_3 = s.ray_2;
    s.goes = s.there_2 & ~s.ends_2 & ~fails & ~again;
    s.ended = s.there_2 & (s.ends_2 | fails);
    s.failed = (fails & ~s.ends_2) | s.lost_2;
    s.again = s.there_2 & ~s.ends_2 & again;
    s.block = slice(entry, W::entry_of(format) - 1_w, d * 2_w + Width<child_count_bits>());
    s.count = count;
    s.near = near_of(entry);
    s.far = select(Bit(far < s.cut_2), far, s.cut_2);
  }
};

}  // namespace walker

using walker::Walker;

}  // namespace hls
}  // namespace hitpipe
