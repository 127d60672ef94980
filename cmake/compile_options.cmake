# Compile options of the whole project. `pharos_options` is exported with the library, because
# modules must use the same instruction set as the library. `pharos_warnings` is not exported.
add_library(pharos_options INTERFACE)
target_compile_features(pharos_options INTERFACE cxx_std_20)
target_compile_options(pharos_options INTERFACE -fno-math-errno -fno-trapping-math)
if(PHAROS_NATIVE)
  target_compile_options(pharos_options INTERFACE -march=native)
endif()
if(PHAROS_SANITIZE)
  target_compile_options(pharos_options INTERFACE
    -fsanitize=${PHAROS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(pharos_options INTERFACE -fsanitize=${PHAROS_SANITIZE})
endif()

add_library(pharos_warnings INTERFACE)
# Designated initializers leave members out on purpose; their defaults are part of the type.
target_compile_options(pharos_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  -Wno-missing-field-initializers)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 warns of overlapping and too long copies in "text" + std::string (GCC bug 105651). It
  # also warns of uninitialized values inside its own AVX-512 headers (GCC bug 105593).
  target_compile_options(pharos_warnings INTERFACE
    -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-maybe-uninitialized)
endif()
# Local names of two sources in a group (unity_build.cmake) may shadow each other, and a group looks
# like a header to GCC's warning of local types in it. The preset `clang` warns, as it has no groups.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(pharos_warnings INTERFACE
    -Wno-shadow -Wno-subobject-linkage -Wno-stringop-overread)
endif()
if(PHAROS_WERROR)
  target_compile_options(pharos_warnings INTERFACE -Werror)
endif()

find_program(PHAROS_CCACHE ccache)
if(PHAROS_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # ccache asks for these settings and flags where headers are precompiled. It takes the headers of a
  # source from the compiler's list, because preprocessing each source first takes a tenth of the time.
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_DEPEND=1 ${PHAROS_CCACHE})
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
                      "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endif()
