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

# The text of the n-th block of this language on a page, which `page` names.
function(fence language n out)
  file(READ ${SOURCE}/${page} rest)
  foreach(i RANGE 1 ${n})
    string(FIND "${rest}" "```${language}\n" from)
    if(from EQUAL -1)
      message(FATAL_ERROR "${page} has no block ${n} of ${language}")
    endif()
    string(LENGTH "```${language}\n" opening)
    math(EXPR from "${from} + ${opening}")
    string(SUBSTRING "${rest}" ${from} -1 rest)
  endforeach()
  string(FIND "${rest}" "```" to)
  string(SUBSTRING "${rest}" 0 ${to} text)
  set(${out} "${text}" PARENT_SCOPE)
endfunction()
