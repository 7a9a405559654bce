# Box tests and traversals.
foreach(name traverse/tracer)
  get_filename_component(program ${name} NAME)
  hitpipe_test(${program}_test SOURCES ${name}_test.cpp LIBS hitpipe_sw_ref fmt::fmt)
endforeach()
