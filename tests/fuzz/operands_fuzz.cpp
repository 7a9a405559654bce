// A file of rays and a file of boxes, as `hitpipe operands` reads them, with a line "--" between them. The
// first byte chooses bounds and all pairs. What cannot be read is refused in one line; of what is read the
// integer unit misses no box, and each test is written.
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

#include "rtl_gen/catalogue/design.hpp"
#include "sim/operands/operands.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using namespace hitpipe;
using fuzz::expect;

/// A file in memory with a name.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view text) : descriptor_(memfd_create("fuzz", MFD_CLOEXEC)) {
    expect(descriptor_ >= 0, "there is a file in memory");
    expect(::write(descriptor_, text.data(), text.size()) == static_cast<ssize_t>(text.size()),
           "the file in memory takes the text");
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::string name() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

std::uint64_t lines_of(std::string_view text) {
  std::uint64_t lines = 0;
  for (const char c : text) lines += c == '\n' ? 1U : 0U;
  return lines;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::uint8_t choice = data[0];
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  constexpr std::string_view between = "\n--\n";
  const std::size_t cut = text.find(between);
  if (cut == std::string_view::npos) return 0;
  const MemoryFile rays(text.substr(0, cut));
  const MemoryFile boxes(text.substr(cut + between.size()));
  const bool all_pairs = (choice & 1U) != 0;
  if (all_pairs && size > 4096) return 0;  // too many tests
  const rtl::Design& design = rtl::find_design("int_slabs");
  const sim::Placement placement =
      (choice & 2U) != 0 ? sim::Placement(ref::Bounds{{-3, 0, 10}, {4, 0.1, 1e3}}) : sim::Placement();
  const sim::TestLayout layout(design, design.default_format, placement, sim::TestForm::csv, true);
  std::uint64_t lines = 0;
  try {
    const sim::OperandCounts counts =
        sim::write_operands([&] { return sim::make_box_test(design, design.default_format); }, layout,
                            {.files = {rays.name(), boxes.name(), all_pairs}, .placement = placement},
                            [&](std::string_view part) { lines += lines_of(part); });
    expect(counts.false_misses == 0, "an integer unit never misses");
    expect(lines == counts.tests + 1, "each test is a line below the names of the columns");
  } catch (const std::runtime_error& error) {
    fuzz::expect_one_line(error.what());
  }
  return 0;
}
