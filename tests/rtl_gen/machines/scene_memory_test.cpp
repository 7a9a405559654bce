// A memory of an image with traffic of every kind: what is written is what a block that was asked for has,
// with the identifier of who asked, and nothing waits longer than it must.
#include "hls/machines/scene_memory.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/machine/module.hpp"
#include "tests/rtl_gen/machines/named_ports.hpp"
#include "tests/rtl_gen/text.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::scene_memory_test {
namespace {

constexpr hls::SceneMemoryBits bits{5, 3};

class Traffic {
 public:
  explicit Traffic(unsigned seed)
      : machine_("scene_memory", bits), random_(seed), words_(static_cast<std::size_t>(bits.words()), 0) {}

  /// One cycle, with these shares of 8: a request begins, a word begins.
  void cycle(int asks, int writes) {
    machine_.give();
    look_at_block();
    machine_.in.scramble(random_);
    if (!request_ && random_.below(8) < asks)
      request_ = {random_.bits() & ones_below(bits.ray + 1), random_.bits() & ones_below(bits.address)};
    if (!word_ && random_.below(8) < writes)
      word_ = {random_.bits() & ones_below(bits.address + 2), random_.bits() & ones_below(64)};
    machine_.in["request_valid"] = request_ ? 1 : 0;
    machine_.in["word_valid"] = word_ ? 1 : 0;
    if (request_) {
      machine_.in["request_id"] = request_->id;
      machine_.in["request_address"] = request_->block << 5U | (random_.bits() & ones_below(5));
    }
    if (word_) {
      machine_.in["word_place"] = word_->place;
      machine_.in["word"] = word_->word;
      ++waited_;
    }
    if (request_ && machine_.out["request_ready"] != 0) {
      expected_ = request_;
      request_.reset();
    }
    if (word_ && machine_.out["word_ready"] != 0) {
      words_[static_cast<std::size_t>(word_->place)] = word_->word;
      word_.reset();
      ASSERT_LE(waited_, 4);
      waited_ = 0;
      ++written_;
    }
    machine_.step();
  }

  [[nodiscard]] int blocks() const { return blocks_; }
  [[nodiscard]] int written() const { return written_; }

 private:
  struct Request {
    Word id, block;
  };
  struct Written {
    Word place, word;
  };

  /// It comes one cycle after its request was taken.
  void look_at_block() {
    ASSERT_EQ(machine_.out["read_valid"] != 0, expected_.has_value()) << "block " << blocks_;
    if (!expected_) return;
    ASSERT_EQ(machine_.out["read_id"], expected_->id) << "block " << blocks_;
    for (std::size_t i = 0; i < 4; ++i)
      ASSERT_EQ(machine_.out[fmt::format("read_word_{}", i)],
                words_[4 * static_cast<std::size_t>(expected_->block) + i])
          << "block " << blocks_;
    expected_.reset();
    ++blocks_;
  }

  NamedMachine machine_;
  Seeded random_;
  std::vector<Word> words_;
  std::optional<Request> request_, expected_;
  std::optional<Written> word_;
  int waited_ = 0, blocks_ = 0, written_ = 0;
};

TEST(SceneMemory, GivesWhatWasWritten) {
  for (const int asks : {1, 4, 8}) {
    for (const int writes : {1, 4, 8}) {
      SCOPED_TRACE(fmt::format("{} {}", asks, writes));
      Traffic traffic(static_cast<unsigned>(100 * asks + writes));
      for (int i = 0; i < 20'000 && !testing::Test::HasFatalFailure(); ++i) traffic.cycle(asks, writes);
      EXPECT_GT(traffic.written(), 1000);
      // A word that always waits leaves no cycle to begin a block.
      if (writes < 8) {
        EXPECT_GT(traffic.blocks(), 500);
      }
    }
  }
}

TEST(SceneMemory, BlockTakesFourCycles) {
  Traffic traffic(5);
  for (int i = 0; i < 4001; ++i) traffic.cycle(8, 0);
  EXPECT_EQ(traffic.blocks(), 1000);
}

/// All of the single-port memory of an iCE40 UP5K, and no block RAM.
TEST(SceneMemory, IsTheLargeMemoryOfAChip) {
  const Format format = hls::SceneMemoryBits{};
  const ScratchFolder folder;
  write_text(folder / "memory.v",
             to_verilog(machine_called("scene_memory")->graph(format), {.module = "memory"}));
  expect_silence(folder.path(), "yosys",
                 "-q -p 'read_verilog memory.v; synth_ice40 -device u -top memory; "
                 "select -assert-count 4 t:SB_SPRAM256KA; select -assert-none t:SB_RAM40_4K'");
}

}  // namespace
}  // namespace hitpipe::rtl::scene_memory_test
