/* My ray, my box: the operands that the unit gets, its HIT, and the exact answer. */
#include <hitpipe/ref.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void check(hitpipe_status status) {
  if (status == HITPIPE_OK) return;
  fprintf(stderr, "one_box: %s\n", hitpipe_error());
  exit(2);
}

int main(int argc, char** argv) {
  const hitpipe_ray ray = {{-1, 0.5f, 0}, {1, -0.5f, 0.125f}, INFINITY};
  const hitpipe_box box = {{0.25f, -0.25f, 0}, {0.5f, 0, 0.25f}};
  hitpipe_unit* unit = NULL;
  check(hitpipe_open(argc > 1 ? argv[1] : "int_slabs", argc > 2 ? argv[2] : "", &unit));
  check(hitpipe_set_ray(unit, &ray));

  int64_t operands[64];
  uint8_t hit = 0, exact = 0;
  const hitpipe_answers answers = {&hit, &exact, operands, NULL};
  check(hitpipe_test(unit, &box, 1, &answers));
  for (size_t i = 0; i < hitpipe_port_count(unit); ++i) {
    hitpipe_port_info port;
    check(hitpipe_port(unit, i, &port));
    printf("%-12s %2d bits %" PRIx64 "\n", port.name, port.width, hitpipe_bits(operands[i], port.width));
  }
  printf("HIT %d, exact %d\n", hit, exact);
  hitpipe_close(unit);
  return exact && !hit; /* a false miss */
}
