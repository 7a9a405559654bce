// The JSON of a glTF file, and its buffers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "rays/files/json_place.hpp"

namespace hitpipe::ref {

class GltfDocument {
 public:
  /// The bytes must outlive the document; `file` finds the buffers. Refuses what is not glTF 2, and
  /// extensions that are required and not in the list in the code.
  GltfDocument(std::string_view bytes, const std::filesystem::path& file);

  [[nodiscard]] Place top() const { return Place(root_); }
  /// How many entries a list at the top has, such as "nodes"; 0 if there is none.
  [[nodiscard]] std::size_t size(const char* list) const;
  /// Refuses an entry that is not an object.
  [[nodiscard]] Place item(const char* list, std::size_t i) const;
  /// A number that names an entry of a list.
  [[nodiscard]] std::uint64_t index(const char* list, const Place& number) const;
  [[nodiscard]] Place item(const char* list, const Place& number) const {
    return item(list, index(list, number));
  }
  /// True if the file uses or requires the extension.
  [[nodiscard]] bool uses(std::string_view extension) const;

  /// As many bytes as the buffer announces. A file is opened when it is first asked for.
  [[nodiscard]] std::string_view buffer(std::uint64_t number);
  /// Of the file and the buffers that were opened.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  void check_version() const;
  void check_extensions() const;
  std::string_view open(const Place& uri);

  std::filesystem::path folder_;
  nlohmann::json root_;
  std::optional<std::string_view> chunk_;
  std::vector<std::string> extensions_;
  std::map<std::uint64_t, std::string_view> buffers_;
  std::map<std::string, std::string> files_;  ///< by name
  std::vector<std::unique_ptr<std::string>> decoded_;
  std::uint64_t bytes_;
};

}  // namespace hitpipe::ref
