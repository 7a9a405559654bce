# Box tests and traversals.
foreach(name traverse/adaptive_slabs traverse/tracer)
  get_filename_component(program ${name} NAME)
  hitpipe_test(${program}_test IN sw_ref_tests SOURCES ${name}_test.cpp LIBS hitpipe_sw_ref fmt::fmt)
endforeach()
hitpipe_test(pair_test IN sw_ref_tests SOURCES traverse/pair_test.cpp LIBS hitpipe_sw_ref fmt::fmt)
