# What find_package(hitpipe) finds. Each part has its targets in a file of its own, so the headers can be installed alone.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/hitpipe)

install(EXPORT hitpipe_hls NAMESPACE hitpipe:: DESTINATION ${package_folder})
if(HITPIPE_TOOLS)
  install(EXPORT hitpipe_ref NAMESPACE hitpipe:: DESTINATION ${package_folder})
  install(EXPORT hitpipe_program NAMESPACE hitpipe:: DESTINATION ${package_folder})
  set(only_headers)
else()
  set(only_headers ARCH_INDEPENDENT)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/hitpipeConfig.cmake.in ${PROJECT_BINARY_DIR}/hitpipeConfig.cmake
  INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hitpipeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ${only_headers})
install(FILES ${PROJECT_BINARY_DIR}/hitpipeConfig.cmake ${PROJECT_BINARY_DIR}/hitpipeConfigVersion.cmake
        DESTINATION ${package_folder})
