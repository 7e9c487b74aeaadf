#!/usr/bin/env bash
# Builds tests and examples, and runs all tests. Installs what is missing (Debian 12).
# Arguments are passed on to ctest, for instance: scripts/test.sh -R layout
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/scripts/install_packages.sh"
install_packages cmake make g++ libcgal-dev libeigen3-dev clang-14 doxygen
# not needed, but then stitching, curves on B-Reps, and several threads are tested, too
install_packages libocct-data-exchange-dev || echo "Without Open CASCADE"
install_packages libtbb-dev || echo "Without TBB"

build=$root/build/test
launcher=()
command -v ccache > /dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
# more optimization would take longer than it saves: most of the time goes into compiling
cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG" \
  "${launcher[@]}"
cmake --build "$build" -j2
cd "$build"
exec ctest -j2 --output-on-failure "$@"
