# hitpipe_sources_hash(HEADER FOLDER...) makes the header, which defines HITPIPE_SOURCES_HASH: 8 hexadecimal digits of a hash of the
# sources and tables in these folders of the project, and of their names. The build makes it again when a file changes.
function(hitpipe_sources_hash header)
  set(patterns "")
  foreach(folder ${ARGN})
    foreach(ending cpp hpp h json csv in)
      list(APPEND patterns ${PROJECT_SOURCE_DIR}/${folder}/*.${ending})
    endforeach()
  endforeach()
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${patterns})
  list(JOIN files "\n" text)
  set(names ${header}.files)
  file(CONFIGURE OUTPUT ${names} CONTENT "${text}" @ONLY)
  set(command ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DNAMES=${names} -DHEADER=${header} -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE})
  if(NOT EXISTS ${header})  # for tools that read the sources and build nothing
    execute_process(COMMAND ${command} COMMAND_ERROR_IS_FATAL ANY)
  endif()
  add_custom_command(OUTPUT ${header}
    COMMAND ${command}
    DEPENDS ${files} ${names} ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    COMMENT "Hashing the sources" VERBATIM)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  file(STRINGS ${NAMES} files)
  set(text "")
  foreach(file ${files})
    file(RELATIVE_PATH name ${SOURCE} ${file})
    file(SHA256 ${file} hash)
    string(APPEND text "${name} ${hash}\n")
  endforeach()
  string(SHA256 hash "${text}")
  string(SUBSTRING ${hash} 0 8 hash)
  file(WRITE ${HEADER} "#pragma once\n#define HITPIPE_SOURCES_HASH \"${hash}\"\n")
endif()
