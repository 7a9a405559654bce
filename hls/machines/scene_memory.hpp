// An image in a memory of the chip (docs/chips.md): one port of 64 bits reads blocks for a core, and takes
// the image's words from outside. A word from outside waits until a block that is being read is whole.
#pragma once

#include "hls/box/format.hpp"
#include "hls/machines/channels.hpp"
#include "hls/machines/memory.hpp"

namespace hitpipe::hls {

/// The format "aAiI", for example a12i1.
struct SceneMemoryBits {
  int address = 12;  ///< A: bits of a block's number: the memory has 2^A blocks
  int ray = 1;       ///< I: bits of a ray's number

  static constexpr FormatField fields[] = {{"a", "A", 4, 16}, {"i", "I", 1, 8}};

  constexpr int words() const { return 4 * power_of_two(address); }
  constexpr int place() const { return address + 2; }
  constexpr int bytes() const { return address + 5; }
  friend constexpr bool operator==(const SceneMemoryBits&, const SceneMemoryBits&) = default;
};

namespace scene_memory {

using namespace channels;

constexpr Data<"word_valid"> word_valid;  // a word of the image, which stays until it is taken
constexpr Data<"word_place", &SceneMemoryBits::place> word_place;
constexpr Data<"word", 64> word;
constexpr Data<"word_ready"> word_ready;
constexpr Control<"count", 2> count;   // words of the block that have been asked for
constexpr Control<"there_1"> there_1;  // a whole block; its last word is the memory's
struct FirstWords : List<read_id, read_word_0, read_word_1, read_word_2> {};

constexpr Single<"blocks", &SceneMemoryBits::words, 64> blocks;

struct SceneMemory {
  static constexpr const char* name = "scene_memory";
  static constexpr const char* summary = "reads blocks of an image that is in a memory of the chip";
  using Bits = SceneMemoryBits;
  using BuiltIn = FormatList<Fixed<SceneMemoryBits{12, 1}>>;
  struct In : Join<Request, List<word_valid, word_place, word>> {};
  struct Out : Join<Request::Back, List<word_ready>, BlockRead> {};
  struct State : Join<List<count, there_1>, Held<FirstWords>> {};
  struct Memory : List<blocks> {};

  template <class D>
  static constexpr void outputs(const auto& /*f*/, const auto& now, const auto& memory, const auto& out) {
    // The core holds its request while the words are read, so its address needs no register here.
    out[request_ready] = is<D>(now[count], 3);
    out[word_ready] = is<D>(now[count], 0);
    out[read_valid] = now[there_1];
    out.from_held(now, FirstWords());
    out[read_word_3] = memory[blocks].word();
    out[read_error] = D::lit(0, 1_w);
  }

  template <class D>
  static constexpr void step(const auto& f, const auto& now, const auto& in, const auto& memory,
                             const auto& next) {
    using Bit = typename D::bit;
    const Bit writes = as("writes", in[word_valid] & as("free", is<D>(now[count], 0)));
    const Bit reads = as("reads", in[request_valid] & ~writes);
    const auto block = slice(in[request_address], request_address.width(f) - 1_w, 5_w);
    const auto place = as("place", select(writes, in[word_place], cat(block, now[count])));
    memory[blocks].access(writes, place, in[word]);
    // The words of a block come in above, one after the other, and those before move down.
    next[held<read_word_0>] = now[held<read_word_1>];
    next[held<read_word_1>] = now[held<read_word_2>];
    next[held<read_word_2>] = memory[blocks].word();
    next[held<read_id>] = in[request_id];
    next[there_1] = as("last_word", reads & is<D>(now[count], 3));
    next[count] = plus(now[count], reads);
  }
};

}  // namespace scene_memory

using scene_memory::SceneMemory;

}  // namespace hitpipe::hls
