# The designs: one line each, in the order in which the program lists them. NAME stands for
#   hls/pipelines/NAME.hpp     its pipeline, a struct that is called after the file: IntSlabs of int_slabs
#   rtl_gen/designs/NAME.cpp   only if there is more to say than the struct, such as rows of the thesis's table
#   sim/designs/NAME.cpp       what software knows of it: set-up of rays and boxes, software traversal
# docs/designs.md tells how to add one.
set(HITPIPE_DESIGNS
  fp_slabs
  int_slabs
  fp_plucker
  int_plucker
  fp_plucker_direct
  int_major
  int_major_pair
  fp_slabs_safe
  int_triangle
  int_ray
)

# The machines: one line each. NAME stands for hls/machines/NAME.hpp, with a struct called after the file.
set(HITPIPE_MACHINES
  divider
  walker
  reader
  best_hits
  door
  pair_feed
  triangle_feed
  ties
  serial_triangle
  replies
  weights
  registers
  requests
  beats
  scene_memory
  cache
  rings
  read_meter
  epoch
)

# What a core may have, in the order in which they change it: one line each. NAME stands for rtl_gen/core/features/NAME.cpp
# (docs/features.md).
set(HITPIPE_CORE_FEATURES
  base
  serial_triangle
  float_door
  cache
  rings
  weights
  questions
  read_meter
)
