# Compiles the sources of a target in groups (CMake calls that a unity build), because most of the
# time goes into templates that all sources of a group share. A build of everything then takes 60
# percent of the time (measured with GCC 12). Each source still compiles alone: the preset `clang`
# compiles it so. After a change of one source its whole group is compiled; whoever works on one
# file all day may configure with -DCMAKE_UNITY_BUILD=OFF.
set(CMAKE_UNITY_BUILD ON CACHE BOOL "Compile sources in groups")
set(CMAKE_UNITY_BUILD_BATCH_SIZE 6 CACHE STRING "Number of sources in a group")

# pharos_compile_alone(FILE…): takes sources of the current folder out of the groups, because their
# local names clash with local names of other sources.
function(pharos_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
