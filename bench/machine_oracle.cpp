// What a change of a machine's C++ must leave as it is. Writes each machine of a list in several formats: its
// files, its graph, and a running number over all outputs and registers of a million random cycles.
//   machine_oracle FOLDER MACHINE=FORMAT...
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/machine/files.hpp"
#include "rtl_gen/machine/machine.hpp"

namespace hitpipe::rtl {
namespace {

constexpr int cycles = 1'000'000, cycles_a_line = 1'000;

void write(const std::string& path, const std::string& text) {
  std::ofstream(path) << text;
}

std::string digests(const Machine& machine, const Format& format) {
  RandomCycles random(machine.graph(format), 55);
  const auto native = machine.native(format);
  std::string text;
  std::uint64_t digest = 0;
  const auto add = [&](const std::vector<Word>& words) {
    for (const Word word : words)
      for (const auto half : {static_cast<std::uint64_t>(word), static_cast<std::uint64_t>(word >> 64)})
        digest = (digest ^ half) * 0x9e3779b97f4a7c15 + (digest >> 29);
  };
  for (int i = 1; i <= cycles; ++i) {
    MachineCycle cycle = random.next();
    native->outputs(cycle.outputs.data());
    native->step(cycle.inputs.data(), cycle.reset);
    native->state(cycle.state.data());
    add(cycle.outputs);
    add(cycle.state);
    if (i % cycles_a_line == 0) text += fmt::format("{} {:016x}\n", i, digest);
  }
  return text;
}

void write_all(const std::string& folder, std::string_view name, std::string_view bits) {
  const Machine* machine = machine_called(name);
  if (machine == nullptr) throw std::runtime_error(fmt::format("no machine is called {}", name));
  const Format format = machine->parse_format(bits);
  for (const host::File& file :
       machine_files(*machine, format, Library::thesis(), {.module = std::string(name)})) {
    std::string path = file.name;
    for (char& c : path) c = c == '/' ? '_' : c;
    write(fmt::format("{}/{}.{}", folder, format.identifier(), path), file.contents);
  }
  const std::string stem = fmt::format("{}/{}.{}", folder, format.identifier(), name);
  write(stem + ".graph", to_text(machine->graph(format).graph));
  write(stem + ".canonical", to_text(canonical(machine->graph(format).graph)));
  write(stem + ".cycles", digests(*machine, format));
}

}  // namespace
}  // namespace hitpipe::rtl

int main(int count, char** words) {
  try {
    for (int i = 2; i < count; ++i) {
      const std::string_view word = words[i];
      const auto at = word.find('=');
      hitpipe::rtl::write_all(words[1], word.substr(0, at), word.substr(at + 1));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
