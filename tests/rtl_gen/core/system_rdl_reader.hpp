// Reads a register map in the part of SystemRDL 2.0 that hitpipe writes: an addrmap of registers with fields,
// each property once. What is not in this grammar, or a property or value that the standard does not have, is
// refused.
#pragma once

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hitpipe::rtl {

struct RdlField {
  std::string name;
  int high, low;
  std::uint64_t reset;
  std::map<std::string, std::string> properties;  ///< one without a value is "true"
};
struct RdlRegister {
  std::string name;
  std::uint64_t address;
  std::map<std::string, std::string> properties;
  std::vector<RdlField> fields;
};
struct RdlMap {
  std::string name;
  std::map<std::string, std::string> properties;  ///< "default regwidth" is one that registers inherit
  std::vector<RdlRegister> registers;
};

/// Throws std::invalid_argument, with the word that it does not understand.
class RdlReader {
 public:
  explicit RdlReader(std::string_view text) : words_(words_of(text)) {}

  RdlMap read() {
    RdlMap map;
    take("addrmap");
    map.name = name();
    take("{");
    while (!takes("}")) {
      if (takes("reg"))
        map.registers.push_back(read_register());
      else
        read_property(map.properties, in_addrmap);
    }
    take(";");
    if (at_ != words_.size()) refuse();
    return map;
  }

 private:
  using Values = std::set<std::string>;
  /// Values that a property may have; none: a string, a number, or true.
  using Known = std::map<std::string, Values>;
  inline static const Known in_addrmap{{"name", {}},
                                       {"desc", {}},
                                       {"littleendian", {"true"}},
                                       {"default regwidth", {"8", "16", "32", "64"}},
                                       {"default accesswidth", {"8", "16", "32", "64"}}};
  inline static const Known in_register{{"desc", {}}, {"regwidth", {"8", "16", "32", "64"}}};
  inline static const Known in_field{
      {"desc", {}},
      {"sw", {"rw", "r", "w", "rw1", "w1", "na"}},
      {"hw", {"rw", "r", "w", "na"}},
      {"onwrite", {"woclr", "woset", "wot", "wzs", "wzc", "wzt", "wclr", "wset"}},
      {"hwset", {"true"}},
      {"hwclr", {"true"}},
      {"swmod", {"true"}},
      {"singlepulse", {"true"}}};
  /// Annex A of the standard: no name is one of these.
  inline static const Values keywords{"abstract",
                                      "accesstype",
                                      "addressingtype",
                                      "addrmap",
                                      "alias",
                                      "all",
                                      "alternate",
                                      "bit",
                                      "boolean",
                                      "bothedge",
                                      "byte",
                                      "compact",
                                      "component",
                                      "componentwidth",
                                      "constraint",
                                      "default",
                                      "encode",
                                      "enum",
                                      "external",
                                      "false",
                                      "field",
                                      "fullalign",
                                      "hw",
                                      "inside",
                                      "int",
                                      "internal",
                                      "level",
                                      "longint",
                                      "mem",
                                      "na",
                                      "negedge",
                                      "nonsticky",
                                      "number",
                                      "onreadtype",
                                      "onwritetype",
                                      "posedge",
                                      "precedencetype",
                                      "property",
                                      "r",
                                      "rclr",
                                      "real",
                                      "ref",
                                      "reg",
                                      "regalign",
                                      "regfile",
                                      "rset",
                                      "ruser",
                                      "rw",
                                      "rw1",
                                      "shortint",
                                      "shortreal",
                                      "signal",
                                      "signed",
                                      "string",
                                      "struct",
                                      "sw",
                                      "this",
                                      "true",
                                      "type",
                                      "unsigned",
                                      "w",
                                      "w1",
                                      "wclr",
                                      "with",
                                      "within",
                                      "woclr",
                                      "woset",
                                      "wot",
                                      "wr",
                                      "wset",
                                      "wuser",
                                      "wzc",
                                      "wzs",
                                      "wzt"};

  static bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

  /// Names, numbers and single signs; a string keeps its quotes.
  static std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t begin = at;
      if (std::isspace(static_cast<unsigned char>(text[at])) != 0) {
        ++at;
        continue;
      }
      if (text.substr(at, 2) == "//") {
        at = std::min(text.find('\n', at), text.size());
        continue;
      }
      if (text[at] == '"') {
        for (++at; at < text.size() && text[at] != '"'; ++at)
          if (text[at] == '\\') ++at;
        if (at >= text.size()) throw std::invalid_argument("a string does not end");
        ++at;
      } else if (is_letter(text[at])) {
        while (at < text.size() && is_letter(text[at])) ++at;
      } else {
        ++at;
      }
      words.emplace_back(text.substr(begin, at - begin));
    }
    return words;
  }

  RdlRegister read_register() {
    RdlRegister made{};
    take("{");
    while (!takes("}")) {
      if (takes("field"))
        made.fields.push_back(read_field());
      else
        read_property(made.properties, in_register);
    }
    made.name = name();
    take("@");
    made.address = number();
    take(";");
    if (made.fields.empty()) throw std::invalid_argument(made.name + " has no field");
    return made;
  }
  RdlField read_field() {
    RdlField made{};
    take("{");
    while (!takes("}")) read_property(made.properties, in_field);
    made.name = name();
    take("[");
    made.high = static_cast<int>(number());
    take(":");
    made.low = static_cast<int>(number());
    take("]");
    take("=");
    made.reset = number();
    take(";");
    return made;
  }
  void read_property(std::map<std::string, std::string>& properties, const Known& known) {
    std::string property = word();
    if (property == "default") property += " " + word();
    const auto found = known.find(property);
    if (found == known.end()) refuse();
    const std::string value = takes("=") ? word() : "true";
    const bool is_string = value.front() == '"';
    if (found->second.empty() ? !is_string : !found->second.contains(value)) refuse();
    take(";");
    if (!properties.emplace(property, value).second) refuse();
  }

  std::string word() {
    if (at_ == words_.size()) throw std::invalid_argument("the text does not end");
    return words_[at_++];
  }
  bool takes(std::string_view wanted) {
    if (at_ == words_.size() || words_[at_] != wanted) return false;
    ++at_;
    return true;
  }
  void take(std::string_view wanted) {
    if (word() != wanted) refuse();
  }
  std::string name() {
    std::string made = word();
    if (!is_letter(made.front()) || std::isdigit(static_cast<unsigned char>(made.front())) != 0 ||
        keywords.contains(made))
      refuse();
    return made;
  }
  std::uint64_t number() {
    const std::string digits = word();
    std::size_t end = 0;
    const std::uint64_t made =
        std::isdigit(static_cast<unsigned char>(digits.front())) != 0 ? std::stoull(digits, &end, 0) : 0;
    if (end != digits.size()) refuse();
    return made;
  }
  [[noreturn]] void refuse() const {
    throw std::invalid_argument("not understood: " + (at_ == 0 ? "" : words_[at_ - 1]) + ", word " +
                                std::to_string(at_));
  }

  std::vector<std::string> words_;
  std::size_t at_ = 0;
};

}  // namespace hitpipe::rtl
