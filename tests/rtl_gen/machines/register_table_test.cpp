// The machine `registers` does with each bit what its table says.
#include "hls/machines/register_table.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/rtl_gen/machines/named_ports.hpp"

namespace hitpipe::rtl::register_table_test {
namespace {

using hls::registers::Access;
using hls::registers::Fit;
using hls::registers::Register;
using hls::registers::RegisterField;
using hls::registers::SoftReset;
using hls::registers::table;

class RegisterTable : public testing::TestWithParam<hls::RegisterBits> {
 protected:
  void SetUp() override {
    registers_.in["bready"] = registers_.in["rready"] = 1;
    for (const auto& [port, name] : {std::pair("about_format", "FORMAT"), std::pair("about_shape", "SHAPE"),
                                     std::pair("about_ports", "PORTS"), std::pair("about_limits", "LIMITS")})
      registers_.in[port] = bits(hls::registers::called(name), Access::constant);
    cycle();
  }

  void write(int place, std::uint64_t word) {
    registers_.in["awaddr"] = static_cast<Word>(4 * place);
    registers_.in["wdata"] = word;
    registers_.in["wstrb"] = 15;
    registers_.in["awvalid"] = registers_.in["wvalid"] = 1;
    cycle();
    registers_.in["awvalid"] = registers_.in["wvalid"] = 0;
    for (int i = 0; i < 2; ++i) cycle();
  }
  std::uint64_t read(int place) {
    registers_.in["araddr"] = static_cast<Word>(4 * place);
    registers_.in["arvalid"] = 1;
    cycle();
    registers_.in["arvalid"] = 0;
    cycle();
    const auto word = static_cast<std::uint64_t>(registers_.out["rdata"]);
    cycle();
    return word;
  }
  void cycle() {
    registers_.step();
    registers_.give();
  }

  /// Of a register that the format has: the bits with that access, over both words of a counter.
  [[nodiscard]] std::uint64_t bits(const Register& each, Access access) const {
    std::uint64_t made = 0;
    for (const RegisterField& field : each.fields)
      if (field.access == access && has(GetParam(), field.feature) && field.width(GetParam()) > 0)
        made |= hls::low_mask(field.width(GetParam())) << field.low;
    return made;
  }
  [[nodiscard]] std::uint64_t reset(const Register& each) const {
    std::uint64_t made = 0;
    for (const RegisterField& field : each.fields) made |= field.reset << field.low;
    return made;
  }

  /// Each answer fails by another reason, a block has an error, and so have the rings.
  void fail_in_all_ways() {
    for (Word why = 1; why <= 5; ++why) {
      registers_.in["ray_valid"] = registers_.in["ray_ready"] = 1;
      cycle();
      registers_.in["ray_valid"] = 0;
      registers_.in["hit_valid"] = registers_.in["hit_ready"] = 1;
      registers_.in["hit_failed"] = why;
      cycle();
      registers_.in["hit_valid"] = 0;
    }
    registers_.in["request_valid"] = registers_.in["request_ready"] = 1;
    cycle();
    registers_.in["request_valid"] = 0;
    registers_.in["read_valid"] = registers_.in["read_error"] = 1;
    if (GetParam().rings) registers_.in["ring_flaws"] = 7;
    cycle();
    registers_.in["read_valid"] = 0;
    if (GetParam().rings) registers_.in["ring_flaws"] = 0;
  }

  NamedMachine registers_{"registers", GetParam()};
};

TEST_P(RegisterTable, SaysWhatEachWordIsAfterAReset) {
  for (const Register& each : table) {
    if (!has(GetParam(), each.feature) || each.is_counter()) continue;
    const std::uint64_t constants = bits(each, Access::constant);
    EXPECT_EQ(read(each.place), reset(each) != 0 ? reset(each) : constants) << each.name;
  }
}

TEST_P(RegisterTable, SaysWhichBitsSoftwareWrites) {
  std::vector<bool> known(std::size_t{1} << hls::registers::word_place_bits, false);
  for (const Register& each : table) {
    if (!has(GetParam(), each.feature)) continue;
    for (int word = 0; word < each.words; ++word) known[static_cast<std::size_t>(each.place + word)] = true;
    // Ones in the control begin a soft reset, and a counter counts.
    if (each.is_counter() || each.name == "CONTROL") continue;
    const std::uint64_t written = bits(each, Access::read_write);
    write(each.place, 0xffffffff);
    const std::uint64_t ones = read(each.place);
    write(each.place, 0);
    const std::uint64_t zeros = read(each.place);
    const std::uint64_t kept = each.fit == Fit::from_one ? 1 : 0;
    EXPECT_EQ(ones ^ zeros, written & ~kept) << each.name;
    EXPECT_EQ(zeros & written, kept) << each.name;
  }
  for (std::size_t place = 0; place < known.size(); ++place) {
    if (known[place]) continue;
    write(static_cast<int>(place), 0xffffffff);
    EXPECT_EQ(read(static_cast<int>(place)), 0U) << place;
  }
}

TEST_P(RegisterTable, SaysWhatBecomesOfANumberThatHasTooManyBits) {
  for (const Register& each : table) {
    const std::uint64_t kept = bits(each, Access::read_write);
    const std::uint64_t others = ~kept & 0xffffffff;
    if (!has(GetParam(), each.feature) || kept == 0 || others == 0) continue;
    write(each.place, others);
    EXPECT_EQ(read(each.place), each.fit == Fit::cut ? 0 : kept) << each.name;
  }
}

TEST_P(RegisterTable, SaysWhichBitsOfTheStatusStay) {
  const Register& status = hls::registers::called("STATUS");
  const int place = status.place;
  const std::uint64_t sticky = bits(status, Access::clear);
  fail_in_all_ways();
  write(hls::registers::at<"BASE_LOW">, 1);
  EXPECT_EQ(read(place), sticky | 1U) << "idle";
  write(place, sticky & 0xaaaaaaaa);
  EXPECT_EQ(read(place), (sticky & 0x55555555) | 1U);
  write(place, 0xffffffff);
  EXPECT_EQ(read(place), 1U);
}

TEST_P(RegisterTable, SaysWhatASoftResetClears) {
  const auto expect_cleared = [&](auto is_cleared, const char* when) {
    for (const Register& each : table) {
      const std::uint64_t written = bits(each, Access::read_write);
      if (!has(GetParam(), each.feature) || written == 0) continue;
      EXPECT_EQ(read(each.place), is_cleared(each.fields.front().soft_reset) ? 0U : written & 3)
          << each.name << when;
    }
  };
  for (const Register& each : table)
    if (has(GetParam(), each.feature) && bits(each, Access::read_write) != 0) write(each.place, 3);
  // It lasts as long as a block is on its way.
  registers_.in["request_valid"] = registers_.in["request_ready"] = 1;
  cycle();
  registers_.in["request_valid"] = 0;
  if (GetParam().rings) registers_.in["ring_quiet"] = 1;
  write(hls::registers::at<"CONTROL">, 1);
  expect_cleared([](SoftReset each) { return each == SoftReset::holds; }, " in a soft reset");
  write(hls::registers::at<"MOST_RAYS">, 3);
  expect_cleared([](SoftReset each) { return each == SoftReset::holds; }, " written in a soft reset");
  registers_.in["read_valid"] = 1;
  cycle();
  registers_.in["read_valid"] = 0;
  for (int i = 0; i < 5; ++i) cycle();
  expect_cleared([](SoftReset each) { return each != SoftReset::keeps; }, " behind a soft reset");
}

TEST_P(RegisterTable, SaysWhatAWriteToCountersClears) {
  for (int i = 0; i < 100; ++i) cycle();
  EXPECT_GE(read(hls::registers::at<"CYCLES">), 100U);
  write(hls::registers::at<"CLEAR_COUNTERS">, 0);
  EXPECT_LT(read(hls::registers::at<"CYCLES">), 10U);
}

TEST_P(RegisterTable, SaysHowManyBitsCountersHave) {
  for (const char* const event : {"ray_valid", "ray_ready", "hit_valid", "hit_ready"})
    registers_.in[event] = 1;
  // As many answers as a counter of 10 bits has numbers, and 5.
  for (int i = 0; i < 1024 + 5; ++i) cycle();
  for (const char* const event : {"ray_valid", "hit_valid"}) registers_.in[event] = 0;
  const std::uint64_t mask = bits(hls::registers::called("ANSWERS"), Access::read);
  EXPECT_EQ(read(hls::registers::at<"ANSWERS">), 1029U & mask);
}

INSTANTIATE_TEST_SUITE_P(Formats, RegisterTable,
                         testing::Values(hls::RegisterBits{24, 32, 5, 40}, hls::RegisterBits{4, 9, 1, 10},
                                         hls::RegisterBits{32, 64, 8, 34, 1, 0},
                                         hls::RegisterBits{20, 40, 6, 36, 0, 1},
                                         hls::RegisterBits{20, 33, 6, 10, 1, 1}),
                         [](const auto& each) {
                           const hls::RegisterBits& bits = each.param;
                           return "h" + std::to_string(bits.bytes) + (bits.cache ? "k1" : "") +
                                  (bits.rings ? "r1" : "");
                         });

}  // namespace
}  // namespace hitpipe::rtl::register_table_test
