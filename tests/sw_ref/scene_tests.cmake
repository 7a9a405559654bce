# Scenes, mesh files, hierarchy, box tests, traversal, renderer.
foreach(name scene/mesh_file scene/scene scene/spheres bvh/build traverse/slabs traverse/traversal render/shade
             render/image_file render/render)
  get_filename_component(program ${name} NAME)
  hitpipe_test(${program}_test SOURCES ${name}_test.cpp LIBS hitpipe_sw_ref fmt::fmt)
endforeach()
target_sources(build_test PRIVATE bvh/builders_test.cpp bvh/statistics_test.cpp)
target_link_libraries(image_file_test PRIVATE OpenImageIO::OpenImageIO)
target_sources(scene_test PRIVATE scene/built_in_test.cpp scene/city_test.cpp scene/obj_material_test.cpp scene/scene_file_test.cpp
  scene/reading_room_test.cpp scene/terrain_test.cpp scene/triangle_numbers_test.cpp)
hitpipe_test(bvh_file_test SOURCES bvh/bvh_file_test.cpp bvh/triangle_cover_test.cpp LIBS hitpipe_sw_ref fmt::fmt)
