#!/usr/bin/env bash
# Converts the bracket in data/ and leaves STEP, report, VTK and pictures in build/demo.
# Installs what is missing (Debian 12), configures, and builds.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$root/scripts/install_packages.sh"
install_packages cmake make g++ libcgal-dev libeigen3-dev

build=$root/build/tool
out=$root/build/demo
cmake -S "$root/examples/Surface_mesh_spline_conversion" -B "$build" \
  -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF > /dev/null
echo "Building the command line tool (some minutes) ..."
cmake --build "$build" --target convert_case -j2

mkdir -p "$out"
"$build/convert_case" "$root/data/cases/d4_bracket_simp" --relative --xi 1e-4 --delta 5e-3 \
  --output "$out/bracket.step" --report "$out/report.json" --history "$out/history.csv" \
  --vtk "$out/bracket.vtu" --pictures "$out/pictures"

cat << END

The bracket is converted. Look at
  $out/bracket.step     the surface for CAD systems
  $out/bracket.vtu      the same for ParaView
  $out/report.json      deviations, counts and times
  $out/history.csv      the iterations of the fits
  $out/pictures/        layout, patches, deviation from the mesh, zebra stripes
END
