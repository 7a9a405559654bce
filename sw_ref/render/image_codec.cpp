#include "sw_ref/render/image_codec.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "host/reject.hpp"

namespace hitpipe::ref {

namespace {

class OpenImageIoCodec final : public ImageCodec {
 public:
  // The bytes are made in memory because OpenImageIO's PNG writer reports success on a full disk.
  [[nodiscard]] std::vector<unsigned char> encode(const std::string& format, int width, int height,
                                                  const EncodedPixels& image) const override {
    const bool is_png = format == "png";
    const auto output = OIIO::ImageOutput::create(format);
    OIIO::Filesystem::IOVecOutput bytes;
    if (!output || !output->supports("ioproxy") || !output->set_ioproxy(&bytes))
      reject(fmt::format("this OpenImageIO cannot write .{}; use one that can", format));
    OIIO::ImageSpec spec(
        width, height, image.channels,
        is_png ? OIIO::TypeDesc::UINT8 : (image.full_floats ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::HALF));
    spec.attribute("oiio:ColorSpace", is_png ? "sRGB" : "Linear");
    if (!is_png) {
      spec.attribute("compression", "zip");
      spec.attribute("DateTime", "");  // otherwise the current time; equal images must be equal files
    }
    const std::string name = "image." + format;
    if (!output->open(name, spec) ||
        !(is_png ? output->write_image(OIIO::TypeDesc::UINT8, image.codes.data())
                 : output->write_image(OIIO::TypeDesc::FLOAT, image.values.data())) ||
        !output->close())
      reject(fmt::format("OpenImageIO cannot encode it; allowed are images that fit .{} ({})", format,
                         output->geterror()));
    return bytes.buffer();
  }

  [[nodiscard]] StoredImage read(const std::filesystem::path& file) const override {
    const auto unreadable = [](const std::string& why) {
      reject(fmt::format("OpenImageIO cannot read it; give a whole .png or .exr ({})",
                         why.substr(0, why.find_first_of("\r\n"))));
    };
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) unreadable(OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    constexpr std::int64_t most_pixels = std::int64_t{1} << 28;
    constexpr int most_channels = 64;
    if (spec.depth > 1 || std::int64_t{spec.width} * spec.height > most_pixels ||
        spec.nchannels > most_channels)
      reject(
          fmt::format("{} x {} x {} pixels of {} channels; allowed are {} pixels in a plane and {} channels",
                      spec.width, spec.height, spec.depth, spec.nchannels, most_pixels, most_channels));
    StoredImage image{spec.width, spec.height, spec.nchannels, {}};
    image.values.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                        static_cast<std::size_t>(spec.nchannels));
    if (!input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, image.values.data()))
      unreadable(input->geterror());
    return image;
  }
};

}  // namespace

const ImageCodec* hitpipe_image_codec() {
  static const OpenImageIoCodec codec;
  return &codec;
}

}  // namespace hitpipe::ref
