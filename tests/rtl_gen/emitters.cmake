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
  get_target_property(design_sources hitpipe_designs SOURCES)
  list(FILTER rtl_sources EXCLUDE REGEX TARGET_OBJECTS)
  list(APPEND rtl_sources ${design_sources})
  get_target_property(rtl_folder hitpipe_rtl_gen SOURCE_DIR)
  # All in one file: most of the time goes into headers.
  set(other_compiler ${CMAKE_CURRENT_BINARY_DIR}/other_compiler)
  set(includes "")
  foreach(source IN LISTS rtl_sources ITEMS ${CMAKE_CURRENT_SOURCE_DIR}/emit/emit_all.cpp)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${rtl_folder})
    string(APPEND includes "#include \"${source}\"\n")
  endforeach()
  file(GENERATE OUTPUT ${other_compiler}/all.cpp CONTENT "${includes}")
  set(other_emit_all ${other_compiler}/emit_all)
  add_custom_command(OUTPUT ${other_emit_all}
    COMMAND ${HITPIPE_OTHER_CXX} -std=c++20 -O0 -DHITPIPE_VERSION="${PROJECT_VERSION}" -I${PROJECT_SOURCE_DIR} -I${PROJECT_BINARY_DIR}/generated
            -MD -MF ${other_emit_all}.d -MT ${other_emit_all} ${other_compiler}/all.cpp $<TARGET_FILE:hitpipe_host> -lfmt -ltbb -o ${other_emit_all}
    DEPENDS ${other_compiler}/all.cpp hitpipe_host DEPFILE ${other_emit_all}.d
    COMMENT "Building emit_all with the other compiler" VERBATIM)
  add_custom_target(rtl_emit_all_other ALL DEPENDS ${other_emit_all})

  hitpipe_test(rtl_compilers_test IN rtl_gen_tests SOURCES emit/compilers_test.cpp LIBS hitpipe_host fmt::fmt
    DEFINITIONS HITPIPE_EMIT_ALL="$<TARGET_FILE:rtl_emit_all>" HITPIPE_EMIT_ALL_OTHER="${other_emit_all}")
  add_dependencies(rtl_compilers_test rtl_emit_all rtl_emit_all_other)
elseif(NOT HITPIPE_OTHER_CXX)
  message(STATUS "No second C++ compiler: what g++ and clang++ emit is not compared")
endif()
