# Renderer: the rays that a hit causes, and images apart.
foreach(name render/whitted render/image_compare)
  get_filename_component(program ${name} NAME)
  hitpipe_test(${program}_test SOURCES ${name}_test.cpp LIBS hitpipe_sw_ref fmt::fmt)
endforeach()
target_sources(whitted_test PRIVATE render/ray_causes_test.cpp render/stiff_rays_test.cpp)
