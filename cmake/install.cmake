# Installs a usable prefix: program, library, headers, plugins and the CMake package.
include(CMakePackageConfigHelpers)
install(TARGETS pharos pharos_options EXPORT pharos-targets
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS pharos_images LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET pharos_mpi)
  install(TARGETS pharos_mpi LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
install(TARGETS pharos-program EXPORT pharos-targets RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY framework/pharos DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h" PATTERN "tests" EXCLUDE PATTERN "app" EXCLUDE)
if(PHAROS_TESTS)
  install(TARGETS pharos-test-main EXPORT pharos-targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
install(DIRECTORY configs/presets DESTINATION ${CMAKE_INSTALL_LIBDIR}/pharos/plugins)
# Modules to be copied: `find_package(pharos)` is all that they need.
install(DIRECTORY tests/out_of_tree/stripes tests/out_of_tree/grid_guide
        DESTINATION ${CMAKE_INSTALL_DATADIR}/pharos/examples PATTERN check.cmake EXCLUDE)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pharos)
install(EXPORT pharos-targets NAMESPACE pharos:: DESTINATION ${package_dir})
configure_package_config_file(cmake/pharos-config.cmake.in
  ${CMAKE_BINARY_DIR}/pharos-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/pharos-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/pharos-config.cmake
              ${CMAKE_BINARY_DIR}/pharos-config-version.cmake
              cmake/pharos_add_module.cmake
        DESTINATION ${package_dir})
