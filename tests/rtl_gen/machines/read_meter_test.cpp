// The meter with reads of every length: its counts are those of a list of the reads in flight.
#include "hls/machines/read_meter.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "tests/rtl_gen/machines/named_ports.hpp"

namespace hitpipe::rtl::read_meter_test {
namespace {

class ReadMeterIn : public testing::TestWithParam<hls::MeterBits> {};

TEST_P(ReadMeterIn, AddsUpTheCyclesOfEachRead) {
  const hls::MeterBits bits = GetParam();
  NamedMachine meter("read_meter", bits);
  Seeded random(5);
  const int most_cycles = static_cast<int>(ones_below(bits.cycle));
  struct Read {
    int asked_in, comes_in;
  };
  std::map<Word, Read> flying;
  Word reads = 0, waited = 0, longest = 0;
  for (int cycle = 0; cycle < 30'000; ++cycle) {
    // What came in the last cycle but one stands in the outputs.
    meter.give();
    meter.in.scramble(random);
    const auto comes = std::find_if(flying.begin(), flying.end(),
                                    [&](const auto& read) { return read.second.comes_in == cycle; });
    meter.in["read_valid"] = comes != flying.end();
    Word latency = 0;
    if (comes != flying.end()) {
      meter.in["read_id"] = comes->first;
      latency = static_cast<Word>(cycle - comes->second.asked_in);
      flying.erase(comes);
    }
    const Word id = meter.in["request_id"];
    const int due = cycle + 1 + random.below(random.below(50) == 0 ? most_cycles : std::min(most_cycles, 40));
    const bool is_free = !flying.contains(id) && (latency == 0 || meter.in["read_id"] != id) &&
                         std::none_of(flying.begin(), flying.end(),
                                      [&](const auto& read) { return read.second.comes_in == due; });
    if (meter.in["request_valid"] != 0 && meter.in["request_ready"] != 0) {
      if (is_free)
        flying[id] = {cycle, due};
      else
        meter.in["request_ready"] = 0;
    }
    meter.step();
    meter.give();
    ASSERT_EQ(meter.out["reads"], reads & ones_below(bits.counter)) << "cycle " << cycle;
    ASSERT_EQ(meter.out["waited"], waited & ones_below(bits.counter)) << "cycle " << cycle;
    ASSERT_EQ(meter.out["longest"], longest) << "cycle " << cycle;
    if (latency == 0) continue;
    ++reads;
    waited += latency;
    longest = std::max(longest, latency);
  }
  EXPECT_GT(reads, 1'000U);
  EXPECT_GT(longest, ones_below(bits.cycle) / 2);
}

INSTANTIATE_TEST_SUITE_P(Formats, ReadMeterIn,
                         testing::Values(hls::MeterBits{5, 10, 40}, hls::MeterBits{1, 6, 12}));

}  // namespace
}  // namespace hitpipe::rtl::read_meter_test
