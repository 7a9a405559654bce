# Warnings and sanitizers that every target of the project shares.
add_library(hitpipe_compile INTERFACE)
target_compile_options(hitpipe_compile INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
# Each object serves the program and hitpipe::ref, which exports what its headers declare and holds what they reach.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
target_compile_options(hitpipe_compile INTERFACE -ffunction-sections -fdata-sections)
# No path of the machine that built it is in a program: names of sources begin at the root of the tree.
target_compile_options(hitpipe_compile INTERFACE
  -ffile-prefix-map=${PROJECT_SOURCE_DIR}/= -ffile-prefix-map=${PROJECT_BINARY_DIR}/=)
# A product and a sum stay two roundings, so that pictures are the same on every machine.
target_compile_options(hitpipe_compile INTERFACE -ffp-contract=off)
# Where g++ 12 puts neighbours into one vector, it takes double(float(x)) for x.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(hitpipe_compile INTERFACE -fno-tree-slp-vectorize)
endif()
if(HITPIPE_WERROR)
  target_compile_options(hitpipe_compile INTERFACE -Werror)
endif()
if(HITPIPE_SANITIZE)
  target_compile_options(hitpipe_compile INTERFACE
    -fsanitize=${HITPIPE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(hitpipe_compile INTERFACE -fsanitize=${HITPIPE_SANITIZE})
endif()

# A source that is chosen at run time, so it alone is compiled for AVX2. With -O2 in every build: what it shares with other sources
# is then inlined, and the linker has no copy for AVX2 to give to them. A folder says it of its own targets.
function(hitpipe_compile_for_avx2 source)
  set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|amd64")
    set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS "-mavx2;-O2")
  endif()
endfunction()

# The headers that nearly every source reads, compiled once. A target reads them with REUSE_FROM hitpipe_headers.
if(NOT HITPIPE_TOOLS)
  return()
endif()
find_package(fmt REQUIRED)
add_library(hitpipe_headers OBJECT ${CMAKE_CURRENT_LIST_DIR}/headers.cpp)
target_link_libraries(hitpipe_headers PRIVATE hitpipe_compile fmt::fmt-header-only)
target_precompile_headers(hitpipe_headers PRIVATE
  <fmt/format.h> <fmt/ranges.h> <algorithm> <array> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map>
  <memory> <optional> <span> <stdexcept> <string> <utility> <vector>)