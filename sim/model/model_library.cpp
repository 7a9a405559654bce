#include "sim/model/model_library.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include "host/address_sanitizer.hpp"
#ifdef HITPIPE_ADDRESS_SANITIZER
#include <sanitizer/lsan_interface.h>
#endif

#include "host/files.hpp"
#include "host/process.hpp"
#include "host/text.hpp"
#include "sim/model/build_cache.hpp"
#include "sim/model/tool.hpp"
#include "sim/pins_source.hpp"

namespace hitpipe::sim {

namespace fs = std::filesystem;

namespace {

// The operators of a float design stay functions of their own (--inline-mult 1): merged into one function of
// many thousand instructions they are slower. docs/check.md has the figures.
constexpr std::string_view verilator_options =
    "--cc -O3 --inline-mult 1 --x-assign fast --x-initial fast --noassert -Wno-fatal --Mdir obj";
// The vectors of g++ gather registers that are apart, and that takes longer.
constexpr std::string_view compiler_options =
    "-std=c++17 -O2 -fno-tree-vectorize -DNDEBUG -w -fPIC -fvisibility=hidden -pthread";

/// $CXXFLAGS come last. -O0 is best for a model that runs for few cycles.
std::string all_compiler_options() {
  return fmt::format("{} {}", compiler_options, host::environment("CXXFLAGS", ""));
}

constexpr std::string_view link_options = "-shared -Wl,-Bsymbolic";

/// Verilator's own code, which every model needs.
constexpr std::array runtime_files{"verilated", "verilated_threads"};

/// Its header, which every model includes, compiled. Either compiler finds it as "verilated.h".
constexpr const char* compiled_header = "verilated.h.gch";

bool is_binary(const fs::path& file) {
  std::string magic(4, '\0');
  std::ifstream(file, std::ios::binary).read(magic.data(), 4);
  return magic.ends_with("ELF");
}

/// Path, size and time of the binary that a program of $PATH is, or that a script starts as Verilator's does.
/// Nothing for other scripts, which may answer differently each time.
std::string binary_of(const std::string& program) {
  std::istringstream folders(host::environment("PATH", ""));
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::error_code error;
    fs::path file = fs::path(folder) / program;
    if (!fs::is_regular_file(file, error)) continue;
    if (!is_binary(file)) file += "_bin";
    if (!is_binary(file)) return "";
    return fmt::format("{} {} {}", fs::canonical(file).string(), fs::file_size(file),
                       fs::last_write_time(file).time_since_epoch().count());
  }
  return "";
}

/// What the program says when it is asked. The cache keeps the answer of a binary, because to start one takes
/// longer than to load a model.
std::string answer_of(const std::string& program, const fs::path& cache,
                      const std::function<std::string()>& ask) {
  const std::string binary = binary_of(program);
  if (binary.empty()) return ask();
  std::string answer;
  const CacheEntry entry{
      .name = program, .identity = binary, .products = {"answer"}, .build = [&](const fs::path& folder) {
        answer = ask();
        host::write_file(folder / "answer", answer);
      }};
  try {
    std::ifstream in(cached(entry, cache) / "answer");
    return {std::istreambuf_iterator<char>(in), {}};
  } catch (const std::runtime_error&) {
    // A cache that cannot be written still serves what it holds.
    return answer.empty() ? ask() : answer;
  }
}

Tool find_verilator(const fs::path& cache) {
  const auto find = [] { return find_tool("VERILATOR", "verilator", "verilator"); };
  if (const fs::path root = host::environment("VERILATOR_ROOT", "");
      !root.empty() && !fs::exists(root / "include" / "verilated.h"))
    throw std::runtime_error(
        fmt::format("VERILATOR_ROOT is {}, which {}; set it to Verilator's folder, or do not set it",
                    root.string(), fs::is_directory(root) ? "has no include/verilated.h" : "is no folder"));
  for (const char* const variable : {"VERILATOR", "VERILATOR_ROOT", "VERILATOR_BIN"}) {
    if (!host::environment(variable, "").empty()) return find();
  }
  return {{"verilator"}, answer_of("verilator", cache, [&] { return find().version; })};
}

/// The version of a clang++ that runs and finds a C++ library; otherwise throws.
std::string version_of_clang() {
  const Tool clang{{"clang++"}, ""};
  const std::string version = clang.answer({"--version"});
  if (version.empty() || !clang.run({"-E", "-x", "c++", "-include", "cstdint", "/dev/null"}).succeeded())
    throw std::runtime_error("clang++ does not work");
  return version;
}

/// $CXX. Without it clang++ where that works, since its models are faster and compile sooner; otherwise c++.
Tool find_compiler(const fs::path& cache) {
  if (host::environment("CXX", "").empty()) {
    try {
      return {{"clang++"}, answer_of("clang++", cache, version_of_clang)};
    } catch (const std::runtime_error&) {
    }
  }
  return find_tool("CXX", "c++", "g++");
}

struct Tools {
  Tool verilator;
  Tool compiler;

  [[nodiscard]] std::string identity() const {
    return fmt::format("{}\n{}\n{}\n{}", verilator.version, compiler.name(), compiler.version,
                       all_compiler_options());
  }
};

/// Everything that decides the machine code.
struct Sources {
  ModelSources model;
  Tools tools;

  [[nodiscard]] std::string identity() const {
    return fmt::format("{}\n{}\n{}\n{}\n{}\n{}", tools.identity(), verilator_options, link_options,
                       pins_source, model.wrapper, model.verilog);
  }
};

/// A tool has failed because a disk is full: it says so, or nothing can be written beside its files.
bool was_out_of_space(const fs::path& folder, const host::Outcome& outcome) {
  const std::string reason = std::generic_category().message(ENOSPC);
  if ((outcome.out + outcome.err).find(reason) != std::string::npos) return true;
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  return !error && space.available == 0;
}

/// Runs a tool in the folder and writes its output to a log there. When the tool fails, the log stays in the
/// cache under the name of what was to be built, so that the user can read it. The rest is removed.
void step(const fs::path& folder, const std::string& what, const Tool& tool,
          const std::vector<std::string>& arguments) {
  const host::Outcome outcome = tool.run(arguments, folder);
  std::ofstream(folder / "log", std::ios::app) << outcome.out << outcome.err;
  if (outcome.succeeded()) return;
  const fs::path cache = folder.parent_path();
  if (was_out_of_space(folder, outcome))
    throw std::runtime_error(fmt::format(
        "{}: no space left on the disk for {}; make room, or set HITPIPE_CACHE, and TMPDIR for the "
        "tools' own files, to folders elsewhere",
        cache.string(), tool.name()));
  const fs::path kept = cache / fmt::format("failed-{}.log", what);
  std::error_code ignored;
  fs::rename(folder / "log", kept, ignored);
  throw std::runtime_error(
      fmt::format("{}: {}; its output is in {}", tool.name(), outcome.failure(), kept.string()));
}

/// The compiler's options for files that include Verilator's headers.
std::vector<std::string> options(const std::string& root) {
  std::vector<std::string> words = host::words_of(all_compiler_options());
  for (const char* const folder : {"/include", "/include/vltstd"}) words.push_back("-I" + root + folder);
  return words;
}

void append(std::vector<std::string>& words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
}

/// The folder of Verilator's own code and header. They are compiled once for all models, because they take
/// longer than a model.
fs::path runtime(const Tools& tools, const std::string& root, const fs::path& cache) {
  CacheEntry entry{
      .name = "verilated", .identity = tools.identity() + "\n" + root, .products = {}, .build = {}};
  std::vector<std::string> call = options(root);
  call.emplace_back("-c");
  for (const char* const file : runtime_files) {
    entry.products.push_back(std::string(file) + ".o");
    call.push_back(fmt::format("{}/include/{}.cpp", root, file));
  }
  entry.products.emplace_back(compiled_header);
  entry.build = [&](const fs::path& folder) {
    step(folder, entry.name, tools.compiler, call);
    std::vector<std::string> precompile = options(root);
    append(precompile, {"-x", "c++-header", root + "/include/verilated.h", "-o", compiled_header});
    // Without it models compile too.
    if (!tools.compiler.run(precompile, folder).succeeded()) host::write_file(folder / compiled_header, "");
  };
  return cached(entry, cache);
}

/// The model as one translation unit. Its many small files would each read Verilator's headers again.
std::string unit_of(const fs::path& folder) {
  std::vector<std::string> files{"model.cpp"};
  std::error_code ignored;  // the compiler reports missing files
  for (const auto& entry : fs::directory_iterator(folder / "obj", ignored)) {
    if (entry.path().extension() == ".cpp") files.push_back("obj/" + entry.path().filename().string());
  }
  std::sort(files.begin(), files.end());
  std::string text;
  for (const std::string& file : files) text += fmt::format("#include \"{}\"\n", file);
  return text;
}

void build(const Sources& sources, const fs::path& folder, const fs::path& cache) {
  const std::string& module = sources.model.module;
  host::write_files(folder, {{module + ".v", sources.model.verilog},
                             {"model.cpp", sources.model.wrapper},
                             {"pins.hpp", std::string(pins_source)}});
  const auto& [verilator, compiler] = sources.tools;
  std::vector<std::string> verilate = host::words_of(verilator_options);
  verilate.push_back(module + ".v");
  step(folder, module, verilator, verilate);
  const std::string root = verilator.answer({"--getenv", "VERILATOR_ROOT"});
  if (root.empty())
    throw std::runtime_error(
        fmt::format("{}: does not say its VERILATOR_ROOT; set it in the environment", verilator.name()));
  const fs::path compiled = runtime(sources.tools, root, fs::absolute(cache));
  host::write_file(folder / "unit.cpp", unit_of(folder));
  std::vector<std::string> compile = options(root);
  append(compile, host::words_of(link_options));
  append(compile, {"-I.", "-Iobj", "-o", "model.so", "unit.cpp"});
  for (const char* const file : runtime_files) compile.push_back((compiled / file).string() + ".o");
  std::vector<std::string> with_header = compile;
  append(with_header, {"-include", (compiled / "verilated.h").string()});
  // A compiled header does not outlive an update of the C++ library.
  if (!compiler.run(with_header, folder).succeeded()) step(folder, module, compiler, compile);
  std::error_code ignored;
  fs::remove_all(folder / "obj", ignored);
}

}  // namespace

fs::path default_cache() {
  if (const std::string own = host::environment("HITPIPE_CACHE", ""); !own.empty()) return own;
  const std::string home = host::environment("HOME", "");
  const std::string user = host::environment("XDG_CACHE_HOME", home.empty() ? "" : home + "/.cache");
  if (!user.empty()) return user + "/hitpipe";
  return host::environment("TMPDIR", "/tmp") + fmt::format("/hitpipe-cache-{}", geteuid());
}

ModelLibrary::ModelLibrary(const ModelSources& model, const fs::path& cache) {
  const Sources sources{model, {find_verilator(cache), find_compiler(cache)}};
  const fs::path entry = cached({.name = model.module,
                                 .identity = sources.identity(),
                                 .products = {"model.so"},
                                 .build = [&](const fs::path& folder) { build(sources, folder, cache); }},
                                cache);
  file_ = entry / "model.so";
  library_ = dlopen(file_.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr) fail();
  try {
    create_ = entry_point<CreateModel>("hitpipe_create");
    destroy_ = entry_point<DestroyModel>("hitpipe_destroy");
  } catch (...) {
    dlclose(library_);
    throw;
  }
}

ModelLibrary::~ModelLibrary() {
  dlclose(library_);
}

void* ModelLibrary::create() const {
  // Verilator's runtime keeps a buffer for the names of submodules in each thread, and never frees it.
#ifdef HITPIPE_ADDRESS_SANITIZER
  const __lsan::ScopedDisabler disabler;
#endif
  return create_();
}

void* ModelLibrary::symbol(const char* name) const {
  void* const found = dlsym(library_, name);
  if (found == nullptr) fail();
  return found;
}

void ModelLibrary::fail() const {
  const char* const reason = dlerror();
  throw std::runtime_error(fmt::format("{}: cannot be loaded ({}); remove the folder to have it built again",
                                       file_.parent_path().string(),
                                       reason == nullptr ? "an entry point is null" : reason));
}

}  // namespace hitpipe::sim
