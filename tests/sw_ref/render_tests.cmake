# Renderer: the rays that a hit causes, and images apart.
hitpipe_test(whitted_test IN sw_ref_tests SOURCES render/whitted_test.cpp render/ray_causes_test.cpp render/stiff_rays_test.cpp
  LIBS hitpipe_sw_ref fmt::fmt)
hitpipe_test(image_compare_test IN sw_ref_tests SOURCES render/image_compare_test.cpp LIBS hitpipe_sw_ref fmt::fmt)
