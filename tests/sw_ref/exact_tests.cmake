# Exact arithmetic: referee, triangle test, quantisation.
foreach(name exact/box_referee exact/triangle_test exact/triangle_mesh quantise/int_box quantise/int_ray quantise/int_slabs)
  get_filename_component(program ${name} NAME)
  hitpipe_test(${program}_test SOURCES ${name}_test.cpp LIBS hitpipe_sw_ref fmt::fmt)
endforeach()
