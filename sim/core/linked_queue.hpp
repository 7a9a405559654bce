// Queues whose entries are nodes of one pool, linked by their places in it: an entry moves from one queue to
// another in constant time, and nothing is allocated once the pool has its largest size.
#pragma once

#include <cstdint>
#include <vector>

namespace hitpipe::sim {

inline constexpr std::uint32_t no_place = 0xFFFF'FFFF;

/// A free node's `next` is the next free one.
template <class Node>
class NodePool {
 public:
  Node& operator[](std::uint32_t place) { return nodes_[place]; }
  const Node& operator[](std::uint32_t place) const { return nodes_[place]; }

  /// The place of `node` in the pool, which holds until it is given back. References do not: the pool grows.
  template <class... Members>
  std::uint32_t take(Members... members) {
    const std::uint32_t place = free_;
    if (place == no_place) {
      nodes_.push_back({members...});
      return static_cast<std::uint32_t>(nodes_.size() - 1);
    }
    free_ = nodes_[place].next;
    nodes_[place] = {members...};
    return place;
  }
  void give_back(std::uint32_t place) {
    nodes_[place].next = free_;
    free_ = place;
  }

 private:
  std::vector<Node> nodes_;
  std::uint32_t free_ = no_place;
};

/// First in, first out. A node can be in one queue for each of its members that link.
template <class Node, std::uint32_t Node::*link = &Node::next>
class LinkedQueue {
 public:
  [[nodiscard]] bool empty() const { return first_ == no_place; }
  /// no_place when it is empty.
  [[nodiscard]] std::uint32_t first() const { return first_; }

  void push(NodePool<Node>& pool, std::uint32_t place) {
    pool[place].*link = no_place;
    append(pool, place, place);
  }
  /// Takes the first entry out. It must not be empty.
  std::uint32_t pop(NodePool<Node>& pool) {
    const std::uint32_t place = first_;
    first_ = pool[place].*link;
    return place;
  }
  /// Takes all entries of another queue, behind its own.
  void take_all(NodePool<Node>& pool, LinkedQueue& other) {
    if (other.empty()) return;
    append(pool, other.first_, other.last_);
    other.first_ = no_place;
  }

 private:
  void append(NodePool<Node>& pool, std::uint32_t first, std::uint32_t last) {
    if (empty()) {
      first_ = first;
    } else {
      pool[last_].*link = first;
    }
    last_ = last;
  }

  std::uint32_t first_ = no_place;
  std::uint32_t last_ = no_place;  ///< says nothing while it is empty
};

}  // namespace hitpipe::sim
