# pharos_add_module(NAME [SOURCES file...] [TESTS file...] [LIBRARIES target...]
#                   [PRESETS file...] [TEST_ONLY] [NO_CONFORMANCE])
#
# Without SOURCES, the module consists of all .cpp files of the folder and its subfolders, and the
# files in tests/ are its suite.
#
# Builds two targets. The shared library NAME.pharos.so is found by the loader in the plugin folder
# (build/plugins in the build tree) or elsewhere through PHAROS_MODULE_PATH. The doctest suite
# test-NAME is run by ctest under the label NAME.
#
# The test NAME-conformance applies the conformance suites of their contracts to all plugins of the
# module. Its labels are NAME and conformance, or long-conformance if the module is TEST_ONLY. Modules
# of planted faults say NO_CONFORMANCE to leave this test out.
#
# PRESETS are YAML files that `guiding: NAME` in a config finds. They are copied to the folder
# `presets` beside the module.
#
# TEST_ONLY modules are built in build/test-plugins (with NO_CONFORMANCE in build/faulty-plugins)
# and are not installed.
#
# Modules outside this project use the same function after find_package(pharos).
include_guard(GLOBAL)

function(pharos_add_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "TEST_ONLY;NO_CONFORMANCE" "" 
                        "SOURCES;TESTS;LIBRARIES;PRESETS")
  if(NOT arg_SOURCES)
    file(GLOB_RECURSE arg_SOURCES CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}
         ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
    set(arg_TESTS ${arg_SOURCES})
    list(FILTER arg_SOURCES EXCLUDE REGEX "(^|/)tests/")
    list(FILTER arg_TESTS INCLUDE REGEX "^tests/[^/]*$")
  endif()
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "pharos_add_module(${name}): unknown '${arg_UNPARSED_ARGUMENTS}'")
  endif()
  set(folder plugins)
  if(arg_TEST_ONLY AND arg_NO_CONFORMANCE)
    set(folder faulty-plugins)
  elseif(arg_TEST_ONLY)
    set(folder test-plugins)
  endif()
  set(warnings $<TARGET_NAME_IF_EXISTS:pharos_warnings>)

  add_library(${name}-objects OBJECT ${arg_SOURCES})
  target_link_libraries(${name}-objects PUBLIC pharos::pharos ${arg_LIBRARIES} PRIVATE ${warnings})
  set_target_properties(${name}-objects PROPERTIES
    POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden)

  add_library(${name} MODULE)
  target_link_libraries(${name} PRIVATE ${name}-objects)
  set_target_properties(${name} PROPERTIES
    PREFIX "" SUFFIX ".pharos.so"
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/${folder})
  foreach(preset IN LISTS arg_PRESETS)
    cmake_path(GET preset FILENAME file)
    configure_file(${CMAKE_CURRENT_SOURCE_DIR}/${preset} ${CMAKE_BINARY_DIR}/${folder}/presets/${file} COPYONLY)
  endforeach()
  if(NOT arg_TEST_ONLY)
    set_property(GLOBAL APPEND PROPERTY PHAROS_MODULES ${name})
    include(GNUInstallDirs)
    if(arg_PRESETS)
      install(FILES ${arg_PRESETS} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pharos/plugins/presets)
    endif()
    install(TARGETS ${name} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/pharos/plugins)
  endif()

  if(arg_TESTS AND TARGET pharos::test_main)
    find_package(doctest REQUIRED)
    add_executable(test-${name} ${arg_TESTS})
    target_link_libraries(test-${name} PRIVATE ${name}-objects pharos::test_main ${warnings})
    add_test(NAME ${name} COMMAND test-${name})
    set_tests_properties(${name} PROPERTIES LABELS ${name})
  endif()
  if(NOT arg_NO_CONFORMANCE)
    add_test(NAME ${name}-conformance
      COMMAND ${CMAKE_COMMAND} -E env PHAROS_MODULE_PATH=${CMAKE_BINARY_DIR}/${folder}
              $<TARGET_FILE:pharos::program> conformance --module ${name})
    set(label conformance)
    if(arg_TEST_ONLY)
      set(label long-conformance)
    endif()
    set_tests_properties(${name}-conformance PROPERTIES LABELS "${name};${label}")
  endif()
endfunction()
