# Node encodings, integer box tests, and the box tests of chapter 3.
foreach(name encode/encode encode/int_nodes traverse/int_box_test traverse/int_major box_tests/box_tests)
  get_filename_component(program ${name} NAME)
  hitpipe_test(${program}_test IN sw_ref_tests SOURCES ${name}_test.cpp LIBS hitpipe_sw_ref fmt::fmt)
endforeach()
