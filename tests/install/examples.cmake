# Builds and runs the examples against the prefix. Damage to Verilog, to an operand or to an image makes them fail.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK})

build(${SOURCE}/examples/one_box ${WORK}/one_box "-DCMAKE_C_FLAGS=-std=c99 -Wall -Wextra -Wpedantic -Werror")
expect(0 "HIT 1, exact 1\n$" ${WORK}/one_box/one_box)
expect(0 "HIT 1, exact 1\n$" ${WORK}/one_box/one_box int_plucker 12/12)
expect(2 "^one_box: bits 3/3: no format of int_slabs" ${WORK}/one_box/one_box int_slabs 3/3)

build(${SOURCE}/examples/lidar ${WORK}/lidar "-DCMAKE_C_FLAGS=-std=c99 -Wall -Wextra -Wpedantic -Werror")
expect(0 "^  0 degrees:  3\\.000 m\n.*\n 90 degrees:  5\\.000 m\n.*\n180 degrees: 10\\.000 m\n" ${WORK}/lidar/lidar)

# Fewer and larger sources: the headers of Verilator take most of the time, and the programs run for a second.
set(soon_compiled -DCMAKE_UNITY_BUILD=ON -DCMAKE_CXX_FLAGS_RELEASE=-O0)
file(COPY ${SOURCE}/examples/verilated_unit DESTINATION ${WORK})
set(example ${WORK}/verilated_unit)
set(built ${WORK}/built)
build(${example} ${built} ${soon_compiled})
expect(0 "^10000 tests in [0-9]+ cycles: [0-9]+ hits, 0 mismatches, 0 false misses\n$" ${built}/verilated_unit)

function(damage file from to)
  file(READ ${file} text)
  string(REPLACE "${from}" "${to}" damaged "${text}")
  if(damaged STREQUAL text)
    message(FATAL_ERROR "${file} has no ${from} to damage")
  endif()
  file(WRITE ${file} "${damaged}")
endfunction()
set(mismatches "^10000 tests in [0-9]+ cycles: [0-9]+ hits, [1-9][0-9]* mismatches, [0-9]+ false misses\n$")

# An operand: two planes exchanged.
file(COPY ${example}/main.cpp DESTINATION ${WORK}/good)
damage(${example}/main.cpp "top.ixmin = o[11]" "top.ixmin = o[12]")
run(${CMAKE_COMMAND} --build ${built})
expect(1 "${mismatches}" ${built}/verilated_unit)
file(COPY ${WORK}/good/main.cpp DESTINATION ${example})
file(TOUCH ${example}/main.cpp)

# The Verilog: one comparison the other way round.
damage(${built}/rtl/int_slabs.v "$signed(it_far) < $signed(it_near)" "$signed(it_near) < $signed(it_far)")
run(${CMAKE_COMMAND} --build ${built})
expect(1 "${mismatches}" ${built}/verilated_unit)

# The core in a system, with the driver as C. A depth map of `hitpipe render --world integer --bits 16+1s16` has as many
# pixels that are not sky.
set(system ${SOURCE}/examples/core_system)
set(built ${WORK}/core_system)
build(${system} ${built} ${soon_compiled})
run(${CXX} -x c -std=c99 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I${built}/rtl ${system}/driver.h)
set(program ${built}/core_system ${built}/scene.bin ${built}/picture.pgm)
expect(0 "^19200 rays, 19200 answers, 11948 hits, 0 failed\n[0-9]+ cycles, [1-9][0-9]* blocks read\n$" ${program})
file(SIZE ${built}/picture.pgm bytes)
if(NOT bytes EQUAL 19215)
  message(FATAL_ERROR "picture.pgm has ${bytes} bytes")
endif()

# What the driver records is judged again.
set(record ${built}/rays.csv ${built}/answers.csv)
expect(0 "^19200 rays, 19200 answers, 11948 hits, 0 failed\n" ${program} ${record})
set(replay ${PREFIX}/bin/hitpipe core replay ${built}/scene.bin --bits 16+1s16 --rays ${built}/rays.csv --answers ${built}/answers.csv)
expect(0 "\nsame +19,200\n" ${replay})

# The library answers the same rays, from a surface of its own.
expect(0 "^1600 rays, 1600 answers, [1-9][0-9]+ hits, 0 differ from the library's\n$" ${CMAKE_COMMAND} -E chdir ${built} ./compare)

# The firmware's picture, on the same chip.
set(firmware ${SOURCE}/examples/litex_core/firmware)
file(WRITE ${WORK}/firmware.cpp "#include <fstream>
#include <iterator>
#include <vector>
#include \"driver.h\"
extern \"C\" {
#include \"picture.h\"
}
uint32_t place_image(const char* file_name);
int main(int, char** arguments) {
  std::ifstream file(arguments[1], std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  const auto* const image = reinterpret_cast<const uint8_t*>(bytes.data());
#if CORE_HAS_RINGS
  uint32_t place_rings(uint32_t bytes);
  const uint32_t place = place_image(arguments[1]), rings = place_rings(PICTURE_RINGS_BYTES);
#else
  const uint32_t place = place_image(arguments[1]), rings = 0;
#endif
  return draw_picture(place, rings, image, bytes.size()) ? 0 : 1;
}
")
function(draw_on chip)
  set(includes -I${chip}/rtl -I${system} -I${firmware})
  run(${CXX} -x c -std=c99 -Wall -Wextra -Wpedantic -Werror ${includes} -c ${firmware}/picture.c -o ${chip}/picture.o)
  run(${CXX} -std=c++20 ${includes} ${WORK}/firmware.cpp ${chip}/picture.o ${chip}/libchip.a -pthread -o ${chip}/firmware)
  string(REPEAT "#" 32 near)
  expect(0 "^ +\n(.*\n)?${near}\n768 answers, 482 hits, 0 failed\n$" ${chip}/firmware ${built}/scene.bin)
endfunction()
draw_on(${built})

# The same with rays in memory.
set(rings ${WORK}/core_with_rings)
build(${system} ${rings} ${soon_compiled} "-DCORE_OPTIONS=--rings --cache 4")
run(${CXX} -x c -std=c99 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I${rings}/rtl ${system}/driver.h)
set(with_rings ${rings}/core_system ${rings}/scene.bin ${rings}/picture.pgm)
expect(0 "^19200 rays, 19200 answers, 11948 hits, 0 failed\n[0-9]+ cycles, [1-9][0-9]* blocks read\n$" ${with_rings})
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${built}/picture.pgm ${rings}/picture.pgm COMMAND_ERROR_IS_FATAL ANY)
draw_on(${rings})
damage(${rings}/rtl/hitpipe_core.v "rings_ray_any, rings_ray_tag}" "rings_ray_any, rings_ray_tag | 16'd1}")
run(${CMAKE_COMMAND} --build ${rings})
expect(1 "^19200 rays, 19200 answers, 11948 hits, 0 failed\n" ${with_rings})
# The image: its second half is missing. The driver does not start.
file(SIZE ${built}/scene.bin bytes)
math(EXPR half "${bytes} / 2")
execute_process(COMMAND head -c ${half} ${built}/scene.bin OUTPUT_FILE ${built}/half.bin COMMAND_ERROR_IS_FATAL ANY)
expect(1 "^${built}/half.bin: the image is cut\n$" ${built}/core_system ${built}/half.bin ${built}/picture.pgm)
expect(1 "^the image is cut\n$" ${built}/firmware ${built}/half.bin)

# The Verilog: the core is given another tag, so a pixel has two answers and another has none.
damage(${built}/rtl/hitpipe_core_axi.v ".ray_tag(s_axis_ray_tid)" ".ray_tag(s_axis_ray_tid | 16'd1)")
run(${CMAKE_COMMAND} --build ${built})
expect(1 "^19200 rays, 19200 answers, 11948 hits, 0 failed\n" ${program})
