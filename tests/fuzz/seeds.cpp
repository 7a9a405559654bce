// Writes the seeds that follow from files of hitpipe: seeds SOURCE FOLDER. These are rays and boxes of every
// category of the adversary, and of CSV files, component libraries with each value replaced in turn, and the
// commands in the docs.
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rays/image/core_image.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "sw_ref/judge/adversary/categories.hpp"
#include "sw_ref/judge/adversary/random.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"

namespace {

using namespace hitpipe;
namespace fs = std::filesystem;

class Seeds {
 public:
  explicit Seeds(fs::path folder) : folder_(std::move(folder)) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void add(std::string_view seed) {
    if (!known_.insert(std::string(seed)).second) return;
    std::ofstream out(folder_ / fmt::format("{:04}", known_.size()), std::ios::binary);
    if (!(out << seed).flush())
      throw std::runtime_error(fmt::format("{}: cannot be written", folder_.string()));
  }

 private:
  fs::path folder_;
  std::set<std::string> known_;
};

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> split(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

/// Every category; cases that are refused; one case with each of its words replaced in turn.
void add_cases(Seeds seeds) {
  constexpr int of_each_category = 12;
  ref::adversary::Random random(1);
  std::string last;
  for (const auto& category : ref::adversary::categories()) {
    for (int i = 0; i < of_each_category; ++i) {
      const auto made = category.make(random);
      last = to_text(made);
      seeds.add(last);
    }
  }
  for (const std::string_view refused :
       {"", "origin", "origin 0 0 0 direction 0 -0 0 length 1 box 0 0 0 to 1 1 1",
        "origin 0 0 0 direction 1 0 0 length 1 box 0.5 0 0 to 0 1 1",
        "origin 0 0 0 direction 1 0 0 length 1 box 0 0 0 to 1 1 1 more"})
    seeds.add(refused);
  const auto words = split(last);
  for (std::size_t replaced = 0; replaced < words.size(); ++replaced) {
    for (const std::string_view by : {"", "inf", "nan", "-2", "1e-46", "0x"}) {
      std::string text;
      for (std::size_t i = 0; i < words.size(); ++i)
        text += fmt::format("{} ", i == replaced ? by : words[i]);
      seeds.add(text);
    }
  }
}

/// Rays, "--", boxes: every kind of number, and files that are refused.
void add_operands(Seeds seeds) {
  const std::string rays = "ox,oy,oz,dx,dy,dz,length\n";
  const std::string boxes = "min_x,min_y,min_z,max_x,max_y,max_z\n";
  const auto add = [&](std::string_view ray, std::string_view box) {
    for (const char choice : {'0', '1', '2', '3'})
      seeds.add(fmt::format("{}{}{}\n--\n{}{}\n", choice, rays, ray, boxes, box));
  };
  add("0.3,0.8,-0.4,0.25,-1,0.5,0.75", "0.4,-0.1,-0.2,0.6,0.2,0.1");
  add("0x1p-2,-0x1.8p-1,0,1e-3,0,-0,inf\n\n# a comment\n 0 ,0,0,1,1,1,", "-1,-1,-1,1,1,1\r\n0,0,0,0,0,0");
  add("1,0.05,500,1,0,0,1e30", "-3,0,10,4,0.1,1e3");
  for (const std::string_view word : {"nan", "1e400", "1e-400", "-", "0x", "2", "1.00000000000000000001"}) {
    add(fmt::format("{},0,0,1,0,0,1", word), "0,0,0,1,1,1");
    add(fmt::format("0,0,0,{0},0,0,{0}", word), fmt::format("0,0,0,{},1,1", word));
  }
  add("0,0,0,1,0,0", "0,0,0,1,1,1");
  for (const std::string_view refused :
       {"0\n--\n", "0ox\n--\nmin_x\n", "0dz,dy,dx,oz,oy,ox\n--\n\xEF\xBB\xBF#\n"})
    seeds.add(refused);
}

/// Images of cores: of few triangles, in leaves and in records, and one in which a number is missing.
void add_images(Seeds seeds) {
  for (const std::uint32_t triangles : {1U, 2U, 5U}) {
    ref::Scene scene;
    for (std::uint32_t i = 0; i < triangles; ++i) {
      const float x = static_cast<float>(i) / 8;
      scene.mesh.vertices.insert(scene.mesh.vertices.end(),
                                 {{x, 0, 0}, {x + 0.1F, 0.5F, 0}, {x, 0, x - 0.5F}});
      scene.mesh.triangles.push_back(3U * i + glm::uvec3(0, 1, 2));
    }
    if (triangles == 5) scene.mesh.vertices[4] = scene.mesh.vertices[3];
    for (const int max_triangles : {1, 4}) {
      const ref::IntScene made =
          ref::int_scene(scene, {8, 1, 16, 0, 0}, {.build = {.max_triangles = max_triangles}});
      seeds.add(ref::core_image_bytes(ref::core_image(made).blocks));
    }
  }
}

/// JSON to put in place of a value, one in each line. Some of it is wrong.
constexpr std::string_view values = R"json(null
true
false
0
1
-1
-0
3
64
1024
1025
100000001
18446744073709551616
1.5
1e2
1E+2
2e-1
1e400
01
""
"two\nlines"
"\"\\\/\b\f\r\t"
"\u0041\u00e9\u20ac\ud83d\ude00"
"\ud83d"
[]
{}
[[1,2],{"bits":[3]}]
/* a comment */ 1)json";

/// What a reader of JSON must refuse, one in each line: words, numbers, strings, lists and objects that are
/// cut short or wrong.
constexpr std::string_view odd_values = R"json(nul
trux
fals
-
-x
1.
1.x
1e
1e+
1e-x
0.0
0e1
-0.5
123456789012345678
-9223372036854775809
"
"\
"\x"
"\u12"
"\u12g4"
"\uDC00"
"\uD800\u0041"
"\uD800\n"
"\uD800x"
"\uabcd\u00FF"
// to the end of the line
/* no end
/
/x
[
]
[1
[1,
[1,]
[1 2]
{
}
{,
{1
{"a"
{"a" 1}
{"a":
{"a":}
{"a":1
{"a":1,
{"a":1,}
{"a":1 2}
{"a":1,2}
:
,
1 2
x
'x'
[[[[[[]]]]]]
{"a":{"a":[{}]}}
["a",null,true,false,-1,1,1.5,{},[]])json";

std::vector<std::string> lines_of(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Strings with every ASCII character, and with every first byte of UTF-8, followed by correct and by wrong
/// bytes.
std::vector<std::string> odd_strings() {
  std::vector<std::string> strings;
  const auto add = [&](const std::string& text) { strings.push_back('"' + text + '"'); };
  for (char c = 0; c < ' '; ++c) add({c});
  std::string printable;
  for (char c = ' '; c < '\x7f'; ++c)
    if (c != '"' && c != '\\') printable += c;
  add(printable);
  for (int first = 0x80; first <= 0xff; ++first)
    for (const char* const second : {"x", "\x80", "\x90", "\xa0"})
      for (const char* const rest : {"", "\x80x", "\x80\x80"})
        add(static_cast<char>(first) + (second + std::string(rest)));
  return strings;
}

/// `json` as text, with `replacement` in place of the value at `place`.
std::string with(nlohmann::json json, const nlohmann::json::json_pointer& place,
                 std::string_view replacement) {
  const std::string mark = "replaced here";
  json[place] = mark;
  std::string text = json.dump();
  return text.replace(text.find('"' + mark + '"'), mark.size() + 2, replacement);
}

std::string without(nlohmann::json json, const nlohmann::json::json_pointer& place) {
  auto& parent = json[place.parent_pointer()];
  if (parent.is_object()) {
    parent.erase(place.back());
  } else {
    parent.erase(std::stoul(place.back()));
  }
  return json.dump();
}

/// A library with each of its values replaced in turn, and without it.
void add_replacements(Seeds& seeds, const nlohmann::json& library) {
  std::set<std::string> keys;  // one place of each is enough
  const auto places = library.flatten();
  for (const auto& [place, leaf] : places.items()) {
    for (nlohmann::json::json_pointer at(place); !at.empty(); at.pop_back())
      if (keys.insert(at.back()).second) {
        for (const std::string& value : lines_of(values)) seeds.add(with(library, at, value));
        seeds.add(without(library, at));
      }
  }
}

void add_libraries(Seeds seeds, const fs::path& source) {
  for (const auto& entry : fs::directory_iterator(source / "rtl_gen/component/libraries"))
    seeds.add(text_of(entry.path()));
  const auto unit = nlohmann::json::parse(rtl::unit_json);
  seeds.add(rtl::unit_json);
  for (std::size_t length = 0; length < rtl::unit_json.size(); length += 50)
    seeds.add(rtl::unit_json.substr(0, length));
  add_replacements(seeds, unit);
  add_replacements(seeds,
                   nlohmann::json::parse(text_of(source / "rtl_gen/component/libraries/ice40_up5k.json")));
  for (const std::string& value : lines_of(odd_values)) {
    seeds.add(value);
    seeds.add(with(unit, nlohmann::json::json_pointer("/name"), value));
    seeds.add(with(unit, nlohmann::json::json_pointer("/gate_delay_ps"), value));
  }
  for (const std::string& text : odd_strings()) seeds.add(text);
  for (const std::string_view above : {"same", "tree", "stages"}) {
    for (const std::string_view area : {"linear", "quadratic"}) {
      auto lawful = unit;
      for (auto& component : lawful["components"]) {
        component["above"] = above;
        component["area"] = area;
      }
      seeds.add(lawful.dump());
    }
  }
}

/// A line of a page that runs hitpipe, as its words: one in each line, without a comment.
void add_commands(Seeds seeds, const fs::path& source) {
  std::vector<fs::path> pages{source / "README.md"};
  for (const auto& entry : fs::directory_iterator(source / "docs"))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  std::set<std::string> commands;
  for (const fs::path& page : pages) {
    for (const std::string& line : lines_of(text_of(page))) {
      const auto words = split(line.substr(0, line.find(" #")));
      if (words.size() < 2 || (words[0] != "hitpipe" && words[0] != "build/hitpipe")) continue;
      seeds.add(fmt::format("{}", fmt::join(words.begin() + 1, words.end(), "\n")));
      commands.insert(words[1]);
    }
  }
  for (const std::string& command : commands) seeds.add(command + "\n--help");
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) throw std::runtime_error("usage: seeds SOURCE FOLDER");
  const fs::path source = argv[1];
  const fs::path folder = argv[2];
  add_cases(Seeds(folder / "case"));
  add_operands(Seeds(folder / "operands"));
  add_images(Seeds(folder / "core_image"));
  add_libraries(Seeds(folder / "library"), source);
  add_commands(Seeds(folder / "command_line"), source);
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
