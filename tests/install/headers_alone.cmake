# Configures the headers alone, installs them, and builds and runs against them the program that docs/designs.md prints.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK})
set(PREFIX ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/hls -DHITPIPE_TOOLS=OFF -DCMAKE_CXX_COMPILER=${CXX})
run(${CMAKE_COMMAND} --install ${WORK}/hls --prefix ${PREFIX})
set(page docs/designs.md)
fence(cpp 1 program)
file(WRITE ${WORK}/source/consumer.cpp "${program}")
file(COPY ${SOURCE}/tests/install/consumer/CMakeLists.txt DESTINATION ${WORK}/source)
build(${WORK}/source ${WORK}/consumer)
expect(0 "^HIT 1\n$" ${WORK}/consumer/consumer)
# The library is not there, and asking for it says so.
expect(1 "hitpipe_FOUND to FALSE" ${CMAKE_COMMAND} -S ${SOURCE}/examples/one_box -B ${WORK}/one_box -DCMAKE_PREFIX_PATH=${PREFIX})
