// One ray's walk through records of two boxes with a short stack and a restart trail (Laine, "Restart Trail
// for Stackless BVH Traversal", 2010). A stack of a few entries forgets its oldest entry when it is full. The
// trail, one bit a level, knows what is done, so the walk then begins again at the root and goes straight to
// where it was. A walk with any number of places finds what one with a whole stack finds.
//
// It pauses at each record and each leaf. Two things make it right, and the caller owes both: the boxes of
// leaves contain their triangles whole, and the order of two children does not depend on the ray's length.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <deque>
#include <utility>

#include "rays/trace/walk.hpp"
#include "rays/world/pair_nodes.hpp"

namespace hitpipe::ref {

class TrailWalk {
 public:
  /// Levels of records: the root's own record is level 0.
  static constexpr int levels = 60;

  struct Counts {
    std::uint64_t records = 0;  ///< that were tested, again after a restart
    std::uint64_t leaves = 0;
    std::uint64_t restarts = 0;
  };

  /// `root` names the root's own record, which is tested first. `cut` is the ray's length in units of box
  /// distances. The stack has `places`, 0 or more.
  TrailWalk(const PairChild& root, std::int64_t cut, int places)
      : root_(root), at_(root), interval_{0, cut}, cut_(cut), places_(static_cast<std::size_t>(places)) {
    assert(root.count == PairChild::branch && places >= 0);
  }

  [[nodiscard]] bool done() const { return done_; }
  /// The hierarchy has more levels than the trail; the walk is over.
  [[nodiscard]] bool too_deep() const { return too_deep_; }
  [[nodiscard]] bool at_leaf() const { return at_.count != PairChild::branch; }
  /// The record or leaf that it waits for. Only while !done().
  [[nodiscard]] const PairChild& at() const { return at_; }
  /// Where the ray is within it, cut at its length.
  [[nodiscard]] const RayInterval& interval() const { return interval_; }
  [[nodiscard]] const Counts& counts() const { return counts_; }

  /// What the boxes of the record are to the ray. A child that is `none` is never met.
  void answer(const PairAnswer& answer, const std::array<PairChild, 2>& children) {
    ++counts_.records;
    std::array<Entry, 2> met;
    std::size_t hits = 0;
    for (std::size_t i = 0; i < 2; ++i)
      if (answer.hit[i] && children[i].count != PairChild::none)
        met[hits++] = {children[i], answer.interval[i], level_};
    if (hits == 2 && answer.second_first) std::swap(met[0], met[1]);
    const bool first_done = (trail_ & bit(level_)) != 0;
    if (hits == 2) {
      if (!first_done) push(met[1]);
      go_to(met[first_done ? 1 : 0]);
      return;
    }
    // One child where a level is taken up again: it is the first, which is done.
    if (hits == 1 && level_ != pop_level_) {
      trail_ |= bit(level_);
      go_to(met[0]);
      return;
    }
    trail_ |= bit(level_);
    pop();
  }

  /// Its triangles have been tested; `cut` is the ray's length now, which may be shorter.
  void leaf_done(std::int64_t cut) {
    ++counts_.leaves;
    cut_ = cut;
    pop();
  }

 private:
  struct Entry {
    PairChild child;
    RayInterval interval;
    int level = 0;  ///< of the record that it is a child of
  };

  static std::uint64_t bit(int level) { return std::uint64_t{1} << (levels - 1 - level); }

  void push(const Entry& entry) {
    if (places_ == 0) return;
    if (stack_.size() == places_) stack_.pop_front();
    stack_.push_back(entry);
  }

  /// A record is one level deeper, a leaf is of its parent's level.
  void go_to(const Entry& entry) {
    at_ = entry.child;
    interval_ = {entry.interval.near, std::min(entry.interval.far, cut_)};
    level_ = entry.level + (at_leaf() ? 0 : 1);
    if (level_ == levels) done_ = too_deep_ = true;
  }

  /// To the deepest level at or above this one whose second child may wait.
  void pop() {
    while (true) {
      trail_ += bit(level_);
      if (trail_ >> levels != 0) {
        done_ = true;
        return;
      }
      pop_level_ = levels - 1 - std::countr_zero(trail_);
      if (stack_.empty()) {
        ++counts_.restarts;
        go_to({root_, {0, cut_}, -1});
        return;
      }
      const Entry waiting = stack_.back();
      stack_.pop_back();
      assert(waiting.level == pop_level_);
      if (waiting.interval.near <= cut_) {
        go_to(waiting);
        return;
      }
      level_ = waiting.level;
    }
  }

  PairChild root_, at_;
  RayInterval interval_;
  std::int64_t cut_;
  std::size_t places_;
  std::uint64_t trail_ = 0;  ///< a level's bit is 1 if no child of it waits
  int level_ = 0;            ///< of the record, or of the leaf's parent
  int pop_level_ = -1;
  std::deque<Entry> stack_;
  Counts counts_;
  bool done_ = false;
  bool too_deep_ = false;
};

}  // namespace hitpipe::ref
