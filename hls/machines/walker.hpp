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

#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"
#include "hls/num/one_hot.hpp"

namespace hitpipe::hls {
namespace walker {

using namespace channels;

// The boxes of a record have been tested, now or later than its blocks were read.
constexpr Data<"hit_0"> hit_0;
constexpr Data<"hit_1"> hit_1;
constexpr Data<"second_first"> second_first;
constexpr Data<"near_0", box_bits> near_0;
constexpr Data<"far_0", box_bits> far_0;
constexpr Data<"near_1", box_bits> near_1;
constexpr Data<"far_1", box_bits> far_1;
struct TestedBoxes : List<tested, tester, hit_0, hit_1, second_first, near_0, far_0, near_1, far_1> {};

// Words. What a ray's word in `walks` holds:
constexpr Data<"trail", &WalkBits::levels> trail;
constexpr Data<"level", &WalkBits::level> level;
constexpr Data<"resumed", &WalkBits::level> resumed;  // the level that was taken up again last
constexpr Data<"used", &WalkBits::used> used;         // places of the stack that hold something
constexpr Data<"top", &WalkBits::stack> top;          // the next place
constexpr Data<"steps", step_bits> steps;
struct Walk : List<trail, level, resumed, used, top, steps> {};
// A child of a record, and where the ray is within it.
constexpr Data<"child", address_bits> child;
constexpr Data<"count", leaf_bits> count;
constexpr Data<"near", box_bits> near;
constexpr Data<"far", box_bits> far;
struct Entry : List<child, count, near, far> {};
constexpr Data<"second", address_bits> second;  // the block of child 1
struct Blocks : List<flaw, second, count_1, block, count_0> {};
struct Box0 : List<second_first, hit_0, near_0, far_0> {};
struct Box1 : List<hit_1, near_1, far_1> {};
struct Returned : List<return_ray, return_lost, return_stops, return_cut> {};
constexpr Data<"was_there"> was_there;  // it is no new ray
struct Other : List<start_ray, was_there, start_cut> {};

using Pairs = IdQueue<"pairs_">;
using Leaves = IdQueue<"leaves_">;
using Others = IdQueue<"others_">;
// Stage 1: a ray that is taken up, and what has happened to it; nothing: the stage is empty.
constexpr Data<"ray_1", ray_bits> ray_1;
constexpr Control<"pair_1"> pair_1;
constexpr Control<"leaf_1"> leaf_1;
constexpr Control<"fresh_1"> fresh_1;
constexpr Control<"again_1"> again_1;
constexpr Data<"stops_1"> stops_1;
constexpr Data<"lost_1", lost_bits> lost_1;
constexpr Data<"cut_1", box_bits> cut_1;
// Stage 2.
constexpr Data<"ray_2", ray_bits> ray_2;
constexpr Control<"there_2"> there_2;
constexpr Data<"descends_2"> descends_2;
constexpr Data<"begins_2"> begins_2;
constexpr Data<"pops_2"> pops_2;
constexpr Data<"ends_2"> ends_2;
constexpr Data<"lost_2", lost_bits> lost_2;
constexpr Data<"some_2"> some_2;  // the stack has a place
constexpr Data<"trail_2", &WalkBits::levels> trail_2;
constexpr Data<"popped_2", &WalkBits::levels> popped_2;
constexpr Data<"level_2", &WalkBits::level> level_2;
constexpr Data<"resumed_2", &WalkBits::level> resumed_2;
constexpr Data<"used_2", &WalkBits::used> used_2;
constexpr Data<"top_2", &WalkBits::stack> top_2;
constexpr Data<"steps_2", step_bits> steps_2;
constexpr Data<"cut_2", box_bits> cut_2;
constexpr Data<"entry_2", record_width<Entry>> entry_2;
// What leaves.
constexpr Data<"ray_3", ray_bits> ray_3;
constexpr Control<"goes_3"> goes_3;
constexpr Control<"ended_3"> ended_3;
constexpr Data<"failed_3", failure_bits> failed_3;
constexpr Control<"again_3"> again_3;
constexpr Data<"block_3", address_bits> block_3;
constexpr Data<"count_3", leaf_bits> count_3;
constexpr Data<"near_3", box_bits> near_3;
constexpr Data<"far_3", box_bits> far_3;

constexpr Block<"pair_rays", &WalkBits::rays, ray_bits> pair_rays;  // the queues
constexpr BlockOf<"leaf_rays", &WalkBits::rays, Returned> leaf_rays;
constexpr BlockOf<"other_rays", &WalkBits::rays, Other> other_rays;
constexpr BlockOf<"boxes_0", &WalkBits::rays, Box0>
    boxes_0;  // by ray: what the boxes of its record are to it
constexpr BlockOf<"boxes_1", &WalkBits::rays, Box1> boxes_1;
constexpr BlockOf<"children", &WalkBits::rays, Blocks> children;  // by ray: where they are
constexpr BlockOf<"walks", &WalkBits::rays, Walk> walks;          // by ray
constexpr Block<"cuts", &WalkBits::rays, box_bits> cuts;
constexpr BlockOf<"stacks", &WalkBits::stacks, Entry> stacks;  // by ray and place

struct Walker {
  static constexpr const char* name = "walker";
  static constexpr const char* summary = "walks of rays through boxes: trail, short stack, restart";
  using Bits = WalkBits;
  using BuiltIn = FormatList<Fixed<WalkBits{20, 24, 60, 3, 5}>, Fixed<WalkBits{20, 24, 60, 3, 7}>>;
  struct In : Join<Starts, Begins, Children, TestedBoxes, Returns, List<most_steps>> {};
  struct Out : Join<Starts::Back, Goes, WalkInterval, Ended> {};
  struct State : Join<Pairs::State, Leaves::State, Others::State,
                      List<ray_1, pair_1, leaf_1, fresh_1, again_1, stops_1, lost_1, cut_1>,
                      List<ray_2, there_2, descends_2, begins_2, pops_2, ends_2, lost_2, some_2, trail_2,
                           popped_2, level_2, resumed_2, used_2, top_2, steps_2, cut_2, entry_2>,
                      List<ray_3, goes_3, ended_3, failed_3, again_3, block_3, count_3, near_3, far_3>> {};
  struct Memory : List<pair_rays, leaf_rays, other_rays, boxes_0, boxes_1, children, walks, cuts, stacks> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& /*memory*/, const auto& out) {
    out[walker_takes] = ~now[again_3];
    out[goes] = now[goes_3];
    out[ended] = now[ended_3];
    out[failed] = now[failed_3];
    out[walk_ray] = now[ray_3];
    out[wanted] = now[block_3];
    out[triangles] = now[count_3];
    out[enters_at] = now[near_3];
    out[leaves_at] = now[far_3];
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    record_words<D>(f, in, memory);
    take_up<D>(now, in, memory, next);
    follow<D>(f, now, in, memory, next);
    choose<D>(f, now, memory, next);
  }

 private:
  static constexpr std::int64_t record_count(const WalkBits& bits) {
    return power_of_two(leaf_bits(bits)) - 1;
  }

  /// The words of a ray whose record is read or tested.
  template <class D>
  static constexpr void record_words(const auto& f, const auto& in, const auto& memory) {
    using Bit = typename D::bit;
    const Bit record = as("first_is_record", is<D>(in[count_0], record_count(f)));
    const auto blocks = as("first_blocks", select(record, D::lit(1, width_of(in[count_0])), in[count_0]));
    const auto sum = as("second_block", in[block] + blocks);
    const auto width = width_of(in[block]);
    const auto above = slice(sum, width_of(sum) - 1_w, width);
    const Bit goes_round = as("goes_round", any<D>(above) & any<D>(in[count_1]));
    memory[children].write(in[begins], in[test_ray], in[flaw] | cat(goes_round, D::lit(0, 1_w)),
                           slice(sum, width - 1_w, 0_w), in[count_1], in[block], in[count_0]);
    memory[boxes_0].write(in[tested], in[tester], in[second_first], in[hit_0], in[near_0], in[far_0]);
    memory[boxes_1].write(in[tested], in[tester], cat(in[hit_1], cat(in[near_1], in[far_1])));
  }

  /// Stage 0.
  template <class D>
  static constexpr void take_up(const auto& now, const auto& in, const auto& memory, const auto& next) {
    using Bit = typename D::bit;
    const Bit again = now[again_3];
    const Bit enters = as("enters", in[starts] | again);
    memory[pair_rays].write(in[tested], as("pair_place", Pairs::place(now)), in[tester]);
    memory[leaf_rays].write(in[returns], as("leaf_place", Leaves::place(now)), in[return_ray],
                            in[return_lost], in[return_stops], in[return_cut]);
    memory[other_rays].write(enters, as("other_place", Others::place(now)),
                             cat(select(again, now[ray_3], in[start_ray]), cat(again, in[start_cut])));

    // Leaves come first, because few of them wait.
    const Bit takes_leaf = as("takes_leaf", now[Leaves::there]);
    const Bit takes_other = as("takes_other", now[Others::there] & ~takes_leaf);
    const Bit takes_pair = as("takes_pair", now[Pairs::there] & ~takes_leaf & ~now[Others::there]);
    const auto of_leaf = memory[leaf_rays].word();
    const auto other = memory[other_rays].word();
    const auto taken =
        as("taken_ray", select(takes_leaf, of_leaf[return_ray],
                               select(takes_other, other[start_ray], memory[pair_rays].word())));
    next[ray_1] = taken;
    next[pair_1] = takes_pair;
    next[leaf_1] = takes_leaf;
    next[fresh_1] = takes_other & ~Bit(other[was_there]);
    next[again_1] = takes_other & Bit(other[was_there]);
    next[stops_1] = of_leaf[return_stops];
    next[lost_1] = of_leaf[return_lost];
    next[cut_1] = select(takes_leaf, of_leaf[return_cut], other[start_cut]);
    memory[pair_rays].ask(Pairs::step<D>(now, next, in[tested], takes_pair));
    memory[leaf_rays].ask(Leaves::step<D>(now, next, in[returns], takes_leaf));
    memory[other_rays].ask(Others::step<D>(now, next, enters, takes_other));
    memory[boxes_0].ask(taken);
    memory[boxes_1].ask(taken);
    memory[children].ask(taken);
    memory[walks].ask(taken);
    memory[cuts].ask(taken);
  }

  /// Stage 1.
  template <class D>
  static constexpr void choose(const auto& f, const auto& now, const auto& memory, const auto& next) {
    using Bit = typename D::bit;
    const auto walk = memory[walks].word();
    const auto box_0 = memory[boxes_0].word();
    const auto box_1 = memory[boxes_1].word();
    const auto both_children = memory[children].word();
    const Bit not_fresh = ~now[fresh_1];

    const Bit meets_0 = as("meets_0", Bit(box_0[hit_0]) & any<D>(both_children[count_0]));
    const Bit meets_1 = as("meets_1", Bit(box_1[hit_1]) & any<D>(both_children[count_1]));
    const Bit both = as("both", meets_0 & meets_1);
    const Bit one = as("one", meets_0 ^ meets_1);
    const auto here = as("here", slice(one_hot<D>(walk[level]), trail.width(f) - 1_w, 0_w));
    const Bit first_done = as("first_done", any<D>(walk[trail] & here));
    const Bit is_resumed = as("is_resumed", Bit(walk[level] == walk[resumed]));
    // One child where a level is taken up again: it is the first, which is done.
    const Bit descends = as("descends", now[pair_1] & (both | (one & ~is_resumed)));
    const Bit takes_1 = as("takes_1", select(both, Bit(Bit(box_0[second_first]) ^ first_done), meets_1));
    const Bit pushes = as("pushes", now[pair_1] & both & ~first_done);
    const Bit pops = as("pops", ~now[fresh_1] & ~descends);
    const auto entry_0 = cat(both_children[block], both_children[count_0], box_0[near_0], box_0[far_0]);
    const auto entry_1 = cat(both_children[second], both_children[count_1], box_1[near_1], box_1[far_1]);
    memory[stacks].write(pushes, cat(now[ray_1], walk[top]), select(takes_1, entry_0, entry_1));
    memory[stacks].ask(cat(now[ray_1], minus(walk[top], D::lit(1, 1_w))));

    // A level of which one child is met, or none, has nothing that waits. To pop is to add 1 at the level:
    // the carry stops at the deepest level of which a child waits, and the bit there becomes 1.
    const auto marked = as("marked", walk[trail] | only(Bit(now[pair_1] & ~both), here));
    const auto sum = as("sum", cat(D::lit(0, 1_w), marked) + here);
    const auto popped = slice(sum, trail.width(f) - 1_w, 0_w);
    next[trail_2] = only(not_fresh, select(pops, popped, marked));
    next[popped_2] = popped & ~marked;
    next[level_2] = walk[level];
    next[resumed_2] = select(now[fresh_1], D::lit(trail.width(f), level.width(f)), walk[resumed]);
    const Bit full = sign(walk[used]);
    next[used_2] = only(not_fresh, plus(walk[used], Bit(pushes & ~full)));
    next[some_2] = any<D>(walk[used]);
    // Any place is as good as the first, but a simulator does not know what a new ray's word holds.
    next[top_2] = only(not_fresh, plus(walk[top], pushes));
    next[steps_2] = only(not_fresh, walk[steps]);
    next[cut_2] = as("cut_now", select(Bit(now[leaf_1] | now[fresh_1]), now[cut_1], memory[cuts].word()));
    next[entry_2] = select(takes_1, entry_1, entry_0);
    next[ray_2] = now[ray_1];
    next[there_2] = now[pair_1] | now[leaf_1] | now[fresh_1] | now[again_1];
    next[descends_2] = descends;
    next[begins_2] = now[fresh_1];
    next[pops_2] = pops;
    const auto lost = as("lost", only(now[leaf_1], now[lost_1]) | only(now[pair_1], both_children[flaw]));
    next[lost_2] = lost;
    next[ends_2] = (now[leaf_1] & now[stops_1]) | Bit(sign(lost)) | (pops & Bit(bit_at(sum, trail.width(f))));
  }

  /// Stage 2.
  template <class D>
  static constexpr void follow(const auto& f, const auto& now, const auto& in, const auto& memory,
                               const auto& next) {
    using Bit = typename D::bit;
    const auto d = near.width(f);
    const auto stacked = memory[stacks].word();

    const Bit resumes = as("resumes", now[pops_2] & now[some_2]);
    const Bit is_met = as("is_met", Bit(stacked[near] <= now[cut_2]));  // else the ray has become too short
    const Bit again = as("again", resumes & ~is_met);
    const Bit from_root = as("from_root", now[begins_2] | (now[pops_2] & ~now[some_2]));
    const auto root =
        cat(D::lit(0, child.width(f)), D::lit(record_count(f), count.width(f)), D::lit(0, d), now[cut_2]);
    const auto word =
        as("entry", select(from_root, root, select(now[descends_2], now[entry_2], stacked.word())));
    const auto entry = record_of<Entry>(f, word);
    const Bit record = as("is_record", is<D>(entry[count], record_count(f)));

    // A record is one level deeper than the record whose child it is; a leaf is of that level.
    const auto level_bits = level.width(f);
    const auto taken_up =
        as("resumed", select(now[pops_2], place_of<D>(now[popped_2], level_bits), now[resumed_2]));
    const auto parent = as("parent", select(now[pops_2], taken_up, now[level_2]));
    const Bit deeper = record & ~again;
    const auto its_level = select(from_root, D::lit(trail.width(f) - 1_w, level_bits), minus(parent, deeper));
    const Bit too_deep = as("too_deep", ~from_root & ~any<D>(parent));
    const Bit too_long = as("too_long", Bit(now[steps_2] == at_most<D>(in[most_steps], steps_2.width(f))));
    const Bit fails = as("fails", record & ~again & (too_deep | too_long));
    const Bit at_bound = as("at_bound", fails & ~now[ends_2]);

    const Bit leaves_stack = as("leaves_stack", resumes);
    const auto walk = cat(now[trail_2], cat(cat(its_level, taken_up), cat(minus(now[used_2], leaves_stack),
                                                                          minus(now[top_2], leaves_stack),
                                                                          plus(now[steps_2], deeper))));
    memory[walks].write(now[there_2], now[ray_2], walk);
    memory[cuts].write(now[there_2], now[ray_2], now[cut_2]);
    next[ray_3] = now[ray_2];
    next[goes_3] = now[there_2] & ~now[ends_2] & ~fails & ~again;
    next[ended_3] = now[there_2] & (now[ends_2] | fails);
    next[failed_3] =
        cat(sign(now[lost_2]), at_bound, Bit(at_bound & too_deep) | Bit(bit_at(now[lost_2], 0_w)));
    next[again_3] = now[there_2] & ~now[ends_2] & again;
    next[block_3] = entry[child];
    next[count_3] = entry[count];
    next[near_3] = entry[near];
    next[far_3] = select(Bit(entry[far] < now[cut_2]), entry[far], now[cut_2]);
  }
};

}  // namespace walker

using walker::Walker;

}  // namespace hitpipe::hls
