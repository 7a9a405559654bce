/* A small picture by the core, as text: a processor without floats has time for it. */
#include "picture.h"

#include <stdio.h>

#include "driver.h"

enum { width = 32, height = 24, pixels = width * height }; /* a pixel's number is its ray's tag */

/* The camera of ../../core_system, worked out: the scene `spheres` in the image's cube. The direction is as
   long as it comes, and its part along the line of sight is one. */
static const float eye[3] = {0.054294752f, -0.0380063264f, 0.999023438f};
static const float ahead[3] = {-0.0513637309f, -0.254764105f, -0.96563814f};
static const float right[3] = {0.0147341114f, 0, -0.000783729329f};
static const float up[3] = {-0.000199666101f, 0.0142680752f, -0.0037537227f};

static struct core_ray camera_ray(int pixel) {
  const float x = (float)(2 * (pixel % width) + 1 - width);
  const float y = (float)(height - 1 - 2 * (pixel / width));
  struct core_ray ray = {0};
  ray.ox = eye[0], ray.oy = eye[1], ray.oz = eye[2];
  ray.dx = ahead[0] + x * right[0] + y * up[0];
  ray.dy = ahead[1] + x * right[1] + y * up[1];
  ray.dz = ahead[2] + x * right[2] + y * up[2];
  ray.len = __builtin_inff();
  return ray;
}

static float size_of(float number) {
  return number < 0 ? -number : number;
}

/* The nearer, the fuller. T counts along the largest component of the direction. */
static char letter_of(const struct core_hit* hit, const struct core_ray* ray) {
  static const char letters[] = "@%#*+=-:.";
  float largest = size_of(ray->dx);
  if (size_of(ray->dy) > largest) largest = size_of(ray->dy);
  if (size_of(ray->dz) > largest) largest = size_of(ray->dz);
  const float depth = (float)hit->t / CORE_T_ONE / largest;
  const int letter = (int)((depth - 0.5f) * 12);
  return letters[letter < 0 ? 0 : letter > 8 ? 8 : letter];
}

bool draw_picture(uint64_t image, uint32_t blocks) {
  static char picture[pixels];
  static uint8_t answers[pixels];
  int sent = 0, taken = 0, hits = 0, failed = 0;
  if (!core_start(image, blocks)) {
    printf("no core\n");
    return false;
  }
  for (long silent = 0; taken < pixels && silent < 100000; ++silent) {
    if (sent < pixels) {
      const struct core_ray ray = camera_ray(sent);
      if (core_send((uint32_t)sent, &ray)) ++sent;
    }
    uint32_t pixel;
    struct core_hit hit;
    while (core_take(&pixel, &hit)) {
      silent = 0;
      ++taken;
      if (pixel >= pixels) return false;
      ++answers[pixel];
      failed += hit.failed != 0;
      picture[pixel] = ' ';
      if (hit.failed || hit.number == CORE_NO_HIT) continue;
      ++hits;
      const struct core_ray ray = camera_ray((int)pixel);
      picture[pixel] = letter_of(&hit, &ray);
    }
  }
  bool once = true;
  for (int pixel = 0; pixel < pixels; ++pixel) once = once && answers[pixel] == 1;
  for (int row = 0; row < height; ++row) printf("%.*s\n", width, picture + row * width);
  printf("%d answers, %d hits, %d failed\n", taken, hits, failed);
  /* The core has counted the same. */
  return once && failed == 0 && core_count(CORE_COUNT_RAYS) == pixels &&
         core_count(CORE_COUNT_ANSWERS) == pixels && core_count(CORE_COUNT_HITS) == (uint64_t)hits;
}
