#include "sim/verilated_design.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "sim/model_source.hpp"
#include "sim/pins_source.hpp"

namespace hitpipe::sim {

namespace fs = std::filesystem;

struct VerilatedDesign::Loaded {
  void* library = nullptr;
  CreateModel create = nullptr;
  DestroyModel destroy = nullptr;
  CycleModel cycle = nullptr;

  Loaded() = default;
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;
  ~Loaded() {
    if (library != nullptr) dlclose(library);
  }
};

namespace {

std::string environment(const char* name, const std::string& otherwise) {
  const char* const value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : otherwise;
}

/// FNV-1a, 64 bits: names a cache entry. The entry's sources are compared too, so a collision only costs a
/// build.
std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

std::string shell_word(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// Runs a shell command; its exit code.
int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string output_of(const std::string& command) {
  std::string text;
  if (std::FILE* const pipe = popen(command.c_str(), "r")) {
    std::array<char, 4096> buffer{};
    while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
      text.append(buffer.data(), got);
    if (pclose(pipe) != 0) text.clear();
  }
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::string read_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(fmt::format("{}: cannot write the file", path.string()));
}

constexpr std::string_view verilator_options =
    "--cc -O3 --x-assign fast --x-initial fast --noassert -Wno-fatal --Mdir obj";
constexpr std::string_view compiler_options =
    "-std=c++17 -O2 -w -fPIC -shared -fvisibility=hidden -Wl,-Bsymbolic -pthread";

/// A program of the user's choice and what it says of itself.
struct Tool {
  std::string program;
  std::string version;
};

/// $variable, or `otherwise`. A program given by a path is run from another folder later on.
Tool find_tool(const char* variable, const std::string& otherwise, std::string_view package) {
  Tool tool{environment(variable, otherwise), ""};
  if (tool.program.find('/') != std::string::npos) tool.program = fs::absolute(tool.program).string();
  tool.version = output_of(shell_word(tool.program) + " --version 2>/dev/null");
  if (tool.version.empty())
    throw std::runtime_error(fmt::format("{}: cannot be run; install the package {} or set {} to the program",
                                         tool.program, package, variable));
  return tool;
}

/// What is built: everything that decides the machine code.
struct Sources {
  std::string module;
  std::string verilog;
  std::string wrapper;
  Tool verilator;
  Tool compiler;

  [[nodiscard]] std::string identity() const {
    return fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}", verilator.version, verilator_options,
                       compiler.program, compiler.version, compiler_options, pins_source, wrapper, verilog);
  }
};

/// The model as one translation unit: its many small files would each read Verilator's headers again.
std::string unit_of(const fs::path& folder) {
  std::vector<std::string> files{"model.cpp"};
  std::error_code ignored;  // what is missing then, the compiler says
  for (const auto& entry : fs::directory_iterator(folder / "obj", ignored)) {
    if (entry.path().extension() == ".cpp") files.push_back("obj/" + entry.path().filename().string());
  }
  std::sort(files.begin(), files.end());
  std::string text;
  for (const std::string& file : files) text += fmt::format("#include \"{}\"\n", file);
  return text;
}

void build(const Sources& sources, const fs::path& folder) {
  write_file(folder / (sources.module + ".v"), sources.verilog);
  write_file(folder / "model.cpp", sources.wrapper);
  write_file(folder / "pins.hpp", std::string(pins_source));
  write_file(folder / "identity", sources.identity());
  const std::string in = "cd " + shell_word(folder.string()) + " && ";
  const std::string log = " >>log 2>&1";
  const auto step = [&](const Tool& tool, const std::string& arguments) {
    const int code = run(in + shell_word(tool.program) + " " + arguments + log);
    if (code == 0) return;
    // The log stays where the user can read it; the rest of the attempt goes.
    const fs::path kept = folder.parent_path() / fmt::format("failed-{}.log", sources.module);
    std::error_code ignored;
    fs::rename(folder / "log", kept, ignored);
    throw std::runtime_error(
        fmt::format("{}: failed with exit code {}; its output is in {}", tool.program, code, kept.string()));
  };
  step(sources.verilator, fmt::format("{} {}.v", verilator_options, sources.module));
  const std::string root =
      output_of(shell_word(sources.verilator.program) + " --getenv VERILATOR_ROOT 2>/dev/null");
  if (root.empty())
    throw std::runtime_error(fmt::format("{}: does not say its VERILATOR_ROOT; set it in the environment",
                                         sources.verilator.program));
  write_file(folder / "unit.cpp", unit_of(folder));
  step(sources.compiler, fmt::format("{0} -I. -Iobj -I{1}/include -I{1}/include/vltstd -o model.so unit.cpp "
                                     "{1}/include/verilated.cpp {1}/include/verilated_threads.cpp",
                                     compiler_options, shell_word(root)));
  std::error_code ignored;
  fs::remove_all(folder / "obj", ignored);
}

/// What killed runs left behind: build folders that nobody has touched for an hour.
void remove_abandoned(const fs::path& cache) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(cache, ignored)) {
    if (!entry.path().filename().string().starts_with("building-")) continue;
    const auto age = fs::file_time_type::clock::now() - fs::last_write_time(entry.path(), ignored);
    if (age > std::chrono::hours(1)) fs::remove_all(entry.path(), ignored);
  }
}

/// Whether the entry is whole and made of these sources.
bool holds(const fs::path& entry, const Sources& sources) {
  std::error_code ignored;
  return fs::exists(entry / "model.so", ignored) && read_file(entry / "identity") == sources.identity();
}

/// The folder that holds model.so for the sources.
fs::path cached(const Sources& sources, const fs::path& cache) {
  const fs::path entry = cache / fmt::format("{}-{:016x}", sources.module, hash_of(sources.identity()));
  if (holds(entry, sources)) return entry;

  const auto refuse = [&] {
    throw std::runtime_error(
        fmt::format("{}: cannot write to the cache; set HITPIPE_CACHE to another folder", cache.string()));
  };
  std::error_code error;
  fs::create_directories(cache, error);
  std::string aside = (cache / "building-XXXXXX").string();
  if (error || mkdtemp(aside.data()) == nullptr) refuse();
  remove_abandoned(cache);
  try {
    build(sources, aside);
    fs::rename(aside, entry, error);
    if (error && !holds(entry, sources)) {
      // A damaged entry, or other sources of the same hash.
      fs::remove_all(entry, error);
      fs::rename(aside, entry, error);
    }
    if (error && !holds(entry, sources)) refuse();
    fs::remove_all(aside, error);  // still there when another process was first
  } catch (...) {
    fs::remove_all(aside, error);
    throw;
  }
  return entry;
}

template <class Function>
Function entry_point(void* library, const char* name) {
  void* const symbol = dlsym(library, name);
  if (symbol == nullptr) throw std::runtime_error(dlerror());
  return reinterpret_cast<Function>(symbol);
}

}  // namespace

fs::path default_cache() {
  const std::string user = environment("XDG_CACHE_HOME", environment("HOME", "/tmp") + "/.cache");
  return environment("HITPIPE_CACHE", user + "/hitpipe");
}

VerilatedDesign::VerilatedDesign(const rtl::Design& design, rtl::Format format, const rtl::Library& library,
                                 const fs::path& cache) {
  const rtl::Pipeline pipeline = rtl::make_pipeline(design.trace(format), library);
  const std::string verilog = rtl::to_verilog(
      pipeline, library, {.module_name = std::string(design.name), .bits = rtl::to_string(format)});
  *this = VerilatedDesign(design, format, pipeline, verilog, cache);
}

VerilatedDesign::VerilatedDesign(const rtl::Design& design, rtl::Format format, const rtl::Pipeline& pipeline,
                                 const std::string& verilog, const fs::path& cache)
    : latency_(pipeline.latency()), stages_(pipeline.schedule.stages), clock_ps_(pipeline.schedule.clock_ps) {
  const std::vector<rtl::Port> operands = rtl::input_ports(design.trace(format));
  operand_count_ = operands.size();

  Sources sources;
  sources.module = design.name;
  sources.verilog = verilog;
  sources.wrapper = model_source(sources.module, operands, rtl::input_ports(pipeline.graph));
  sources.verilator = find_tool("VERILATOR", "verilator", "verilator");
  sources.compiler = find_tool("CXX", "c++", "g++");

  const fs::path entry = cached(sources, cache);
  const auto loaded = std::make_shared<Loaded>();
  try {
    loaded->library = dlopen((entry / "model.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    if (loaded->library == nullptr) throw std::runtime_error(dlerror());
    loaded->create = entry_point<CreateModel>(loaded->library, "hitpipe_create");
    loaded->destroy = entry_point<DestroyModel>(loaded->library, "hitpipe_destroy");
    loaded->cycle = entry_point<CycleModel>(loaded->library, "hitpipe_cycle");
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format(
        "{}: cannot be loaded ({}); remove the folder to have it built again", entry.string(), error.what()));
  }
  loaded_ = loaded;
}

Model::Model(const VerilatedDesign& design)
    : loaded_(design.loaded_), model_(loaded_->create()), cycle_(loaded_->cycle) {
  Pins pins{.rst = true};
  for (int i = 0; i <= design.latency(); ++i) cycle(nullptr, pins);
}

Model::Model(Model&& other) noexcept
    : loaded_(std::move(other.loaded_)), model_(std::exchange(other.model_, nullptr)), cycle_(other.cycle_) {}

Model::~Model() {
  if (model_ != nullptr) loaded_->destroy(model_);
}

}  // namespace hitpipe::sim
