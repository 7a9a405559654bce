# hitpipe_embed_json(VARIABLE TYPE FOLDER) sets the variable to the JSON files of a folder as C++: for each file an element
# TYPE{"its name", "its text"} of an array. A file that comes, goes or changes has the build configured again.
function(hitpipe_embed_json variable type folder)
  file(GLOB files CONFIGURE_DEPENDS ${folder}/*.json)
  set(elements "")
  foreach(file ${files})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    get_filename_component(name ${file} NAME_WE)
    file(READ ${file} text)
    string(APPEND elements "      ${type}{\"${name}\", R\"json(${text})json\"},\n")
  endforeach()
  set(${variable} "${elements}" PARENT_SCOPE)
endfunction()
