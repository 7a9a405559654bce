# hitpipe_embed(VARIABLE TYPE PART PATTERN...) sets the variable to files as C++: for each file an element TYPE{"its name", "its text"}
# of an array. PART is the part of the path that is its name, as get_filename_component says it: NAME, or NAME_WE without the ending.
# A file that comes, goes or changes has the build configured again.
function(hitpipe_embed variable type part)
  file(GLOB files CONFIGURE_DEPENDS ${ARGN})
  set(elements "")
  foreach(file ${files})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    get_filename_component(name ${file} ${part})
    file(READ ${file} text)
    string(APPEND elements "      ${type}{\"${name}\", R\"text(${text})text\"},\n")
  endforeach()
  set(${variable} "${elements}" PARENT_SCOPE)
endfunction()
