// The walker against the walk in software, on random trees, with many rays in flight and answers in any
// order: each ray asks for the same records and leaves with the same interval, and ends when it should.
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hls/machines/walker.hpp"
#include "rtl_gen/machine/machine.hpp"
#include "rtl_gen/machine/module.hpp"
#include "sim/machine/verilated_machine.hpp"
#include "sw_ref/trace/trail_walk.hpp"
#include "tests/rtl_gen/text.hpp"
#include "tests/sw_ref/trace/random_tree.hpp"

namespace hitpipe::sim::walks_test {
namespace {

using ref::PairChild;
using ref::RandomTree;
using ref::TrailWalk;
using rtl::Word;

constexpr Word record_count = 255;

/// A tree with the blocks of its boxes, as an image has them.
struct Placed {
  RandomTree tree;
  std::vector<Word> pointers;        ///< by box: where its children begin
  std::vector<std::int32_t> counts;  ///< by box, as PairChild::count
  std::vector<std::uint32_t> blocks;

  explicit Placed(RandomTree grown, std::mt19937_64& random) : tree(std::move(grown)) {
    pointers.resize(tree.boxes.size());
    counts.resize(tree.boxes.size());
    blocks.resize(tree.boxes.size());
    for (std::size_t box = 0; box < tree.boxes.size(); ++box)
      counts[box] = tree.boxes[box].children[0] < 0 ? 1 + static_cast<int>(random() % 3) : PairChild::branch;
    std::uint32_t next = 1;
    for (std::size_t box = 0; box < tree.boxes.size(); ++box) {
      pointers[box] = next;
      for (const int child : tree.boxes[box].children) {
        if (child < 0) continue;
        const auto c = static_cast<std::size_t>(child);
        blocks[c] = next;
        next += counts[c] == PairChild::branch ? 1 : static_cast<std::uint32_t>(counts[c]);
      }
    }
  }
  [[nodiscard]] PairChild child(std::size_t box) const { return {counts[box], blocks[box]}; }
  [[nodiscard]] std::size_t box_at(std::uint32_t block) const {
    if (block == 0) return 0;
    return static_cast<std::size_t>(std::find(blocks.begin(), blocks.end(), block) - blocks.begin());
  }
};

/// A walk that was asked for something, and when it is answered.
struct InFlight {
  std::unique_ptr<Placed> placed;
  std::optional<TrailWalk> walk;
  ref::TreeHit best;
  bool any = false;
  bool waits = false;  ///< for a record or a leaf
  std::uint64_t read_at = 0, tested_at = 0;
};

struct Seen {
  int ended = 0;
  std::uint64_t records = 0, restarts = 0;
  std::string wrong;  ///< empty: nothing
};

/// Names of a machine's ports as places in its words.
class Ports {
 public:
  explicit Ports(const std::vector<hls::Field>& fields) : words_(fields.size(), 0) {
    for (std::size_t i = 0; i < fields.size(); ++i) places_[fields[i].name] = i;
  }
  Word& operator[](const std::string& name) { return words_[places_.at(name)]; }
  Word* data() { return words_.data(); }
  void clear() { std::fill(words_.begin(), words_.end(), 0); }

 private:
  std::map<std::string, std::size_t> places_;
  std::vector<Word> words_;
};

class Driver {
 public:
  Driver(const hls::WalkBits& bits, rtl::NativeMachine& machine, unsigned seed)
      : bits_(bits),
        machine_(machine),
        graph_(rtl::machine_called("walker")->graph(bits)),
        in_(graph_.inputs),
        out_(graph_.outputs),
        grower_(seed),
        random_(seed),
        rays_(static_cast<std::size_t>(bits.rays())) {}

  /// Stops at the first thing that is wrong.
  Seen run(int trees, std::uint64_t most_cycles) {
    int begun = 0;
    for (cycle_ = 0; seen_.ended < trees && seen_.wrong.empty(); ++cycle_) {
      if (cycle_ == most_cycles) return wrong("rays that do not end");
      in_.clear();
      in_["most_steps"] = hls::low_mask(hls::step_count_bits);
      const std::size_t fresh = random_() % rays_.size();
      const bool offers = !rays_[fresh].walk && begun < trees && random_() % 4 != 0;
      if (offers) offer(fresh);
      give_answers();
      machine_.outputs(out_.data());
      machine_.step(in_.data(), cycle_ == 0);
      if (cycle_ == 0) continue;
      if (offers && out_["walker_takes"] != 0) {
        InFlight& ray = rays_[fresh];
        ray = {std::move(next_),
               TrailWalk({PairChild::branch, 0}, length_, bits_.places()),
               {length_, ref::no_triangle}};
        ray.any = random_() % 4 == 0;
        ++begun;
      }
      take_outputs();
    }
    return seen_;
  }

 private:
  Seen wrong(const std::string& what) {
    if (seen_.wrong.empty()) seen_.wrong = what + " in cycle " + std::to_string(cycle_);
    return seen_;
  }
  void offer(std::size_t ray) {
    if (!next_) {
      next_ = std::make_unique<Placed>(grower_.tree(), random_);
      length_ = random_() % 2 == 0 ? grower_.within(0, 1'000'000) : 2'000'000;
    }
    in_["starts"] = 1;
    in_["start_ray"] = ray;
    in_["start_cut"] = static_cast<Word>(length_);
  }

  void give_answers() {
    bool reads = false, tests = false, leaf = false;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      InFlight& ray = rays_[i];
      if (!ray.waits) continue;
      if (ray.walk->at_leaf()) {
        if (leaf || cycle_ < ray.tested_at) continue;
        leaf = true;
        answer_leaf(i, ray);
      } else {
        if (!reads && ray.read_at != 0 && cycle_ >= ray.read_at) {
          reads = true;
          ray.read_at = 0;
          read(i, ray);
        }
        if (tests || ray.read_at != 0 || cycle_ < ray.tested_at) continue;
        tests = true;
        answer_record(i, ray);
      }
    }
  }
  void read(std::size_t i, const InFlight& ray) {
    const Placed& placed = *ray.placed;
    const std::size_t box = placed.box_at(ray.walk->at().first);
    in_["begins"] = 1;
    in_["test_ray"] = i;
    in_["block"] = placed.pointers[box];
    const auto count = [&](int child) -> Word {
      if (child < 0) return 0;
      const std::int32_t own = placed.counts[static_cast<std::size_t>(child)];
      return own == PairChild::branch ? record_count : static_cast<Word>(own);
    };
    in_["count_0"] = count(placed.tree.boxes[box].children[0]);
    in_["count_1"] = count(placed.tree.boxes[box].children[1]);
  }
  void answer_record(std::size_t i, InFlight& ray) {
    const Placed& placed = *ray.placed;
    const RandomTree::Box& box = placed.tree.boxes[placed.box_at(ray.walk->at().first)];
    ref::PairAnswer answer;
    std::array<PairChild, 2> children;
    std::array<std::int64_t, 2> near{};
    in_["tested"] = 1;
    in_["tester"] = i;
    for (std::size_t c = 0; c < 2; ++c) {
      const std::string which = c == 0 ? "0" : "1";
      // A unit may say anything of a child that is not there.
      if (box.children[c] < 0) {
        in_["hit_" + which] = random_() % 2;
        continue;
      }
      const auto child = static_cast<std::size_t>(box.children[c]);
      children[c] = placed.child(child);
      near[c] = placed.tree.boxes[child].near;
      const std::int64_t far = std::min(placed.tree.boxes[child].far, ray.walk->interval().far);
      answer.hit[c] = near[c] <= far;
      answer.interval[c] = {near[c], far};
      in_["hit_" + which] = answer.hit[c] ? 1 : 0;
      in_["near_" + which] = static_cast<Word>(near[c]) & hls::low_mask(bits_.box);
      in_["far_" + which] = static_cast<Word>(far) & hls::low_mask(bits_.box);
    }
    answer.second_first = near[1] < near[0] || (near[1] == near[0] && box.ties_second);
    in_["second_first"] = answer.second_first ? 1 : 0;
    ray.walk->answer(answer, children);
    ray.waits = false;
  }
  void answer_leaf(std::size_t i, InFlight& ray) {
    for (const ref::TreeHit& hit : ray.placed->tree.boxes[ray.placed->box_at(ray.walk->at().first)].hits)
      ray.best = std::min(ray.best, hit);
    in_["returns"] = 1;
    in_["return_ray"] = i;
    in_["return_cut"] = static_cast<Word>(ray.best.first);
    ray.waits = false;
    if (ray.any && ray.best.second != ref::no_triangle) {
      in_["return_stops"] = 1;
      stopped_.push_back(i);
      return;
    }
    ray.walk->leaf_done(ray.best.first);
  }

  void take_outputs() {
    const bool goes = out_["goes"] != 0, ended = out_["ended"] != 0;
    if (!goes && !ended) return;
    const auto i = static_cast<std::size_t>(out_["walk_ray"]);
    InFlight& ray = rays_[i];
    if ((goes && ended) || !ray.walk || ray.waits) return void(wrong("an answer that nobody waits for"));
    const auto stopped = std::find(stopped_.begin(), stopped_.end(), i);
    if (ended) {
      if (out_["failed"] != 0) return void(wrong("a walk that failed"));
      if (stopped == stopped_.end() && !ray.walk->done()) return void(wrong("a walk that ends too early"));
      if (stopped != stopped_.end()) stopped_.erase(stopped);
      if (!ray.any && ray.best != ref::search(ray.placed->tree, ray.walk ? first_length(ray) : 0))
        return void(wrong("another hit"));
      seen_.records += ray.walk->counts().records;
      seen_.restarts += ray.walk->counts().restarts;
      ++seen_.ended;
      ray = {};
      return;
    }
    if (stopped != stopped_.end() || ray.walk->done()) return void(wrong("a walk that goes on"));
    const PairChild& at = ray.walk->at();
    const Word count = ray.walk->at_leaf() ? static_cast<Word>(at.count) : record_count;
    if (out_["wanted"] != at.first || out_["triangles"] != count) return void(wrong("another block"));
    if (out_["enters_at"] != static_cast<Word>(ray.walk->interval().near) ||
        out_["leaves_at"] != static_cast<Word>(ray.walk->interval().far))
      return void(wrong("another interval"));
    ray.waits = true;
    ray.read_at = cycle_ + 1 + random_() % 20;
    ray.tested_at = cycle_ + 1 + random_() % 30;
  }
  /// A search needs the length with which the ray began; a best hit is never farther.
  static std::int64_t first_length(const InFlight& ray) {
    return ray.best.second == ref::no_triangle ? ray.best.first : std::int64_t{1} << 40;
  }

  hls::WalkBits bits_;
  rtl::NativeMachine& machine_;
  rtl::MachineGraph graph_;
  Ports in_, out_;
  ref::TreeGrower grower_;
  std::mt19937_64 random_;
  std::vector<InFlight> rays_;
  std::vector<std::size_t> stopped_;
  std::unique_ptr<Placed> next_;
  std::int64_t length_ = 0;
  std::uint64_t cycle_ = 0;
  Seen seen_;
};

const hls::WalkBits usual{21, 24, 60, 3, 5};  ///< the trees' distances have 21 bits

class WalkerWith : public testing::TestWithParam<hls::WalkBits> {};

TEST_P(WalkerWith, WalksAsSoftwareDoes) {
  const auto machine = rtl::machine_called("walker")->native(GetParam());
  const Seen seen = Driver(GetParam(), *machine, 5).run(20'000, 4'000'000);
  EXPECT_EQ(seen.wrong, "");
  EXPECT_EQ(seen.ended, 20'000);
  EXPECT_GT(seen.restarts, GetParam().stack == 1 ? 1'000U : 0U);
}

INSTANTIATE_TEST_SUITE_P(Formats, WalkerWith,
                         testing::Values(usual, hls::WalkBits{21, 24, 60, 1, 1},
                                         hls::WalkBits{24, 20, 12, 2, 6}),
                         [](const auto& each) { return Format(each.param).identifier(); });

TEST(WalkerInVerilog, WalksAsSoftwareDoes) {
  VerilatedMachine machine(*rtl::machine_called("walker"), usual);
  const Seen seen = Driver(usual, machine, 6).run(5'000, 1'000'000);
  EXPECT_EQ(seen.wrong, "");
  EXPECT_EQ(seen.ended, 5'000);
}

/// A record that leads to itself: by how many tests the walk ends, and whether it says so.
struct Loop {
  int records = 0;
  bool failed = false;
};
Loop walk_in_a_loop(const hls::WalkBits& bits, Word most_steps) {
  const auto machine = rtl::machine_called("walker")->native(bits);
  const rtl::MachineGraph graph = rtl::machine_called("walker")->graph(bits);
  Ports in(graph.inputs), out(graph.outputs);
  Loop loop;
  bool answers = false;
  for (int cycle = 0; cycle < 10'000; ++cycle) {
    in.clear();
    in["most_steps"] = most_steps;
    in["starts"] = cycle == 1 ? 1 : 0;
    in["start_cut"] = 5;
    if (answers) {
      for (const char* name : {"begins", "tested", "hit_0", "hit_1"}) in[name] = 1;
      in["count_0"] = record_count;
      in["count_1"] = 1;
      in["far_0"] = in["far_1"] = 5;
    }
    machine->outputs(out.data());
    machine->step(in.data(), cycle == 0);
    answers = cycle > 0 && out["goes"] != 0;
    if (answers) ++loop.records;
    if (cycle == 0 || out["ended"] == 0) continue;
    loop.failed = out["failed"] != 0;
    return loop;
  }
  ADD_FAILURE() << "the walk does not end";
  return loop;
}

TEST(WalkInALoop, EndsAtABound) {
  for (const int most : {1, 2, 17}) {
    const Loop loop = walk_in_a_loop(usual, static_cast<Word>(most));
    EXPECT_EQ(loop.records, most);
    EXPECT_TRUE(loop.failed);
  }
  for (const int levels : {2, 12, 60}) {
    const Loop loop = walk_in_a_loop({21, 24, levels, 3, 2}, 1000);
    EXPECT_EQ(loop.records, levels) << "the path has no more records";
    EXPECT_TRUE(loop.failed);
  }
}

/// A change of the Verilog, and what it does.
struct Fault {
  const char *good, *bad;
};
class WalkerFault : public testing::TestWithParam<Fault> {};

TEST_P(WalkerFault, IsSeen) {
  const hls::WalkBits bits{21, 24, 60, 1, 2};
  const rtl::MachineGraph graph = rtl::machine_called("walker")->graph(bits);
  const std::string verilog = rtl::to_verilog(graph, {.module = "walker", .bits = "", .shows_state = true});
  VerilatedMachine changed(graph, "walker", rtl::replaced(verilog, GetParam().good, GetParam().bad));
  EXPECT_NE(Driver(bits, changed, 7).run(3'000, 500'000).wrong, "");
}

INSTANTIATE_TEST_SUITE_P(Verilog, WalkerFault,
                         testing::Values(
                             // The walk ends with the top level, or where the stack has dropped a child.
                             Fault{"pops & sum[60]", "pops & sum[59]"},
                             Fault{"pops & sum[60]", "pops & (sum[60] | walks_word[22:21] == 2'd0)"},
                             // After a restart it forgets which child is done.
                             Fault{" ^ ~walker_eq", " ^ 1'b0"},
                             // A level of which no child is met is taken up again.
                             Fault{"marked_and = pair_1 & ~both", "marked_and = 1'b0"},
                             // A full stack drops its newest place.
                             Fault{"walks_word[20] + pushes", "walks_word[20] + next_used_2_value_and"},
                             // An answer is another ray's.
                             Fault{"ray_3 <= ray_2", "ray_3 <= ray_1"}));

}  // namespace
}  // namespace hitpipe::sim::walks_test
