// A scene as every later stage sees it: mesh, materials, camera and lights, all moved into the cube.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "rays/mesh/mesh.hpp"
#include "rays/scene/normalise.hpp"

namespace hitpipe::ref {

/// What a surface does with light, after Whitted (1980). The parts are linear, each component is in [0, 1],
/// and their sum is at most 1.
struct Material {
  glm::vec3 albedo{0.7F};         ///< diffuse, lit by the lights
  glm::vec3 reflect{0.0F};        ///< mirrored
  glm::vec3 transmit{0.0F};       ///< refracted; mirrored in total reflection
  float refractive_index = 1.0F;  ///< of the inside, > 0; the normals of a closed mesh point out of it
};

/// How the rays of an image run: from one point, or side by side.
enum class Projection : std::uint32_t { perspective, orthographic };

/// A camera in the cube. Perspective: a pinhole at the eye. Orthographic: the rays start at the plane through
/// the eye and all go forward.
struct Camera {
  glm::vec3 eye{0.0F};
  glm::dvec3 forward{0.0, 0.0, -1.0};  ///< unit
  glm::dvec3 right{1.0, 0.0, 0.0};     ///< unit
  glm::dvec3 up{0.0, 1.0, 0.0};        ///< unit; forward, right, up are at right angles
  double tan_half_height = 0.5;        ///< perspective: tangent of half the vertical field of view
  Projection projection = Projection::perspective;
  double half_height =
      0.5;  ///< orthographic: half the height of the image in the cube, more than 0 and at most 2^20
};

/// A sun is so far away that its light comes from one direction.
enum class LightKind : std::uint32_t { point, sun };

/// A light whose intensity does not fall with distance, so that no image depends on the scene's units.
struct Light {
  glm::vec3 position{0.0F};   ///< of a sun: the direction to it, unit
  glm::vec3 intensity{1.0F};  ///< linear, >= 0
  LightKind kind = LightKind::point;
};

// Scenes are compared by the bytes of these, so no byte may be a gap.
static_assert(sizeof(Material) == 3 * sizeof(glm::vec3) + sizeof(float));
static_assert(sizeof(Light) == 2 * sizeof(glm::vec3) + sizeof(LightKind));

struct Scene {
  std::string name;
  Mesh mesh;
  std::vector<Material> materials;
  Camera camera;
  std::vector<Light> lights;
  Normalisation to_cube;     ///< from the scene's own units, for reports
  std::string stand_in_for;  ///< for reports: the thesis's scene that it stands in for; empty: none
  Losses lost;               ///< to binary32
  double mesh_part = 1.0;    ///< the mesh's longest side, as a part of the cube's
};

/// A light in the scene's own units.
struct LightSource {
  glm::dvec3 position{0.0};  ///< of a sun: the direction to it, of any length but 0
  glm::dvec3 intensity{1.0};
  LightKind kind = LightKind::point;
};

/// Placings that replace the scene's own, in its own units.
struct SceneOptions {
  std::optional<glm::dvec3> eye;
  std::optional<glm::dvec3> target;   ///< point in the middle of the image
  std::optional<glm::dvec3> up;       ///< direction, not parallel to the view
  std::optional<double> fov_degrees;  ///< vertical field of view, 0 < fov < 180
  std::optional<Projection> projection;
  std::vector<LightSource> lights;       ///< if any, they replace the scene's own
  std::optional<std::size_t> triangles;  ///< about how many, for a built-in scene that scales
  std::optional<CubeChoice> cube;
};

/// A mesh with its placing, before it is moved into the cube.
template <class Vertex>
struct DescriptionOf {
  std::string name;
  MeshOf<Vertex> mesh;
  std::vector<Material> materials;
  glm::dvec3 eye{0.0};
  glm::dvec3 target{0.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double fov_degrees = 40.0;
  std::vector<LightSource> lights;
  std::string stand_in_for = {};  ///< as of Scene
  /// An orthographic image is as high as the field of view is at the target. So both projections show the
  /// same part of what is there.
  Projection projection = Projection::perspective;
  std::optional<CubeChoice> cube = {};  ///< nothing: the smallest that holds mesh, eye and point lights
};
using SceneDescription = DescriptionOf<glm::dvec3>;
/// A built-in scene as it is made: its corners are binary32.
using BuiltInDescription = DescriptionOf<glm::vec3>;

/// The same scene.
[[nodiscard]] SceneDescription as_source(BuiltInDescription made);

/// How far from a chosen cube's middle a point light may lie, in half sides.
constexpr double farthest_light = 0x1p20;

/// Checks materials and placing and moves everything into the cube. Throws std::runtime_error, one line, for
/// a material with a part out of range, and for a camera or light that cannot be placed. That is one with a
/// coordinate that is not finite, eye equal to target, up parallel to the view, a field of view or intensity
/// out of range, an orthographic image of height 0 or 2^20 times as high as the cube, a sun without a
/// direction, or a point so far away that less than smallest_mesh_part of the cube would be left for the
/// mesh. Suns are not placed in the cube, only their directions are. In a cube that the description chooses,
/// it also throws for a mesh or an eye outside, and for an image whose rays begin outside; lights may lie
/// outside, up to farthest_light times half a side.
[[nodiscard]] Scene place(SceneDescription description);

/// The same for a mesh that is in its cube already. `mesh` is that of the description, where it lies there. The
/// cube is as one that the description chooses. Throws as place() does for materials, camera and lights.
[[nodiscard]] Scene place_in(SceneDescription description, const Normalisation& to_cube, Mesh mesh);

/// The description with these placings in place of its own.
[[nodiscard]] SceneDescription with_options(SceneDescription description, const SceneOptions& options);

}  // namespace hitpipe::ref
