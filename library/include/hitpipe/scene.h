/* Scenes and rays in software: nearest and any hit, crossings that are counted exactly once, all hits, inside. C99;
 * <hitpipe/scene.hpp> is the same for C++20, and hitpipe.Scene for Python. docs/library.md has examples.
 *
 * Answers are exact: they depend neither on the processor and how its floating-point arithmetic is set, nor on the
 * compiler, the hierarchy or the number of threads. There is no epsilon. Two worlds:
 *   the float world   corners and rays are the binary32 numbers that you give, in units of your own, up to 2^24 in
 *                     magnitude. Nothing is rounded.
 *   an integer world  "20+1s20" as docs/integer_world.md has it: corners and rays are rounded to its grid, once, and
 *                     answers are those of the traversal core, bit for bit.
 * A ray hits a triangle from either side, edges and corners included; a ray in the triangle's plane never hits it. Of
 * nearest hits at the same distance the triangle with the lowest number is the answer. Crossings count each surface
 * once: a ray through an edge that two triangles share crosses one of them, or none and both where it only touches
 * ("Exactly once" in docs/integer_world.md). So a line crosses a closed mesh an even number of times, always.
 * Errors, ownership: as <hitpipe/ref.h> says. Threads: any number may ask one scene at a time, and move it: a call is
 * about the places before a move or about those after it. It does not wait for a move of corners; instances move when
 * nobody asks. A call that frees it needs it alone. */
#ifndef HITPIPE_SCENE_H
#define HITPIPE_SCENE_H

#include <hitpipe/ref.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Triangles by the numbers of their corners. */
typedef struct hitpipe_mesh {
  const float* corners;      /* corner_count * 3: x, y, z; those of triangles are up to 2^24 in magnitude */
  size_t corner_count;
  const uint32_t* triangles; /* triangle_count * 3: corners, each < corner_count; counter-clockwise from outside */
  size_t triangle_count;     /* up to 2^31 - 1; 0 is allowed, and nothing is ever hit */
} hitpipe_mesh;

/* A node of a bounding volume hierarchy. Node 0 is the root. */
typedef struct hitpipe_node {
  uint32_t first; /* leaf: its first place in the order of triangles; branch: its first child, the other is the next */
  int32_t count;  /* leaf: how many triangles, at least 1; branch: 0 */
} hitpipe_node;

/* A hierarchy of your own. The library makes the boxes. Each node is reached once, and each triangle lies in one leaf;
 * no path is longer than 60 nodes. */
typedef struct hitpipe_hierarchy {
  const hitpipe_node* nodes;
  size_t node_count;
  const uint32_t* order; /* triangle_count numbers of triangles, leaf by leaf */
} hitpipe_hierarchy;

typedef struct hitpipe_scene_options {
  const char* world;                   /* NULL or "float"; or n+gsS or n+gsStF: "20+1s20" */
  const hitpipe_hierarchy* hierarchy;  /* NULL: the library builds one, by surface area */
  const hitpipe_transform* transform;  /* of an integer world: from your units into its cube; NULL: hitpipe_fit_scene()
                                          without points. The float world has none. */
  int threads;                         /* that build it, up to 256; 0: one for each core */
} hitpipe_scene_options;

typedef struct hitpipe_scene hitpipe_scene;

/* `options` may be NULL. What the pointers point to is copied, and may go after the call. On success *out is a scene
 * that hitpipe_scene_close() must free; otherwise *out does not change. HITPIPE_BAD_MESH names the first bad corner or
 * triangle; HITPIPE_BAD_FORMAT: no such world; HITPIPE_BAD_HIERARCHY names the first bad node. A triangle without an
 * area, in an integer world on its grid, is allowed and never hit. */
HITPIPE_API hitpipe_status hitpipe_scene_open(const hitpipe_mesh* mesh, const hitpipe_scene_options* options,
                                              hitpipe_scene** out);
/* The transform that takes the mesh and these points into the cube, as hitpipe_fit() does it with the bounds of all.
 * An integer world takes rays that begin in its cube, so the points are a camera's places, or corners of a box in which
 * rays begin. `points` has point_count * 3 numbers with the bounds of origins. Without triangles and points nothing is
 * moved. */
HITPIPE_API hitpipe_status hitpipe_fit_scene(const hitpipe_mesh* mesh, const float* points, size_t point_count,
                                             hitpipe_transform* out);
/* NULL is allowed. */
HITPIPE_API void hitpipe_scene_close(hitpipe_scene* scene);

typedef struct hitpipe_scene_info {
  const char* world;            /* "float" or "20+1s20"; lives as long as the scene */
  size_t triangles;             /* of the mesh, or of all instances */
  size_t without_area;          /* of these, triangles that are never hit; of instances: without an area on their meshes'
                                   grids */
  int closed;                   /* 1: each edge has an even number of triangles, so inside is defined. Of instances: those
                                   of each mesh */
  int oriented;                 /* 1: each edge is passed as often either way, so signed counts balance */
  size_t odd_edges;             /* edges with an odd number of triangles */
  hitpipe_transform transform;  /* of an integer world; else offset 0 and scale 1 */
} hitpipe_scene_info;
HITPIPE_API hitpipe_status hitpipe_scene_describe(const hitpipe_scene* scene, hitpipe_scene_info* out);

/* New places for all corners: corner_count * 3 numbers. Triangles and branches of the hierarchy stay, and boxes
 * follow, so this is much faster than a new scene; rays take longer the farther corners have moved. The transform
 * stays. After a refusal the scene is as it was. */
HITPIPE_API hitpipe_status hitpipe_scene_move(hitpipe_scene* scene, const float* corners, int threads);

/* ---- Instances: meshes in many places, in an integer world ----
 * Answers are those of one mesh that has all triangles of all instances, instance by instance: a triangle's number is
 * its number in its mesh and the triangles of all instances before. That mesh is never built. docs/instances.md has the
 * definition. Where a matrix mirrors, corners 1 and 2 of each triangle are exchanged, so what was outside stays outside;
 * weights are of the corners in that order. */
typedef struct hitpipe_instance {
  uint32_t mesh;     /* which */
  uint32_t number;   /* yours: hitpipe_parts() gives it back */
  double matrix[12]; /* three rows of four: a corner (x, y, z) is at matrix[0] x + matrix[1] y + matrix[2] z + matrix[3],
                        and so on; it may mirror, and flatten */
  uint8_t mask;      /* rays see the instance if their mask has a bit of it: 0xff is seen, and 0 is not */
} hitpipe_instance;

/* As hitpipe_scene_open() for meshes and instances. The world is an integer one, and options->hierarchy is NULL. Each
 * mesh has a triangle. Without options->transform, all instances' boxes are fitted. HITPIPE_BAD_INSTANCE names the first
 * bad instance: a mesh that is not there, a matrix that is not finite, or one that leaves the cube. */
HITPIPE_API hitpipe_status hitpipe_scene_open_instances(const hitpipe_mesh* meshes, size_t mesh_count,
                                                        const hitpipe_instance* instances, size_t instance_count,
                                                        const hitpipe_scene_options* options, hitpipe_scene** out);
/* hitpipe_fit_scene() for them. */
HITPIPE_API hitpipe_status hitpipe_fit_instances(const hitpipe_mesh* meshes, size_t mesh_count,
                                                 const hitpipe_instance* instances, size_t instance_count,
                                                 const float* points, size_t point_count, hitpipe_transform* out);
/* New matrices, `count` times 12 numbers, for the instances from `first` on. The transform stays. It waits until nobody
 * asks the scene. After a refusal the scene is as it was. */
HITPIPE_API hitpipe_status hitpipe_scene_place(hitpipe_scene* scene, size_t first, const double* matrices, size_t count,
                                               int threads);
/* The same scene for rays that have this mask. hitpipe_scene_close() frees it, and only the last one frees the scene:
 * what one moves, all have moved. */
HITPIPE_API hitpipe_status hitpipe_scene_masked(const hitpipe_scene* scene, uint8_t mask, hitpipe_scene** out);

/* What a triangle of an answer is. */
typedef struct hitpipe_part {
  uint32_t instance; /* which */
  uint32_t number;   /* yours of that instance */
  uint32_t mesh;
  uint32_t triangle; /* of that mesh */
} hitpipe_part;
/* Of HITPIPE_NO_TRIANGLE all four are HITPIPE_NO_TRIANGLE. A scene without instances has one, of one mesh. */
HITPIPE_API hitpipe_status hitpipe_parts(const hitpipe_scene* scene, const uint32_t* triangles, size_t count,
                                         hitpipe_part* out);

/* ---- Questions ----
 * Rays are in the units of the mesh: the points origin + t * direction, 0 <= t <= length. Origins are up to 2^24 in
 * magnitude, and in an integer world in its cube. All rays are checked before anything is written; HITPIPE_BAD_RAY
 * names the first bad one. `threads`: as above. Arrays have one element for each ray unless they say otherwise. */

#define HITPIPE_NO_TRIANGLE 0xffffffffu

/* The nearest hit. Each pointer may be NULL. */
typedef struct hitpipe_nearest_out {
  uint32_t* triangle; /* its number, or HITPIPE_NO_TRIANGLE */
  double* t;          /* in units of the ray's direction; INFINITY: no hit. Float world: the exact number, rounded down to
                         a double; integer world: hitpipe_own_distance() of the core's T */
  double* weights;    /* ray_count * 3: of the triangle's corners, likewise, each >= 0; 0 if there is no hit */
} hitpipe_nearest_out;
HITPIPE_API hitpipe_status hitpipe_nearest(const hitpipe_scene* scene, const hitpipe_ray* rays, size_t ray_count,
                                           int threads, const hitpipe_nearest_out* out);

/* met[i] = 1 if the ray hits any triangle, else 0. */
HITPIPE_API hitpipe_status hitpipe_any(const hitpipe_scene* scene, const hitpipe_ray* rays, size_t ray_count,
                                       int threads, uint8_t* met);

/* Crossings along the ray, and the sum of their sides: 1 where it leaves a mesh whose triangles are counter-clockwise
 * from outside, -1 where it enters. Each pointer may be NULL. */
HITPIPE_API hitpipe_status hitpipe_count(const hitpipe_scene* scene, const hitpipe_ray* rays, size_t ray_count,
                                         int threads, uint32_t* crossings, int32_t* sides);

/* All crossings, those of each ray from near to far, at the same t by number. Those of ray i are at offsets[i] to
 * offsets[i + 1] - 1, so there are ray_count + 1 offsets, which are always written. The others are written if
 * `capacity` elements hold all of them, and else not at all: then ask again with offsets[ray_count]. */
typedef struct hitpipe_all_out {
  uint64_t* offsets;  /* ray_count + 1; not NULL */
  size_t capacity;    /* of each of the next three, which may be NULL */
  uint32_t* triangle;
  double* t;          /* as of the nearest hit */
  int8_t* side;       /* 1 or -1, as hitpipe_count() sums them */
} hitpipe_all_out;
HITPIPE_API hitpipe_status hitpipe_all(const hitpipe_scene* scene, const hitpipe_ray* rays, size_t ray_count,
                                       int threads, const hitpipe_all_out* out);

/* inside[i] = 1 if point i is inside the closed mesh, else 0. Inside is the even-odd rule: a ray from there crosses the
 * mesh an odd number of times. So what two overlapping solids share is not inside, nor is a solid in another one. Of an
 * oriented mesh hitpipe_count() has the winding number of a point as the sum of sides of any ray without an end from
 * there: how many solids that are counter-clockwise from outside hold it, less how many that are turned; 0 is outside.
 * A point on the mesh is on either side. `points` has
 * point_count * 3 numbers with the bounds of origins. HITPIPE_NOT_CLOSED: the mesh is not. */
HITPIPE_API hitpipe_status hitpipe_inside(const hitpipe_scene* scene, const float* points, size_t point_count,
                                          int threads, uint8_t* inside);

/* ---- For a host of the traversal core (docs/core.md): scenes of an integer world ----
 * HITPIPE_BAD_FORMAT: the scene is of the float world. */

/* A ray as the core's integer door takes it. The origin is in units of the grid of n+g bits, the direction in units of
 * 2^-S of its largest component, T in units of 2^-F of the origin's. */
typedef struct hitpipe_integer_ray {
  int64_t origin[3];
  int64_t direction[3];
  uint8_t negative[3]; /* 1: the direction is negative along the axis, also where it was rounded to 0 */
  uint8_t major;       /* axis of the largest component */
  int64_t length;      /* of T */
} hitpipe_integer_ray;
HITPIPE_API hitpipe_status hitpipe_integer_rays(const hitpipe_scene* scene, const hitpipe_ray* rays, size_t ray_count,
                                                hitpipe_integer_ray* out);

/* T of an answer as t of the ray, in units of its direction. */
HITPIPE_API hitpipe_status hitpipe_own_distance(const hitpipe_scene* scene, const hitpipe_ray* ray, int64_t core_t,
                                                double* t);

/* The image that the core reads from memory: *size bytes, written if `capacity` holds them. `bytes` may be NULL. */
HITPIPE_API hitpipe_status hitpipe_core_image(const hitpipe_scene* scene, uint8_t* bytes, size_t capacity, size_t* size);

#ifdef __cplusplus
}
#endif
#endif
