#include "cli/text/scene_text.hpp"

#include <iterator>

#include <fmt/format.h>

#include "host/files.hpp"
#include "rays/scene/triangle_numbers.hpp"

namespace hitpipe::cli {

namespace {

Row mesh_row(const ref::Mesh& mesh, const ref::Scene& scene) {
  return {{"triangles", mesh.triangles.size()},
          {"degenerate_dropped", mesh.without_area},
          {"lost_to_rounding", mesh.lost()},
          {"mesh_share_of_cube_pct", 100.0 * scene.mesh_part}};
}

/// `to_own` takes thicknesses to the scene's own units.
std::string text_of(const ref::Scene& scene, const ref::Losses& lost, double to_own, const std::string& where,
                    const std::string& more_bits) {
  const std::size_t of = ref::TriangleNumbers(scene.mesh).in_source() - scene.mesh.without_area;
  const double side = 2.0 * ref::cube_bound / scene.to_cube.scale;
  const std::string thickness =
      lost.triangles == 1
          ? fmt::format("it is {:.2g} thick", lost.thickest * to_own)
          : fmt::format("they are {:.2g} to {:.2g} thick", lost.thinnest * to_own, lost.thickest * to_own);
  constexpr double whole = 0.9;
  const std::string cure =
      scene.mesh_part < whole
          ? fmt::format("the mesh has {:.2g} of its side, so a nearer camera or light, or --cube, keeps more",
                        scene.mesh_part)
          : "a smaller part of the scene keeps more";
  return fmt::format("{}: {} of {} triangles lose{} area {}: {}, and the cube is {:.6g} wide; {}{}",
                     scene.name, lost.triangles, of, lost.triangles == 1 ? "s its" : " their", where,
                     thickness, side, more_bits, cure);
}

}  // namespace

Row scene_row(const ref::Scene& scene) {
  return mesh_row(scene.mesh, scene);
}

Row scene_row(const ref::IntScene& scene) {
  Row row = mesh_row(scene.mesh.mesh, scene.scene);
  // A hundred thousandth of the cube is 0.00 in the columns of a text.
  row["largest_movement"] = fmt::format("{:.3g}", scene.mesh.largest_movement);
  return row;
}

Row image_row(const ref::IntScene& scene) {
  return {{"triangles", scene.mesh.triangles.size()},
          {"missing_triangles", scene.mesh.mesh.dropped.size()},
          {"mesh_share_of_cube_pct", 100.0 * scene.scene.mesh_part}};
}

std::string summary_of(const Row& scene) {
  const auto count = [&](const char* key) { return scene.at(key).get<std::uint64_t>(); };
  const std::string lacks =
      scene.contains("missing_triangles")
          ? fmt::format("{} missing", count("missing_triangles"))
          : fmt::format("{} without area, {} lost", count("degenerate_dropped"), count("lost_to_rounding"));
  return fmt::format("{} triangles ({}), {:.3g} % of the cube", count("triangles"), lacks,
                     scene.at("mesh_share_of_cube_pct").get<double>());
}

std::string lost_text(const ref::Scene& scene) {
  if (scene.lost.triangles == 0) return "";
  return text_of(scene, scene.lost, 1.0, "in binary32, which has 24 bits", "");
}

std::string lost_text(const ref::Scene& scene, const ref::IntScene& integers) {
  const ref::Losses& lost = integers.mesh.lost;
  if (lost.triangles == 0) return "";
  constexpr int most = hls::WorldBits::max_coord;
  const int bits = integers.bits.coord;
  const std::string more = bits == most ? ""
                                        : fmt::format("with --bits of {} it would be {}; ", most,
                                                      ref::lost_on_grid(scene.mesh, most));
  return text_of(scene, lost, 1.0 / scene.to_cube.scale, fmt::format("at {} bits", bits), more);
}

void write_faces(const std::filesystem::path& file, const ref::Mesh& mesh) {
  const ref::TriangleNumbers numbers(mesh);
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "number,face\n");
  for (std::uint32_t number = 0; number < numbers.in_source(); ++number)
    fmt::format_to(std::back_inserter(text), "{},{}\n", number, numbers.face_of(number));
  host::write_file(file, {text.data(), text.size()});
}

}  // namespace hitpipe::cli
