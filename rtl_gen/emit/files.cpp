#include "rtl_gen/emit/files.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "rtl_gen/emit/axi_stream.hpp"
#include "rtl_gen/emit/core_file.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/emit/scratch_file.hpp"
#include "rtl_gen/emit/testbench.hpp"
#include "rtl_gen/prune/check_block.hpp"
#include "rtl_gen/prune/demand_fields.hpp"
#include "rtl_gen/schematic/dot.hpp"
#include "rtl_gen/verilog/module.hpp"

namespace hitpipe::rtl {

namespace {

constexpr int vector_count = 1000;
constexpr std::uint64_t vector_seed = 1;

File drawing_of(const File& dot) {
  const ScratchFile source;
  {
    std::ofstream out(source.path());
    out << dot.contents;
  }
  const std::string command = fmt::format("dot -Tsvg '{}' 2>/dev/null", source.path().string());
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error(fmt::format("{}: cannot start Graphviz's dot", dot.name));
  std::string svg;
  std::array<char, 1 << 16> buffer{};
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
    svg.append(buffer.data(), got);
  const int status = pclose(pipe);
  if (status != 0 || svg.empty()) {
    throw std::runtime_error(fmt::format("{}: Graphviz's dot {}; install the package graphviz", dot.name,
                                         WEXITSTATUS(status) == 127 ? "was not found" : "failed"));
  }
  return {std::filesystem::path(dot.name).replace_extension(".svg").string(), std::move(svg)};
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what, int error) {
  throw std::runtime_error(fmt::format("{}: cannot {}: {}", path.string(), what,
                                       std::error_code(error, std::generic_category()).message()));
}

std::vector<Vector> vectors(Evaluate evaluate, const std::vector<Port>& left, const PrunedFrom* from) {
  if (from == nullptr) return judged(operand_vectors(left, vector_count, vector_seed), evaluate);
  DrawVectors draw(from->ports, from->demands, evaluate, vector_seed);
  std::vector<Vector> drawn;
  for (int i = 0; i < vector_count; ++i) drawn.push_back(draw());
  return drawn;
}

/// None when there is one group only.
std::vector<File> stage_schematics(const Pipeline& pipeline, const std::string& name,
                                   const std::string& title) {
  std::vector<File> files;
  const std::vector<StageRange> groups = stage_groups(pipeline);
  for (const StageRange& group : groups) {
    if (groups.size() == 1) break;
    const std::string stages = group.first == group.last
                                   ? fmt::format("stage_{}", group.first)
                                   : fmt::format("stages_{}-{}", group.first, group.last);
    std::string words = stages;
    std::replace(words.begin(), words.end(), '_', ' ');
    files.push_back(
        {fmt::format("{}_{}.dot", name, stages),
         to_dot(pipeline, fmt::format("{}: {} of {}", title, words, pipeline.schedule.stages), group)});
  }
  return files;
}

}  // namespace

std::vector<File> EmittedDesign::schematics() const {
  std::vector<File> all{schematic};
  all.insert(all.end(), stage_schematics.begin(), stage_schematics.end());
  return all;
}

std::vector<File> EmittedDesign::files() const {
  std::vector<File> all{verilog, manifest, core, schematic, testbench, vectors};
  if (check_module) all.push_back(*check_module);
  if (axi_stream) all.push_back(*axi_stream);
  all.insert(all.end(), stage_schematics.begin(), stage_schematics.end());
  return all;
}

EmittedDesign emit(const Design& design, Format format, const Library& library, const Pipeline& pipeline,
                   const EmitOptions& options) {
  const PrunedFrom* const from = options.pruned_from;
  const std::vector<Port> left = input_ports(pipeline.graph);
  const std::string name(design.name);
  const std::string title = fmt::format("{} {}", name, to_string(format));
  std::string verilog = to_verilog(pipeline, library, {.module_name = name, .bits = to_string(format)});
  std::string json = manifest(design, format, pipeline, library, options.axi_stream);
  if (from != nullptr) {
    verilog = with_check_block(verilog, check_block(name, from->demands, from->ports, left));
    json = with_demand_fields(json, from->demands, from->report);
  }
  const std::string summary = fmt::format("{}{}: {} stages, {} ps", title, from == nullptr ? "" : ", fitted",
                                          pipeline.schedule.stages, pipeline.schedule.clock_ps);
  const CoreParts parts{.axi_stream = options.axi_stream, .check = from != nullptr};
  EmittedDesign emitted{
      .verilog = {name + ".v", std::move(verilog)},
      .manifest = {name + ".json", std::move(json)},
      .core = {name + ".core", core_file(design, format, parts)},
      .schematic = {name + ".dot", to_dot(pipeline, summary)},
      .testbench = {"tb/" + name + "_tb.v", testbench(design, left, vector_count)},
      .vectors = {"tb/" + name + "_vectors.hex", vector_file(from == nullptr ? left : from->ports, left,
                                                             vectors(design.evaluate(format), left, from))},
      .check_module = {},
      .axi_stream = {},
      .stage_schematics = stage_schematics(pipeline, name, title)};
  if (from != nullptr)
    emitted.check_module = {name + "_check.v", check_module(name + "_check", from->demands, from->ports)};
  if (options.axi_stream) emitted.axi_stream = {stream_module(design) + ".v", axi_stream(design, left)};
  return emitted;
}

std::vector<File> draw(const std::vector<File>& schematics) {
  std::vector<File> drawings;
  for (const File& schematic : schematics) drawings.push_back(drawing_of(schematic));
  return drawings;
}

std::vector<File> files_and_drawings(const EmittedDesign& emitted) {
  std::vector<File> all = emitted.files();
  for (File& drawing : draw(emitted.schematics())) all.push_back(std::move(drawing));
  return all;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail(folder, "create the folder", error.value());
  if (access(folder.c_str(), W_OK | X_OK) != 0) fail(folder, "write to the folder", errno);
}

void write_files(const std::filesystem::path& folder, const std::vector<File>& files) {
  std::vector<std::filesystem::path> temporary;
  std::error_code error;
  try {
    for (const File& file : files) {
      const std::filesystem::path target = folder / file.name;
      make_folder(target.parent_path());
      // The renames below must not fail half-way.
      if (std::filesystem::is_directory(target, error)) fail(target, "write the file", EISDIR);
      temporary.push_back(target.parent_path() / fmt::format(".{}.{}", target.filename().string(), getpid()));
      errno = 0;
      std::ofstream out(temporary.back(), std::ios::binary);
      out << file.contents;
      out.close();
      if (!out) fail(target, "write the file", errno);
    }
    for (std::size_t i = 0; i < files.size(); ++i) {
      std::filesystem::rename(temporary[i], folder / files[i].name, error);
      if (error) fail(folder / files[i].name, "write the file", error.value());
    }
  } catch (...) {
    for (const auto& path : temporary) std::filesystem::remove(path, error);
    throw;
  }
}

}  // namespace hitpipe::rtl
