# Exact arithmetic: referee, triangle test, quantisation; the adversary and what it shows.
foreach(name exact/box_referee exact/triangle_test exact/triangle_mesh quantise/coarse_axes quantise/int_box
             quantise/fp_slabs_safe_ray quantise/int_slabs_ray quantise/int_major_ray quantise/fine_grid quantise/int_slabs quantise/int_plucker_ray quantise/float_ray adversary/categories adversary/false_miss
             adversary/neighbours adversary/shrink adversary/replay)
  get_filename_component(program ${name} NAME)
  hitpipe_test(${program}_test IN sw_ref_tests SOURCES ${name}_test.cpp LIBS hitpipe_sw_ref fmt::fmt)
endforeach()
