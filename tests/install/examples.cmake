# Builds and runs the examples against the prefix. Damage to the Verilog or to one operand makes the Verilated one fail.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK})

build(${SOURCE}/examples/one_box ${WORK}/one_box "-DCMAKE_C_FLAGS=-std=c99 -Wall -Wextra -Wpedantic -Werror")
expect(0 "HIT 1, exact 1\n$" ${WORK}/one_box/one_box)
expect(0 "HIT 1, exact 1\n$" ${WORK}/one_box/one_box int_plucker 12/12)
expect(2 "^one_box: bits 3/3: no format of int_slabs" ${WORK}/one_box/one_box int_slabs 3/3)

# Fewer and larger sources: the headers of Verilator take most of the time.
file(COPY ${SOURCE}/examples/verilated_unit DESTINATION ${WORK})
set(example ${WORK}/verilated_unit)
set(built ${WORK}/built)
build(${example} ${built} -DCMAKE_UNITY_BUILD=ON)
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
