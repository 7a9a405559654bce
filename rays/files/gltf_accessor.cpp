#include "rays/files/gltf_accessor.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include <fmt/format.h>

#include "rays/files/little_endian.hpp"

namespace hitpipe::ref {
namespace {

constexpr std::uint64_t gltf_most_bytes = std::uint64_t{1} << 53U;

unsigned gltf_component_bytes(unsigned component_type) {
  if (component_type == GltfAccessor::signed_byte || component_type == GltfAccessor::unsigned_byte) return 1;
  return component_type == GltfAccessor::signed_short || component_type == GltfAccessor::unsigned_short ? 2
                                                                                                        : 4;
}

unsigned read_component_type(const Place& place) {
  const std::uint64_t type = place.count(gltf_most_bytes);
  if (type < 5120 || type > 5126 || type == 5124)
    place.fail(fmt::format("{} is not a type of components; allowed are 5120 to 5123, 5125 and 5126", type));
  return static_cast<unsigned>(type);
}

/// Matrices of 1 and 2 bytes have columns that begin at multiples of 4 bytes. They are not read.
unsigned read_components(const Place& place) {
  struct Type {
    std::string_view name;
    unsigned components;
  };
  constexpr std::array<Type, 7> types{
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
  const std::string name = place.word();
  const auto* const found =
      std::find_if(types.begin(), types.end(), [&](const Type& t) { return t.name == name; });
  if (found == types.end()) place.fail("must be SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
  return found->components;
}

std::uint64_t gltf_optional_count(const Place& place, const char* key, std::uint64_t otherwise) {
  return place.has(key) ? place.at(key).count(gltf_most_bytes) : otherwise;
}

}  // namespace

GltfAccessor::GltfAccessor(GltfDocument& document, const Place& number)
    : place_(document.item("accessors", number)) {
  count_ = place_.at("count").count(std::numeric_limits<std::uint32_t>::max());
  components_ = read_components(place_.at("type"));
  type_ = place_.at("type").word();
  normalised_ = place_.has("normalized") && place_.at("normalized").truth();
  const unsigned component_type = read_component_type(place_.at("componentType"));
  if (place_.has("bufferView")) values_ = range(document, place_, component_type, components_, count_);
  values_.component_type = component_type;
  if (place_.has("sparse")) read_sparse(document, place_.at("sparse"));
}

GltfAccessor::Range GltfAccessor::range(GltfDocument& document, const Place& place, unsigned component_type,
                                        unsigned components, std::uint64_t count) {
  const Place view = document.item("bufferViews", place.at("bufferView"));
  const std::string_view buffer = document.buffer(document.index("buffers", view.at("buffer")));
  const std::uint64_t view_offset = gltf_optional_count(view, "byteOffset", 0);
  const std::uint64_t view_length = view.at("byteLength").count(gltf_most_bytes);
  if (view_offset > buffer.size() || view_length > buffer.size() - view_offset)
    view.fail(fmt::format("has bytes {} to {}; the buffer has {} bytes", view_offset,
                          view_offset + view_length, buffer.size()));
  const unsigned component = gltf_component_bytes(component_type);
  const std::uint64_t element = std::uint64_t{component} * components;
  const std::uint64_t stride = gltf_optional_count(view, "byteStride", element);
  if (view.has("byteStride") && (stride < 4 || stride > 252 || stride % 4 != 0))
    view.at("byteStride")
        .fail(fmt::format("{} is out of range; allowed are multiples of 4 from 4 to 252", stride));
  if (stride < element)
    place.fail(fmt::format("has elements of {} bytes; the stride of its bufferView is {}", element, stride));
  const std::uint64_t offset = gltf_optional_count(place, "byteOffset", 0);
  if ((view_offset + offset) % component != 0)
    place.fail(fmt::format("begins at byte {} of the buffer; allowed are multiples of {}",
                           view_offset + offset, component));
  const std::uint64_t bytes = count == 0 ? 0 : stride * (count - 1) + element;
  if (offset > view_length || bytes > view_length - offset)
    place.fail(fmt::format("has {} elements, which end at byte {} of the bufferView; it has {} bytes", count,
                           offset + bytes, view_length));
  return {buffer.data() + view_offset + offset, stride, component_type};
}

void GltfAccessor::read_sparse(GltfDocument& document, const Place& sparse) {
  sparse_count_ = sparse.at("count").count(count_);
  const Place indices = sparse.at("indices");
  const unsigned type = read_component_type(indices.at("componentType"));
  if (type != unsigned_byte && type != unsigned_short && type != unsigned_int)
    indices.at("componentType")
        .fail(fmt::format("{} is no type of indices; allowed are 5121, 5123 and 5125", type));
  sparse_indices_ = range(document, indices, type, 1, sparse_count_);
  sparse_values_ = range(document, sparse.at("values"), values_.component_type, components_, sparse_count_);
  std::uint64_t least = 0;
  for (std::uint64_t i = 0; i < sparse_count_; ++i) {
    const std::uint32_t index = integer(type, sparse_indices_.first + i * sparse_indices_.stride);
    if (index < least || index >= count_)
      indices.fail(fmt::format("entry {} is {}; allowed are {} to {}, in rising order", i, index, least,
                               static_cast<std::int64_t>(count_) - 1));
    least = std::uint64_t{index} + 1;
  }
}

std::uint32_t GltfAccessor::integer(unsigned component_type, const char* at) {
  switch (gltf_component_bytes(component_type)) {
    case 1:
      return little_endian<std::uint8_t>(at);
    case 2:
      return little_endian<std::uint16_t>(at);
    default:
      return little_endian<std::uint32_t>(at);
  }
}

/// Null for zeros.
const char* GltfAccessor::element(std::uint64_t i) const {
  std::uint64_t low = 0;
  for (std::uint64_t high = sparse_count_; low < high;) {
    const std::uint64_t middle = (low + high) / 2;
    if (integer(sparse_indices_.component_type, sparse_indices_.first + middle * sparse_indices_.stride) < i)
      low = middle + 1;
    else
      high = middle;
  }
  if (low < sparse_count_ &&
      integer(sparse_indices_.component_type, sparse_indices_.first + low * sparse_indices_.stride) == i)
    return sparse_values_.first + low * sparse_values_.stride;
  return values_.first == nullptr ? nullptr : values_.first + i * values_.stride;
}

double GltfAccessor::number(std::uint64_t i, unsigned k) const {
  const char* at = element(i);
  if (at == nullptr) return 0;
  at += std::size_t{k} * gltf_component_bytes(values_.component_type);
  const std::uint32_t bits = integer(values_.component_type, at);
  // Normalised integers are fractions of the largest one; the least signed one is -1 too.
  const auto fraction = [&](double value, double largest) {
    return normalised_ ? std::max(value / largest, -1.0) : value;
  };
  switch (values_.component_type) {
    case signed_byte:
      return fraction(static_cast<std::int8_t>(bits), 127);
    case unsigned_byte:
      return fraction(bits, 255);
    case signed_short:
      return fraction(static_cast<std::int16_t>(bits), 32767);
    case unsigned_short:
      return fraction(bits, 65535);
    case unsigned_int:
      return bits;
    default:
      return static_cast<double>(std::bit_cast<float>(bits));
  }
}

}  // namespace hitpipe::ref
