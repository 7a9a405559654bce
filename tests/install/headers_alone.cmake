# Configures the headers alone, installs them, builds and runs the consumer against what was installed.
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK})
set(PREFIX ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/hls -DHITPIPE_TOOLS=OFF -DCMAKE_CXX_COMPILER=${CXX})
run(${CMAKE_COMMAND} --install ${WORK}/hls --prefix ${PREFIX})
build(${SOURCE}/tests/install/consumer ${WORK}/consumer)
run(${WORK}/consumer/consumer)
# The library is not there, and asking for it says so.
expect(1 "hitpipe_FOUND to FALSE" ${CMAKE_COMMAND} -S ${SOURCE}/examples/one_box -B ${WORK}/one_box -DCMAKE_PREFIX_PATH=${PREFIX})
