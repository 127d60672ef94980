# Installs the build tree in BUILD to a fresh prefix under WORK, builds the module in SOURCE against
# it, runs its suites, and renders SOURCE/example.yaml with the installed program. Then runs
# SOURCE/check.cmake, if there is one.
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/render)

function(step)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "'${ARGN}' failed with ${code}:\n${out}")
  endif()
  set(output "${out}" PARENT_SCOPE)
endfunction()

step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
step(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G Ninja
     -D CMAKE_PREFIX_PATH=${WORK}/prefix -D CMAKE_CXX_COMPILER=${COMPILER}
     -D CMAKE_BUILD_TYPE=${BUILD_TYPE})
step(${CMAKE_COMMAND} --build ${WORK}/build)
step(ctest --test-dir ${WORK}/build --verbose)
if(NOT output MATCHES "ok +[a-z]+ +${MODULE} +[0-9]+ checks")
  message(FATAL_ERROR "the contract's suite did not test the module:\n${output}")
endif()

set(pharos ${CMAKE_COMMAND} -E env PHAROS_MODULE_PATH=${WORK}/build/plugins
    ${WORK}/prefix/bin/pharos)
step(${pharos} plugins ${MODULE})
if(NOT output MATCHES "[a-z]+ '${MODULE}' \\(module ${MODULE}\\)")
  message(FATAL_ERROR "the module is not listed:\n${output}")
endif()
step(${pharos} render ${SOURCE}/example.yaml -o ${WORK}/render/example.exr)
if(NOT EXISTS ${WORK}/render/example.exr)
  message(FATAL_ERROR "nothing was rendered")
endif()
if(EXISTS ${SOURCE}/check.cmake)
  include(${SOURCE}/check.cmake)
endif()

# Without the module, the program must refuse the same config with an error that names the plugin.
execute_process(COMMAND ${WORK}/prefix/bin/pharos render ${SOURCE}/example.yaml
                WORKING_DIRECTORY ${WORK}/render RESULT_VARIABLE code ERROR_VARIABLE out)
if(NOT code EQUAL 2 OR NOT out MATCHES "${MODULE}")
  message(FATAL_ERROR "expected a refusal that names '${MODULE}', got ${code}:\n${out}")
endif()
