// Pieces have each part once, in order, and are as equal as they can be.
#include "host/piece.hpp"

#include <gtest/gtest.h>

namespace hitpipe::host::piece_test {
namespace {

TEST(Piece, AllPiecesHaveEachPartOnce) {
  for (std::uint64_t parts = 0; parts <= 40; ++parts) {
    for (std::uint64_t of = 1; of <= 45; ++of) {
      std::uint64_t next = 0;
      for (std::uint64_t number = 1; number <= of; ++number) {
        const Piece::Range range = Piece{number, of}.range(parts);
        ASSERT_EQ(range.first, next) << number << "/" << of << " of " << parts;
        ASSERT_GE(range.size(), parts / of);
        ASSERT_LE(range.size(), (parts + of - 1) / of);
        next = range.end;
      }
      ASSERT_EQ(next, parts) << of;
    }
  }
}

TEST(Piece, TheLargestWorkFits) {
  const std::uint64_t parts = 10'000'000'000'000U;
  const Piece::Range last = Piece{Piece::most - 1, Piece::most}.range(parts);
  EXPECT_EQ(last.first, parts / Piece::most * (Piece::most - 2));
  EXPECT_EQ(last.size(), parts / Piece::most);
  EXPECT_EQ((Piece{Piece::most, Piece::most}.range(parts).end), parts);
}

}  // namespace
}  // namespace hitpipe::host::piece_test
