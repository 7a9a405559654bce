// Random trees, and how the C++ walks through them with a short stack, as the Coq file Walks.v: emit_walks COUNT
// CompareWalk.v compares them with the walk that the proofs are about.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sw_ref/trace/trail_walk.hpp"

namespace {

using namespace hitpipe::ref;
using Hit = std::pair<std::int64_t, std::int64_t>;  // T and the number of its triangle
using Hits = std::vector<Hit>;

struct Node {
  std::int64_t near, far;  // where the ray is in its box
  std::vector<Node> children;
  Hits hits;
  bool swapped = false;  // the second child is the nearer one
};

class Draw {
 public:
  std::int64_t integer(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(rng_);
  }
  bool one_in(int count) { return integer(1, count) == 1; }

  Node tree(int depth, std::int64_t near, std::int64_t far, int shift) {
    Node made{near, far, {}, {}};
    if (depth == 0 || one_in(12) || far - near < 2) {
      for (std::int64_t left = integer(0, 3); left > 0; --left)
        made.hits.emplace_back(integer(near << shift, ((far + 1) << shift) - 1), numbers_++);
      return made;
    }
    for (int i = 0; i < 2; ++i) {
      const std::int64_t begin = one_in(3) ? near : integer(near, (near + far) / 2);
      const std::int64_t end = one_in(3) ? far : integer((begin + far) / 2, far);
      made.children.push_back(one_in(5) ? Node{begin, begin - 1, {}, {}}
                                        : tree(depth - 1, begin, end, shift));
    }
    made.swapped = one_in(2);
    return made;
  }

 private:
  std::mt19937_64 rng_{1};
  std::int64_t numbers_ = 0;
};

struct Walked {
  std::vector<Hits> leaves;
  Hit best;
  bool restarts;
};

Walked walked(const Node& root, const Hit& limit, int places, int shift) {
  std::vector<const Node*> nodes{&root};
  const auto named = [&](const Node& node) -> PairChild {
    nodes.push_back(&node);
    return {node.children.empty() ? 1 : PairChild::branch, static_cast<std::uint32_t>(nodes.size() - 1)};
  };
  Walked made{{}, limit, false};
  TrailWalk walk({PairChild::branch, 0}, limit.first >> shift, places);
  while (!walk.done()) {
    const Node& at = *nodes[walk.at().first];
    if (walk.at_leaf()) {
      made.leaves.push_back(at.hits);
      for (const Hit& hit : at.hits) made.best = std::min(made.best, hit);
      walk.leaf_done(made.best.first >> shift);
      continue;
    }
    PairAnswer answer{.second_first = at.swapped};
    std::array<PairChild, 2> children;
    for (std::size_t i = 0; i < 2; ++i) {
      const Node& child = at.children[i];
      children[i] = named(child);
      answer.interval[i] = {child.near, child.far};
      answer.hit[i] = child.near <= std::min(child.far, walk.interval().far);
    }
    walk.answer(answer, children);
  }
  made.restarts = walk.counts().restarts > 0;
  return made;
}

std::string in_coq(const Hits& hits) {
  std::vector<std::string> all;
  for (const auto& [t, number] : hits) all.push_back(fmt::format("({}, {})", t, number));
  return fmt::format("[{}]", fmt::join(all, "; "));
}

std::string in_coq(const Node& node) {
  if (node.children.empty()) return fmt::format("(Leaf {})", in_coq(node.hits));
  const auto child = [](const Node& of) { return fmt::format("{} ({}) {}", of.near, of.far, in_coq(of)); };
  return fmt::format("(Node {} {})", child(node.children[node.swapped ? 1 : 0]),
                     child(node.children[node.swapped ? 0 : 1]));
}

std::string walk_case(Draw& draw) {
  const int shift = static_cast<int>(draw.integer(0, 3));
  const std::int64_t far = draw.one_in(3) ? 20 : draw.one_in(2) ? 300 : 1'000'000;
  Node root = draw.tree(static_cast<int>(draw.integer(1, 7)), 0, far, shift);
  while (root.children.empty()) root = draw.tree(5, 0, far, shift);
  const Hit limit{draw.one_in(3) ? draw.integer(0, far) : (far + 1) << shift, std::int64_t{1} << 32};
  const int places = static_cast<int>(draw.integer(0, 4));
  const Walked made = walked(root, limit, places, shift);
  std::vector<std::string> leaves;
  for (const Hits& hits : made.leaves) leaves.push_back(in_coq(hits));
  return fmt::format(
      "  {{| walked := {};\n     most_places := {}; shift := {}; limit := {};\n     in_turn := [{}];\n     "
      "least := {}; "
      "begins_again := {} |}}",
      in_coq(root), places, shift, fmt::format("({}, {})", limit.first, limit.second),
      fmt::join(leaves, "; "), fmt::format("({}, {})", made.best.first, made.best.second), made.restarts);
}

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 1;
  Draw draw;
  fmt::print(
      "From Coq Require Import ZArith List.\nFrom HitpipeMajor Require Import Walk CompareWalk.\n"
      "Import ListNotations.\nOpen Scope Z_scope.\n\nDefinition cases : list WalkCase := [\n");
  for (int i = 0; i < count; ++i) fmt::print("{}{}\n", walk_case(draw), i + 1 < count ? ";" : "].");
  fmt::print(
      "\nTheorem cases_agree : forallb walk_agrees cases = true.\nProof. vm_compute. reflexivity. Qed.\n\n"
      "Eval vm_compute in (List.length cases, List.length (filter begins_again cases)).\n");
}
