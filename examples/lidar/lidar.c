/* A lidar in a hall of 20 by 10 by 4 metres with a pillar: what it measures in each direction of a turn. */
#include <hitpipe/scene.h>
#include <math.h>
#include <stdio.h>

enum { beams = 360 };
static const float corners[][3] = {{-10, -5, 0}, {10, -5, 0}, {10, 5, 0}, {-10, 5, 0}, {-10, -5, 4}, {10, -5, 4},
                                   {10, 5, 4},   {-10, 5, 4}, {3, -1, 0}, {4, 0, 0},   {3, 1, 0},    {3, -1, 4},
                                   {4, 0, 4},    {3, 1, 4}};
static const uint32_t walls[][3] = {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7},   {2, 7, 6},   {3, 0, 4},
                                    {3, 4, 7}, {8, 9, 12}, {8, 12, 11}, {9, 10, 13}, {9, 13, 12}, {10, 8, 11}, {10, 11, 13}};

int main(void) {
  const hitpipe_mesh mesh = {corners[0], sizeof corners / sizeof *corners, walls[0], sizeof walls / sizeof *walls};
  hitpipe_ray rays[beams];
  for (int i = 0; i < beams; ++i) {
    const double angle = i * 3.14159265358979 / 180;
    rays[i] = (hitpipe_ray){{0, 0, 1.5f}, {(float)cos(angle), (float)sin(angle), 0}, 30};
  }
  double metres[beams];
  const hitpipe_nearest_out out = {NULL, metres, NULL};
  hitpipe_scene* scene = NULL;
  if (hitpipe_scene_open(&mesh, NULL, &scene) != HITPIPE_OK || hitpipe_nearest(scene, rays, beams, 0, &out) != HITPIPE_OK)
    return fprintf(stderr, "lidar: %s\n", hitpipe_error()), 2;
  for (int i = 0; i < beams; i += 30) printf("%3d degrees: %6.3f m\n", i, metres[i]);
  hitpipe_scene_close(scene);
  return 0;
}
