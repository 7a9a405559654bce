#include "tests/rtl_gen/verilog_names.hpp"

#include <cctype>
#include <map>
#include <set>

#include <fmt/format.h>

#include "rtl_gen/verilog/names.hpp"

namespace hitpipe::rtl {

namespace {

bool is_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$';
}

/// Words and single signs, without comments, strings, attributes, numbers with a base and directives.
std::vector<std::string_view> tokens_of(std::string_view text) {
  std::vector<std::string_view> tokens;
  const auto end_of = [&](std::size_t from, std::string_view what) {
    const std::size_t found = text.find(what, from);
    return found == std::string_view::npos ? text.size() : found + what.size();
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("//") || rest.starts_with("`")) {
      at = end_of(at, "\n");
    } else if (rest.starts_with("/*")) {
      at = end_of(at, "*/");
    } else if (rest.starts_with("(*") && !rest.starts_with("(*)")) {
      at = end_of(at, "*)");
    } else if (rest.starts_with("\"")) {
      ++at;
      while (at < text.size() && text[at] != '"') at += text[at] == '\\' ? 2 : 1;
      ++at;
    } else if (is_letter(text[at]) || text[at] == '\'') {
      const std::size_t begin = at++;
      while (at < text.size() && is_letter(text[at])) ++at;
      if (text[begin] != '\'') tokens.push_back(text.substr(begin, at - begin));
    } else {
      if (std::isspace(static_cast<unsigned char>(text[at])) == 0) tokens.push_back(text.substr(at, 1));
      ++at;
    }
  }
  return tokens;
}

const std::set<std::string_view>& declaring_words() {
  static const std::set<std::string_view> words{"input",      "output",  "inout", "wire", "reg",  "logic",
                                                "localparam", "integer", "int",   "time", "real", "genvar",
                                                "parameter",  "string",  "byte",  "bit",  "task", "function"};
  return words;
}

/// The names of one module.
class Names {
 public:
  explicit Names(std::vector<std::string>& faults) : faults_(faults) {}

  void declare(std::string_view name) {
    if (used_.contains(name) && !declared_.contains(name))
      faults_.push_back(fmt::format("{}: {} is used above its declaration", module_, name));
    declared_.insert(name);
    std::string small(name);
    for (char& letter : small) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    const auto [found, is_new] = any_case_.emplace(small, name);
    if (!is_new && found->second != name)
      faults_.push_back(fmt::format("{}: {} and {} differ in case alone", module_, found->second, name));
  }
  void use(std::string_view name) { used_.insert(name); }
  void begin(std::string_view module) {
    module_ = module;
    used_.clear();
    declared_.clear();
    any_case_.clear();
  }

 private:
  std::vector<std::string>& faults_;
  std::string_view module_;
  std::set<std::string_view> used_, declared_;
  std::map<std::string, std::string_view> any_case_;
};

}  // namespace

std::vector<std::string> faulty_names(std::string_view verilog) {
  std::vector<std::string> faults;
  Names names(faults);
  const std::vector<std::string_view> tokens = tokens_of(verilog);
  const auto is_name = [&](std::string_view token) {
    return is_letter(token[0]) && std::isdigit(static_cast<unsigned char>(token[0])) == 0 &&
           token[0] != '$' && !verilog_keywords().contains(std::string(token));
  };
  int depth = 0;           // of brackets and braces
  bool declares = false;   // until the end of a declaration
  bool awaits = false;     // the declaration's next name is declared, not used
  int declared_depth = 0;  // of the declaration
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::string_view token = tokens[i];
    if (token == "module") {
      names.begin(tokens.at(++i));
      declares = false;
      continue;
    }
    if (token == "(" || token == "[" || token == "{") ++depth;
    if (token == ")" || token == "]" || token == "}") --depth;
    if (declaring_words().contains(token)) {
      declares = awaits = true;
      declared_depth = depth;
    } else if (token == ";" || (declares && depth < declared_depth)) {
      declares = awaits = false;
    } else if (declares && depth == declared_depth && token == ",") {
      awaits = true;
    } else if (is_name(token)) {
      const bool is_pin = i > 0 && tokens[i - 1] == ".";
      if (awaits && depth == declared_depth) {
        names.declare(token);
        awaits = false;
      } else if (!is_pin) {
        names.use(token);
      }
    }
  }
  return faults;
}

}  // namespace hitpipe::rtl
