// A core's image from a file: it is whole, as our own is, and a scene again, or one line says what is wrong. A file
// with a header is also judged with a right checksum, which few changes leave right.
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "rays/image/core_image.hpp"
#include "sw_ref/core/image_scene.hpp"
#include "tests/fuzz/expect.hpp"

namespace {

using namespace hitpipe;

void judge(std::vector<ref::CoreBlock> blocks) {
  try {
    const ref::CoreImage image = ref::checked_image(std::move(blocks));
    const std::size_t used = image.records + image.header.triangles + ref::header_blocks;
    fuzz::expect(image.blocks.size() == used || image.blocks.size() == used + 1, "every block is counted");
    const hls::WorldBits bits{image.header.coord_bits, 1, 16, 0, 0};
    if (!bits.valid()) return;
    const ref::IntScene scene = ref::image_scene(image, bits, "image");
    fuzz::expect(scene.mesh.triangles.size() == image.header.triangles, "every triangle is in the scene");
  } catch (const std::runtime_error& error) {
    fuzz::expect_one_line(error.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<ref::CoreBlock> blocks;
  try {
    blocks = ref::core_image_blocks({reinterpret_cast<const char*>(data), size});
  } catch (const std::runtime_error& error) {
    fuzz::expect_one_line(error.what());
    return 0;
  }
  judge(blocks);
  if (blocks.size() <= ref::header_blocks) return 0;
  const std::uint64_t sizes = blocks[1][1], counts = blocks[1][2];
  ref::put_header(blocks, {.coord_bits = static_cast<int>(sizes & 0xff),
                           .levels = static_cast<int>(sizes >> 8 & 0xff),
                           .triangles = static_cast<std::uint32_t>(counts),
                           .missing = static_cast<std::uint32_t>(counts >> 32),
                           .to_cube = {.offset = {0.5, 0, -3}, .scale = 0.125}});
  judge(std::move(blocks));
  return 0;
}
