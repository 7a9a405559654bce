# Scenes, mesh files, hierarchy, box tests, traversal, renderer.
foreach(name scene/mesh_file scene/spheres traverse/slabs traverse/traversal render/shade render/render)
  get_filename_component(program ${name} NAME)
  hitpipe_test(${program}_test IN sw_ref_tests SOURCES ${name}_test.cpp LIBS hitpipe_sw_ref fmt::fmt)
endforeach()
hitpipe_test(build_test IN sw_ref_tests SOURCES bvh/build_test.cpp bvh/builders_test.cpp bvh/statistics_test.cpp
  LIBS hitpipe_sw_ref fmt::fmt)
hitpipe_test(image_file_test IN sw_ref_tests SOURCES render/image_file_test.cpp
  LIBS hitpipe_sw_ref fmt::fmt OpenImageIO::OpenImageIO)
hitpipe_test(scene_test IN sw_ref_tests SOURCES scene/scene_test.cpp scene/built_in_test.cpp scene/city_test.cpp
  scene/obj_material_test.cpp scene/scene_file_test.cpp scene/reading_room_test.cpp scene/terrain_test.cpp
  scene/triangle_numbers_test.cpp LIBS hitpipe_sw_ref fmt::fmt)
hitpipe_test(bvh_file_test IN sw_ref_tests SOURCES bvh/bvh_file_test.cpp bvh/triangle_cover_test.cpp LIBS hitpipe_sw_ref fmt::fmt)
