#include "rays/files/ply_reader.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "host/text.hpp"
#include "rays/files/bad_positions.hpp"
#include "rays/files/ply_body.hpp"
#include "rays/files/ply_header.hpp"

namespace hitpipe::ref {
namespace {

template <class Body>
class PlyWalk {
 public:
  PlyWalk(const PlyHeader& header, Body body) : body_(body) {
    for (const PlyElement& element : header.elements) {
      if (element.name == "vertex") vertices_ = element.count;
    }
    for (const PlyElement& element : header.elements) {
      element_ = &element;
      if (element.name == "vertex")
        read_vertices();
      else if (element.name == "face")
        read_faces();
      else
        skip_element();
    }
    body_.end();
    for (const PlyElement& element : header.elements) {
      if (element.name == "vertex")
        bad_.refuse_used(
            mesh_, [&](std::size_t vertex, std::size_t place) { refuse_vertex(element, vertex, place); });
    }
  }
  FileMesh take() { return std::move(mesh_); }

 private:
  /// Rows that the rest of the file can have, at most as many as announced.
  [[nodiscard]] std::size_t likely_rows() const {
    std::size_t least = 0;
    for (const PlyProperty& p : element_->properties) least += Body::least_bytes(p.count ? *p.count : p.type);
    return std::min<std::size_t>(element_->count, body_.left() / least);
  }

  [[noreturn]] void refuse_short_file() const {
    reject(fmt::format("cut short in element {} {}; the header announces {}", host::shortened(element_->name),
                       row_, element_->count));
  }

  double number(const PlyScalar& type) {
    double value = 0;
    if (!body_.next(type, value)) refuse_short_file();
    return value;
  }

  std::uint64_t entries(const PlyProperty& property) {
    const double entries = number(*property.count);
    if (!(entries >= 0 && entries <= UINT32_MAX) || entries != std::floor(entries))
      reject(fmt::format("{}: element {} {} has a list of {} entries; allowed are 0 and more", place(),
                         host::shortened(element_->name), row_, entries));
    return static_cast<std::uint64_t>(entries);
  }

  void skip(const PlyProperty& property) {
    if (!body_.skip(property.type, property.count ? entries(property) : 1)) refuse_short_file();
  }

  void skip_element() {
    for (row_ = 0; row_ < element_->count; ++row_) {
      for (const PlyProperty& property : element_->properties) skip(property);
    }
  }

  [[nodiscard]] std::string place() const { return fmt::format("{} {}", Body::unit, body_.place()); }

  /// Text may hold any number, whatever the type.
  static bool has_type(double value, const PlyScalar& type) {
    if (type.kind == PlyScalar::floating) return std::isfinite(value);
    const bool is_signed = type.kind == PlyScalar::signed_int;
    const double end = std::ldexp(1.0, 8 * type.bytes - (is_signed ? 1 : 0));
    return value == std::floor(value) && value >= (is_signed ? -end : 0.0) && value < end;
  }

  [[noreturn]] void refuse_vertex(const PlyElement& element, std::size_t vertex, std::size_t place) const {
    const glm::dvec3& p = mesh_.positions[vertex];
    for (const PlyProperty& property : element.properties) {
      const int axis = axis_of(property);
      if (axis >= 0 && property.type.kind != PlyScalar::floating && !has_type(p[axis], property.type))
        reject(fmt::format("{} {}: {} of vertex {} is {}; allowed are the numbers of type {}", Body::unit,
                           place, property.name, vertex, p[axis], property.type.name));
    }
    reject(fmt::format("{} {}: vertex {} lies at ({}, {}, {}); coordinates must be finite", Body::unit, place,
                       vertex, p.x, p.y, p.z));
  }

  /// 0 to 2 for x, y and z.
  static int axis_of(const PlyProperty& p) {
    return p.name == "x" ? 0 : p.name == "y" ? 1 : p.name == "z" ? 2 : -1;
  }

  void read_vertices() {
    std::vector<int> axes;
    for (const PlyProperty& p : element_->properties) axes.push_back(axis_of(p));
    mesh_.positions.reserve(likely_rows());
    for (row_ = 0; row_ < element_->count; ++row_) {
      glm::dvec3 p{};
      bool good = true;
      for (std::size_t k = 0; k < axes.size(); ++k) {
        const PlyProperty& property = element_->properties[k];
        if (axes[k] < 0) {
          skip(property);
          continue;
        }
        p[axes[k]] = number(property.type);
        good = good && has_type(p[axes[k]], property.type);
      }
      if (!good) bad_.add(mesh_.positions.size(), body_.place());
      mesh_.positions.push_back(p);
    }
  }

  void read_faces() {
    mesh_.corners.reserve(std::min<std::size_t>(3 * likely_rows(), body_.left()));
    std::vector<std::uint32_t> face;
    for (row_ = 0; row_ < element_->count; ++row_) {
      for (const PlyProperty& property : element_->properties) {
        if (!is_ply_vertex_list(property)) {
          skip(property);
          continue;
        }
        face.clear();
        for (std::uint64_t left = entries(property); left > 0; --left) face.push_back(index(property));
      }
      if (face.size() > std::numeric_limits<std::uint32_t>::max() - mesh_.corners.size())
        reject("the faces have more than 4294967295 corners, which is the most allowed");
      mesh_.add_face(face);
    }
  }

  std::uint32_t index(const PlyProperty& property) {
    const double index = number(property.type);
    if (index >= 0 && index < static_cast<double>(vertices_) && index == std::floor(index))
      return static_cast<std::uint32_t>(index);
    reject(fmt::format("{}: face {} refers to vertex {}; the file has {}", place(), row_, index,
                       vertices_ == 0 ? "no vertex" : fmt::format("vertices 0 to {}", vertices_ - 1)));
  }

  Body body_;
  FileMesh mesh_;
  BadPositions bad_;
  std::uint64_t vertices_ = 0;
  const PlyElement* element_ = nullptr;
  std::uint64_t row_ = 0;
};

}  // namespace

FileMesh read_ply(std::string_view bytes) {
  const PlyHeader header = read_ply_header(bytes);
  if (header.encoding == PlyHeader::text) return PlyWalk(header, PlyTextBody(bytes, header)).take();
  constexpr bool is_little = std::endian::native == std::endian::little;
  if ((header.encoding == PlyHeader::little_endian) == is_little)
    return PlyWalk(header, PlyBinaryBody<false>(bytes, header.bytes)).take();
  return PlyWalk(header, PlyBinaryBody<true>(bytes, header.bytes)).take();
}

}  // namespace hitpipe::ref
