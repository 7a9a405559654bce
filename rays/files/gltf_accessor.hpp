// Numbers of a glTF accessor, checked to lie in its buffer, read one at a time.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "rays/files/gltf_document.hpp"

namespace hitpipe::ref {

class GltfAccessor {
 public:
  /// The accessor that `number` names. Its buffer is opened, and all its elements lie in it.
  GltfAccessor(GltfDocument& document, const Place& number);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] const Place& place() const { return place_; }
  [[nodiscard]] unsigned component_type() const { return values_.component_type; }
  [[nodiscard]] std::string_view type() const { return type_; }
  [[nodiscard]] bool normalised() const { return normalised_; }
  /// False for one whose numbers are zeros, but for sparse ones.
  [[nodiscard]] bool has_buffer_view() const { return values_.first != nullptr; }

  /// Component k of element i.
  [[nodiscard]] double number(std::uint64_t i, unsigned k) const;
  /// Element i of one component, an integer without a sign.
  [[nodiscard]] std::uint32_t index(std::uint64_t i) const {
    const char* const at = element(i);
    return at == nullptr ? 0 : integer(values_.component_type, at);
  }

  static constexpr unsigned signed_byte = 5120;
  static constexpr unsigned unsigned_byte = 5121;
  static constexpr unsigned signed_short = 5122;
  static constexpr unsigned unsigned_short = 5123;
  static constexpr unsigned unsigned_int = 5125;
  static constexpr unsigned floating = 5126;

 private:
  struct Range {
    const char* first = nullptr;
    std::uint64_t stride = 0;
    unsigned component_type = 0;
  };

  static Range range(GltfDocument& document, const Place& place, unsigned component_type, unsigned components,
                     std::uint64_t count);
  void read_sparse(GltfDocument& document, const Place& sparse);
  static std::uint32_t integer(unsigned component_type, const char* at);
  [[nodiscard]] const char* element(std::uint64_t i) const;

  Place place_;
  std::uint64_t count_ = 0;
  std::string type_;
  unsigned components_ = 0;
  bool normalised_ = false;
  Range values_;
  std::uint64_t sparse_count_ = 0;
  Range sparse_indices_;
  Range sparse_values_;
};

/// The accessors that were asked for. Each is checked once.
class GltfAccessors {
 public:
  explicit GltfAccessors(GltfDocument& document) : document_(document) {}
  [[nodiscard]] const GltfAccessor& at(const Place& number) {
    return all_.try_emplace(document_.index("accessors", number), document_, number).first->second;
  }

 private:
  GltfDocument& document_;
  std::map<std::uint64_t, GltfAccessor> all_;
};

}  // namespace hitpipe::ref
