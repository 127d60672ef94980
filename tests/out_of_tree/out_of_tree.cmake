# Installs the build tree in BUILD to a fresh prefix under WORK, builds SOURCE against it, runs its
# suite and that of its plugin's contract, and renders with it from the installed program.
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
if(NOT output MATCHES "ok +texture +stripes +5 checks")
  message(FATAL_ERROR "the contract's suite did not test the module:\n${output}")
endif()

set(pharos ${CMAKE_COMMAND} -E env PHAROS_MODULE_PATH=${WORK}/build/plugins
    ${WORK}/prefix/bin/pharos)
step(${pharos} plugins stripes)
if(NOT output MATCHES "texture 'stripes' \\(module stripes\\)")
  message(FATAL_ERROR "the module is not listed:\n${output}")
endif()
step(${pharos} render ${SOURCE}/striped.yaml -o ${WORK}/render/striped.exr)
if(NOT EXISTS ${WORK}/render/striped.exr)
  message(FATAL_ERROR "nothing was rendered")
endif()

# Without the module the same config must be refused, naming the plugin.
execute_process(COMMAND ${WORK}/prefix/bin/pharos render ${SOURCE}/striped.yaml
                WORKING_DIRECTORY ${WORK}/render RESULT_VARIABLE code ERROR_VARIABLE out)
if(NOT code EQUAL 2 OR NOT out MATCHES "stripes")
  message(FATAL_ERROR "expected a refusal that names 'stripes', got ${code}:\n${out}")
endif()
