# What find_package(hitpipe) finds. Each part has its targets in a file of its own, so the headers can be installed alone.
include(GNUInstallDirs)
# Parts of an installation, `cmake --install build --component NAME`: program, library, python, docs.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/hitpipe)

install(EXPORT hitpipe_hls NAMESPACE hitpipe:: DESTINATION ${package_folder} COMPONENT library)
set(pointer_bytes "")  # headers serve all
if(HITPIPE_TOOLS)
  install(EXPORT hitpipe_ref NAMESPACE hitpipe:: DESTINATION ${package_folder} COMPONENT library)
  install(EXPORT hitpipe_program NAMESPACE hitpipe:: DESTINATION ${package_folder} COMPONENT program)
  set(pointer_bytes ${CMAKE_SIZEOF_VOID_P})
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/hitpipeConfig.cmake.in ${PROJECT_BINARY_DIR}/hitpipeConfig.cmake
  INSTALL_DESTINATION ${package_folder})
configure_file(${CMAKE_CURRENT_LIST_DIR}/hitpipeConfigVersion.cmake.in ${PROJECT_BINARY_DIR}/hitpipeConfigVersion.cmake @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/hitpipeConfig.cmake ${PROJECT_BINARY_DIR}/hitpipeConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT library)

foreach(component library program docs)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT ${component})
endforeach()
# Pages and examples lie as in the source, so that links lead to them.
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT docs)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT docs
        FILES_MATCHING PATTERN *.md PATTERN *.svg PATTERN *.png PATTERN *.csv)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT docs
        PATTERN build EXCLUDE PATTERN sim_build EXCLUDE PATTERN __pycache__ EXCLUDE PATTERN results.xml EXCLUDE)

add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -P ${CMAKE_CURRENT_LIST_DIR}/HitpipeUninstall.cmake VERBATIM)
