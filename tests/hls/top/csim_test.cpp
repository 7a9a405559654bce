// The replay of vectors through a top function, on one with two results.
#include "hls/top/csim.hpp"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "host/files.hpp"

namespace hitpipe::hls::csim_test {
namespace {

/// The lower plane as a distance, and whether the higher one lies ahead.
void depth(top::Integer<12> low, top::Integer<12> high, top::Integer<12>& entry, top::Bit& hit) {
  entry = low;
  hit = high >= 0;
}
void depth_hit_alone(top::Integer<12> /*low*/, top::Integer<12> high, top::Integer<12>& /*entry*/,
                     top::Bit& hit) {
  hit = high >= 0;
}
void depth_one_bit_wrong(top::Integer<12> low, top::Integer<12> high, top::Integer<12>& entry,
                         top::Bit& hit) {
  depth(low, high, entry, hit);
  entry = low ^ top::Integer<12>(low == 5 ? 1 : 0);
}

class Csim : public testing::Test {
 protected:
  int replay(const std::string& text,
             void (*top)(top::Integer<12>, top::Integer<12>, top::Integer<12>&, top::Bit&)) {
    const std::string file = (folder_.path() / "vectors.hex").string();
    std::ofstream(file) << text;
    std::string program = "csim", name = file;
    char* arguments[] = {program.data(), name.data()};
    testing::internal::CaptureStdout();
    const int code = top::csim(2, arguments, "nothing.hex", top);
    printed_ = testing::internal::GetCapturedStdout();
    return code;
  }
  /// A vector of `depth` as a line: 37 bits in ten digits.
  static std::string line(int low, int high, int entry, int hit) {
    const auto bits = [](int number) { return static_cast<std::uint64_t>(number) & 0xfff; };
    const std::uint64_t vector =
        bits(low) << 25 | bits(high) << 13 | bits(entry) << 1 | static_cast<std::uint64_t>(hit);
    char digits[16];
    std::snprintf(digits, sizeof digits, "%010llx\n", static_cast<unsigned long long>(vector));
    return digits;
  }

  const std::string right_ = "// low, high, entry, hit\n" + line(5, 3, 5, 1) + "\n" + line(-1, -5, -1, 0) +
                             line(-2048, 2047, -2048, 1);
  host::ScratchFolder folder_;
  std::string printed_;
};

TEST_F(Csim, AcceptsRightResults) {
  EXPECT_EQ(replay(right_, depth), 0);
  EXPECT_NE(printed_.find("vectors.hex: 3 vectors, 0 mismatches\n"), std::string::npos) << printed_;
}

TEST_F(Csim, FindsAResultThatIsNotWritten) {
  EXPECT_EQ(replay(right_, depth_hit_alone), 1);
  EXPECT_NE(printed_.find("3 vectors, 3 mismatches\n"), std::string::npos) << printed_;
}

TEST_F(Csim, FindsOneWrongBitAndPrintsIt) {
  EXPECT_EQ(replay(right_, depth_one_bit_wrong), 1);
  EXPECT_NE(printed_.find("vector 0: a result is 4, expected 5\n"), std::string::npos) << printed_;
  EXPECT_NE(printed_.find("3 vectors, 1 mismatches\n"), std::string::npos) << printed_;
}

TEST_F(Csim, RefusesFilesThatAreNoVectors) {
  EXPECT_EQ(replay("", depth), 2);
  EXPECT_NE(printed_.find("there are no vectors, or no such file\n"), std::string::npos) << printed_;
  EXPECT_EQ(replay(right_ + "0123456789a\n", depth), 2);
  EXPECT_NE(printed_.find("line 6: not a vector of 37 bits in 10 hexadecimal digits\n"), std::string::npos)
      << printed_;
  EXPECT_EQ(replay("000000000g\n", depth), 2);
  char program[] = "csim";
  char* arguments[] = {program};
  EXPECT_EQ(top::csim(1, arguments, "/nowhere/vectors.hex", depth), 2);
}

}  // namespace
}  // namespace hitpipe::hls::csim_test
