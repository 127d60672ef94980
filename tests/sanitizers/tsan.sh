#!/usr/bin/env bash
# Runs suites of the preset `tsan` under the thread sanitizer, with a TBB that is built with it too:
# without, every hand-over from thread to thread would look like a race.
#
#     cmake --preset tsan && cmake --build --preset tsan
#     tests/sanitizers/tsan.sh [ctest options]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$root/build/tsan
tbb=$build/tbb
if [ ! -e "$tbb/lib/libtbb.so.12" ]; then
  mkdir -p "$tbb"
  # Needs the distribution's sources (a deb-src line); any oneTBB of the same version will do.
  (cd "$tbb" && apt-get source -q onetbb)
  cmake -S "$tbb"/onetbb-* -B "$tbb/build" -G Ninja -D TBB_TEST=OFF -D TBBMALLOC_BUILD=OFF \
    -D TBB_STRICT=OFF -D CMAKE_BUILD_TYPE=RelWithDebInfo \
    -D CMAKE_CXX_COMPILER=clang++ -D CMAKE_CXX_FLAGS=-fsanitize=thread \
    -D CMAKE_SHARED_LINKER_FLAGS="-fsanitize=thread -Wl,-z,undefs"
  cmake --build "$tbb/build" --target tbb
  # TBB names its output folder after the compiler.
  mkdir -p "$tbb/lib"
  cp -a "$tbb"/build/*/libtbb.so* "$tbb/lib"
fi
export LD_LIBRARY_PATH=$tbb/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
# The symbolizer writes errors of its own, which tests would take for messages of the program.
symbolizer=$build/llvm-symbolizer
printf '#!/bin/sh\nexec "%s" "$@" 2>/dev/null\n' "$(clang++ -print-prog-name=llvm-symbolizer)" >"$symbolizer"
chmod +x "$symbolizer"
# A long history, so that both sides of a report have their stacks.
export TSAN_OPTIONS="suppressions=$root/tests/sanitizers/tsan.supp history_size=7 external_symbolizer_path=$symbolizer"
exec ctest --test-dir "$build" --output-on-failure "$@"
