// The registers of a core in SystemRDL: the file is of that language, and agrees with C header, manifest and
// Verilog.
#include "rtl_gen/core/system_rdl.hpp"

#include <map>
#include <regex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/core/c_header.hpp"
#include "rtl_gen/core/registers.hpp"
#include "tests/rtl_gen/core/system_rdl_reader.hpp"
#include "tests/rtl_gen/text.hpp"

namespace hitpipe::rtl::system_rdl_test {
namespace {

constexpr hls::RayBits bits{10, 2, 6, -1, 9, 2};

int bits_of(const RdlRegister& each) {
  const auto own = each.properties.find("regwidth");
  return own == each.properties.end() ? 32 : std::stoi(own->second);
}

/// As the manifest names it.
std::string access_of(const RdlField& field) {
  const auto is = [&](const char* property, const char* value) {
    const auto found = field.properties.find(property);
    return found != field.properties.end() && found->second == value;
  };
  if (is("sw", "r")) return is("hw", "na") ? "constant" : is("hw", "w") ? "ro" : "";
  if (is("sw", "rw") && is("hw", "r")) {
    if (is("onwrite", "woclr")) return is("hwset", "true") ? "w1c" : "";
    return field.properties.contains("onwrite") ? "" : "rw";
  }
  if (!is("sw", "w")) return "";
  return is("singlepulse", "true") ? "w1" : is("swmod", "true") ? "wo" : "";
}

/// Names and values of #define CORE_NAME VALUE, without CORE_.
std::map<std::string, std::uint64_t> macros_of(const std::string& header) {
  std::map<std::string, std::uint64_t> made;
  const std::regex macro("#define CORE_(\\w+) (\\w+)");
  for (std::sregex_iterator at(header.begin(), header.end(), macro), end; at != end; ++at)
    made[(*at)[1]] = std::stoull((*at)[2], nullptr, 0);
  return made;
}

const RdlRegister& called(const RdlMap& map, const std::string& name) {
  for (const RdlRegister& each : map.registers)
    if (each.name == name) return each;
  throw std::invalid_argument(name);
}
std::uint64_t reset_of(const RdlMap& map, const std::string& name, const std::string& field) {
  for (const RdlField& each : called(map, name).fields)
    if (each.name == field) return each.reset;
  throw std::invalid_argument(field);
}

class SystemRdl : public testing::TestWithParam<CoreOptions> {
 protected:
  const Core core_ = make_core(GetParam(), Library::thesis(), "mine");
  const std::string text_ = system_rdl(core_);
  const RdlMap map_ = RdlReader(text_).read();
};

TEST_P(SystemRdl, HasRoomForEachRegisterAndField) {
  EXPECT_EQ(map_.name, "mine_axi");
  std::uint64_t end = 0;
  for (const RdlRegister& each : map_.registers) {
    SCOPED_TRACE(each.name);
    const int width = bits_of(each);
    EXPECT_EQ(each.address * 8 % static_cast<unsigned>(width), 0U) << "aligned";
    EXPECT_GE(each.address, end) << "behind the one before";
    end = each.address + static_cast<unsigned>(width) / 8;
    int next = 0;
    for (const RdlField& field : each.fields) {
      EXPECT_GE(field.low, next) << field.name;
      EXPECT_GE(field.high, field.low) << field.name;
      next = field.high + 1;
      if (next - field.low < 64) {
        EXPECT_EQ(field.reset >> (next - field.low), 0U) << field.name;
      }
    }
    EXPECT_LE(next, width);
  }
  EXPECT_LE(end, 0x100U) << "an address of s_axi has 8 bits";
}

TEST_P(SystemRdl, AgreesWithTheManifest) {
  const Json json = registers_json(core_registers(GetParam()));
  ASSERT_EQ(json.size(), map_.registers.size());
  for (std::size_t i = 0; i < json.size(); ++i) {
    const RdlRegister& each = map_.registers[i];
    SCOPED_TRACE(each.name);
    EXPECT_EQ(json[i]["name"], each.name);
    EXPECT_EQ(json[i]["address"], each.address);
    EXPECT_EQ(json[i]["bits"], bits_of(each));
    const Json& fields = json[i]["fields"];
    if (fields.empty()) {
      EXPECT_EQ(each.fields.size(), 1U);
      EXPECT_EQ(access_of(each.fields.front()), "constant");
      EXPECT_EQ(each.fields.front().reset, 0U);
      continue;
    }
    ASSERT_EQ(fields.size(), each.fields.size());
    for (std::size_t j = 0; j < fields.size(); ++j) {
      const RdlField& field = each.fields[j];
      EXPECT_EQ(fields[j]["name"], field.name);
      EXPECT_EQ(fields[j]["low"], field.low) << field.name;
      EXPECT_EQ(fields[j]["width"], field.high - field.low + 1) << field.name;
      EXPECT_EQ(fields[j]["access"], access_of(field)) << field.name;
      EXPECT_EQ(fields[j]["reset"], field.reset) << field.name;
    }
  }
}

TEST_P(SystemRdl, AgreesWithTheCHeader) {
  auto macros = macros_of(c_header(core_));
  std::size_t addresses = 0;
  for (const auto& [name, value] : macros)
    if (name.starts_with("REG_") || name.starts_with("COUNT_")) ++addresses;
  EXPECT_EQ(addresses, map_.registers.size());
  for (const RdlRegister& each : map_.registers)
    EXPECT_EQ(macros.at((bits_of(each) == 64 ? "COUNT_" : "REG_") + each.name), each.address) << each.name;
  const std::map<std::string, std::string> constants{{"IDENTITY", "IDENTITY"}, {"VERSION", "VERSION"},
                                                     {"FORMAT", "FORMAT"},     {"SHAPE", "SHAPE"},
                                                     {"PORTS", "PORTS"},       {"LIMITS", "LIMITS"}};
  for (const auto& [name, macro] : constants) {
    std::uint64_t word = 0;
    for (const RdlField& field : called(map_, name).fields) word |= field.reset << field.low;
    EXPECT_EQ(word, macros.at(macro)) << name;
  }
  for (const char* const name : {"STATUS", "CONTROL"})
    for (const RdlField& field : called(map_, name).fields) {
      std::string macro = field.name;
      for (char& letter : macro) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
      if (field.name == "failed")
        EXPECT_THAT(c_header(core_),
                    testing::HasSubstr(
                        fmt::format("#define CORE_FAILED(why) (0x{:x}u << (why))", 1 << (field.low - 1))));
      else
        EXPECT_EQ(macros.at(macro), std::uint64_t{1} << field.low) << field.name;
    }
}

TEST_P(SystemRdl, SaysWhatTheCoreIs) {
  const CoreOptions& options = GetParam();
  const auto is = [&](const char* name, const char* field, int value) {
    EXPECT_EQ(reset_of(map_, name, field), static_cast<std::uint64_t>(value)) << name << " " << field;
  };
  is("FORMAT", "coord", options.bits.coord);
  is("FORMAT", "finer", options.bits.finer);
  is("FORMAT", "fraction", options.bits.fraction);
  is("FORMAT", "slope", options.bits.slope);
  is("FORMAT", "mantissa", options.bits.mantissa);
  is("SHAPE", "rays", options.rays);
  is("SHAPE", "questions", options.questions ? 1 : 0);
  is("SHAPE", "levels", options.levels);
  is("SHAPE", "block_bits", options.address_bits);
  is("PORTS", "tag_bits", options.tag_bits);
  is("PORTS", "byte_bits", options.byte_bits);
  is("PORTS", "beat_bytes", options.data_bits / 8);
  is("PORTS", "rings", options.rings ? 1 : 0);
  is("PORTS", "floats", options.float_door ? 1 : 0);
  is("PORTS", "weights", options.weights ? 1 : 0);
  is("PORTS", "serial", options.serial_triangle ? 1 : 0);
  is("PORTS", "one_id", options.has_one_id() ? 1 : 0);
  is("PORTS", "short_lines", options.cache.kib != 0 && options.cache.line == 32 ? 1 : 0);
  EXPECT_EQ(options.cache.kib, options.cache.kib != 0 ? 1 << reset_of(map_, "PORTS", "cache_size") : 0);
  is("LIMITS", "number_bits", options.number_bits);
  is("LIMITS", "leaf_bits", options.leaf_bits);
  is("LIMITS", "step_bits", options.step_bits);
  is("LIMITS", "stack_bits", options.stack_bits);
  is("LIMITS", "box_fraction", options.bits.box_fraction + 2);
  is("LIMITS", "triangle_ii", options.serial_triangle ? 0 : options.triangle_interval);
  is("LIMITS", "eight_ways", options.cache.kib != 0 && options.cache.ways == 8 ? 1 : 0);
}

TEST_P(SystemRdl, HasCountersAsWideAsTheVerilog) {
  const std::string verilog = axi_verilog(core_);
  for (const RdlRegister& each : map_.registers)
    if (bits_of(each) == 64) {
      EXPECT_THAT(verilog,
                  testing::ContainsRegex(fmt::format("reg \\[{}:0\\] count_", each.fields.front().high)))
          << each.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Cores, SystemRdl,
                         testing::Values(CoreOptions{.bits = bits},
                                         CoreOptions{.bits = bits,
                                                     .rays = 1,
                                                     .stack_bits = 1,
                                                     .levels = 20,
                                                     .address_bits = 4,
                                                     .byte_bits = 9,
                                                     .tag_bits = 1,
                                                     .number_bits = 8,
                                                     .leaf_bits = 3,
                                                     .step_bits = 9,
                                                     .in_order = true,
                                                     .serial_triangle = true},
                                         CoreOptions{.bits = bits,
                                                     .rays = 200,
                                                     .address_bits = 32,
                                                     .byte_bits = 64,
                                                     .tag_bits = 40,
                                                     .data_bits = 512,
                                                     .cache = {.kib = 16},
                                                     .weights = true,
                                                     .questions = true},
                                         CoreOptions{.bits = bits,
                                                     .byte_bits = 40,
                                                     .data_bits = 64,
                                                     .float_door = true,
                                                     .cache = {.kib = 2, .line = 32, .ways = 4},
                                                     .rings = true}),
                         [](const auto& each) {
                           return fmt::format("h{}k{}r{}", each.param.byte_bits, each.param.cache.kib,
                                              each.param.rings ? 1 : 0);
                         });

TEST(SystemRdlReader, RefusesWhatIsNotInTheLanguage) {
  const std::string good = "addrmap m { reg { field { sw = rw; hw = r; } a[3:0] = 0x1; } A @ 0x00; };";
  EXPECT_EQ(RdlReader(good).read().registers.front().fields.front().name, "a");
  const std::vector<std::pair<std::string, std::string>> bad{
      {"addrmap m", "addrmap reg"}, {"addrmap m {", "addrmap m"},
      {"sw = rw;", "sw = rx;"},     {"hw = r;", "hw = r; hw = r;"},
      {"hw = r;", "hw = r"},        {"a[3:0]", "a[3]"},
      {"= 0x1;", "= x;"},           {"A @ 0x00", "A"},
      {"hw = r;", "colour = r;"},   {"};", "}"},
      {"} a", "} number"},          {"0x00; };", "0x00; }; }"}};
  for (const auto& [old, by] : bad)
    EXPECT_THROW((void)RdlReader(replaced(good, old, by)).read(), std::invalid_argument) << by;
}

}  // namespace
}  // namespace hitpipe::rtl::system_rdl_test
