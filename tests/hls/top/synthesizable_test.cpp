// No top function reaches what a synthesiser cannot have: recursion, dynamic memory, virtual calls,
// exceptions, function pointers, the standard library. Clang's intermediate code of the tops is read for
// them. For Bambu, Clang must put every function of hitpipe inline.
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "host/process.hpp"

namespace hitpipe::synthesizable_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// The functions of a module of LLVM code, each with what its body does.
struct Function {
  std::set<std::string> calls;
  bool calls_a_pointer = false;
  bool handles_exceptions = false;
};
using Functions = std::map<std::string, Function>;

Functions functions_of(const std::string& code) {
  static const std::regex definition("^define .*@([\\w.$]+)\\(");
  static const std::regex call("\\b(call|invoke)\\b[^@%]*([@%])([\\w.$]+)\\(");
  Functions functions;
  Function* current = nullptr;
  std::istringstream lines(code);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (line.starts_with("define ") && std::regex_search(line, match, definition))
      current = &functions[match[1]];
    if (line == "}") current = nullptr;
    if (current == nullptr) continue;
    if (line.find("landingpad") != std::string::npos) current->handles_exceptions = true;
    if (line.find("call ") == std::string::npos && line.find("invoke ") == std::string::npos) continue;
    // A type may stand between the word and the function: "call zeroext i1 @f(" or "call %class.x @f(".
    static const std::regex type("%\"?(class|struct|union)[\\w.:<>\"]*");
    const std::string plain = std::regex_replace(line, type, "T");
    if (!std::regex_search(plain, match, call)) continue;
    if (match[2] == "%") {
      current->calls_a_pointer = true;
    } else {
      current->calls.insert(match[3]);
    }
  }
  return functions;
}

/// Walks all that a function reaches, and lists what is forbidden.
class Walk {
 public:
  explicit Walk(const Functions& functions) : functions_(functions) {}

  void visit(const std::string& name) {
    if (!on_the_way_.insert(name).second) {
      wrong_.insert("recursion: " + name);
      return;
    }
    if (seen_.insert(name).second) look_at(name);
    on_the_way_.erase(name);
  }
  [[nodiscard]] const std::set<std::string>& wrong() const { return wrong_; }
  [[nodiscard]] std::size_t functions() const { return seen_.size(); }

 private:
  void look_at(const std::string& name) {
    static const std::regex standard_library("^_ZN?K?St");
    if (std::regex_search(name, standard_library)) wrong_.insert("standard library: " + name);
    const auto function = functions_.find(name);
    if (function == functions_.end()) {
      if (!name.starts_with("llvm.")) wrong_.insert("calls into a library: " + name);
      return;
    }
    if (function->second.calls_a_pointer) wrong_.insert("function pointer: " + name);
    if (function->second.handles_exceptions) wrong_.insert("exceptions: " + name);
    for (const std::string& callee : function->second.calls) visit(callee);
  }

  const Functions& functions_;
  std::set<std::string> seen_, on_the_way_, wrong_;
};

/// `macro` chooses the tool.
std::string code_of(const std::filesystem::path& source, const std::string& optimization = "-O0",
                    const std::string& macro = "HITPIPE_VENDOR") {
  const host::Outcome outcome =
      host::run({HITPIPE_CLANG, "-std=c++14", optimization, "-S", "-emit-llvm", "-D" + macro,
                 "-I" HITPIPE_SOURCE "/tests/hls/vendor", "-I" HITPIPE_SOURCE, source.string(), "-o", "-"});
  EXPECT_TRUE(outcome.succeeded()) << outcome.err;
  return outcome.out;
}

std::set<std::string> forbidden_in(const std::string& text) {
  const host::ScratchFolder folder;
  const std::filesystem::path file = folder.path() / "top.cpp";
  std::ofstream(file) << text;
  const Functions functions = functions_of(code_of(file));
  Walk walk(functions);
  walk.visit("top");
  return walk.wrong();
}

/// The sources of the tops. A design without one has a file with a comment.
std::vector<std::filesystem::path> sources_of_tops() {
  std::vector<std::filesystem::path> sources;
  int without = 0;
  for (const auto& entry : std::filesystem::directory_iterator(HITPIPE_TOPS)) {
    if (entry.path().extension() != ".cpp" || entry.path().stem() == "replay") continue;
    if (std::filesystem::file_size(entry.path()) < 100) {
      ++without;
    } else {
      sources.push_back(entry.path());
    }
  }
  EXPECT_EQ(sources.size() + static_cast<std::size_t>(without), HITPIPE_TOP_COUNT);
  EXPECT_GT(sources.size(), static_cast<std::size_t>(without));
  return sources;
}

/// What the top calls of hitpipe's functions, as Clang names them.
std::set<std::string> hitpipe_calls(const std::filesystem::path& source, const std::string& macro) {
  const Functions functions = functions_of(code_of(source, "-O1", macro));
  const auto top = functions.find("hitpipe_" + source.stem().string());
  if (top == functions.end()) return {"no top function"};
  std::set<std::string> calls;
  for (const std::string& name : top->second.calls)
    if (name.find("7hitpipe3hls") != std::string::npos) calls.insert(name);
  return calls;
}

TEST(Synthesizable, BambuSeesOneFunction) {
  for (const std::filesystem::path& source : sources_of_tops())
    EXPECT_THAT(hitpipe_calls(source, "__BAMBU__"), IsEmpty()) << source;
  const std::filesystem::path int_slabs = std::filesystem::path(HITPIPE_TOPS) / "int_slabs.cpp";
  EXPECT_THAT(hitpipe_calls(int_slabs, "HITPIPE_AC_TYPES"), Contains(HasSubstr("IntSlabs4test")));
}

TEST(Synthesizable, TopsHaveNothingThatASynthesiserCannotHave) {
  for (const std::filesystem::path& source : sources_of_tops()) {
    const Functions functions = functions_of(code_of(source));
    const std::string top = "hitpipe_" + source.stem().string();
    Walk walk(functions);
    for (const auto& [name, function] : functions)
      if (name.find(top) != std::string::npos) walk.visit(name);
    EXPECT_THAT(walk.wrong(), IsEmpty()) << top;
    EXPECT_GT(walk.functions(), 50U) << top;
  }
}

TEST(Synthesizable, ForbiddenThingsAreFound) {
  const auto found_in = [](const std::string& body) { return forbidden_in("#include <vector>\n" + body); };
  EXPECT_THAT(found_in("int f(int x) { return x > 0 ? f(x - 1) : 0; }\n"
                       "extern \"C\" int top(int x) { return f(x); }\n"),
              Contains(HasSubstr("recursion: ")));
  EXPECT_THAT(found_in("extern \"C\" int top(int x) { return *new int(x); }\n"),
              Contains("calls into a library: _Znwm"));
  EXPECT_THAT(found_in("extern \"C\" int top(int (*f)(int)) { return f(1); }\n"),
              Contains("function pointer: top"));
  EXPECT_THAT(found_in("struct A { virtual int f(); };\nextern \"C\" int top(A& a) { return a.f(); }\n"),
              Contains("function pointer: top"));
  EXPECT_THAT(found_in("extern \"C\" int top(int x) { if (x > 0) throw x; return x; }\n"),
              Contains("calls into a library: __cxa_throw"));
  EXPECT_THAT(found_in("extern \"C\" int top(int x) { return std::vector<int>(1, x)[0]; }\n"),
              Contains(HasSubstr("standard library: ")));
  EXPECT_THAT(found_in("int f(int x) { return x + 1; }\nextern \"C\" int top(int x) { return f(f(x)); }\n"),
              IsEmpty());
}

}  // namespace
}  // namespace hitpipe::synthesizable_test
