# emit_all built twice: by the compiler of this build and, from the same sources, by the other of g++ and clang++.
add_executable(rtl_emit_all emit/emit_all.cpp)
target_link_libraries(rtl_emit_all PRIVATE hitpipe_rtl_gen hitpipe_compile)

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  find_program(HITPIPE_OTHER_CXX clang++ DOC "A second C++ compiler, to compare what both emit")
else()
  find_program(HITPIPE_OTHER_CXX g++ DOC "A second C++ compiler, to compare what both emit")
endif()

# What a sanitizer watches, the first compiler's build runs.
if(HITPIPE_OTHER_CXX AND NOT HITPIPE_SANITIZE)
  get_target_property(rtl_sources hitpipe_rtl_gen SOURCES)
  get_target_property(rtl_folder hitpipe_rtl_gen SOURCE_DIR)
  set(objects "")
  foreach(source IN LISTS rtl_sources ITEMS ${CMAKE_CURRENT_SOURCE_DIR}/emit/emit_all.cpp)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${rtl_folder})
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME folder)
    cmake_path(GET source FILENAME name)
    set(object ${CMAKE_CURRENT_BINARY_DIR}/other_compiler/${folder}_${name}.o)
    add_custom_command(OUTPUT ${object}
      COMMAND ${HITPIPE_OTHER_CXX} -std=c++20 -O0 -DHITPIPE_FEW_FORMATS -I${PROJECT_SOURCE_DIR}
              -I${PROJECT_BINARY_DIR}/generated -MD -MF ${object}.d -c ${source} -o ${object}
      DEPENDS ${source} DEPFILE ${object}.d
      COMMENT "Compiling ${folder}/${name} with the other compiler" VERBATIM)
    list(APPEND objects ${object})
  endforeach()
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/other_compiler)
  set(other_emit_all ${CMAKE_CURRENT_BINARY_DIR}/other_compiler/emit_all)
  add_custom_command(OUTPUT ${other_emit_all}
    COMMAND ${HITPIPE_OTHER_CXX} ${objects} -lfmt -o ${other_emit_all}
    DEPENDS ${objects} COMMENT "Linking emit_all with the other compiler" VERBATIM)
  add_custom_target(rtl_emit_all_other DEPENDS ${other_emit_all})

  hitpipe_test(rtl_compilers_test SOURCES emit/compilers_test.cpp LIBS fmt::fmt)
  add_dependencies(rtl_compilers_test rtl_emit_all rtl_emit_all_other)
  target_include_directories(rtl_compilers_test PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(rtl_compilers_test PRIVATE
    HITPIPE_EMIT_ALL="$<TARGET_FILE:rtl_emit_all>" HITPIPE_EMIT_ALL_OTHER="${other_emit_all}")
elseif(NOT HITPIPE_OTHER_CXX)
  message(STATUS "No second C++ compiler: what g++ and clang++ emit is not compared")
endif()
