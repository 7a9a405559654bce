# What the scripts of this folder share.

# Runs a command; one that fails ends the test with what it printed. `printed` is its output.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT code EQUAL 0)
    list(JOIN ARGV " " command)
    message(FATAL_ERROR "${command}\n${out}")
  endif()
  set(printed "${out}" PARENT_SCOPE)
endfunction()

# Runs a program that must end with this code and print a line that matches.
function(expect code pattern)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE ended OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT ended EQUAL code OR NOT out MATCHES "${pattern}")
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${ended}, not ${code}, or printed nothing like ${pattern}:\n${out}")
  endif()
endfunction()

# Configures and builds a stranger's project against the prefix.
function(build source folder)
  run(${CMAKE_COMMAND} -S ${source} -B ${folder} -DCMAKE_PREFIX_PATH=${PREFIX} -DCMAKE_CXX_COMPILER=${CXX} ${ARGN})
  run(${CMAKE_COMMAND} --build ${folder})
endfunction()
