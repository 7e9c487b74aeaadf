# Tests the contract of convert_case: exit status, files, and report.
# usage: cmake -DTOOL=<convert_case> -DDATA=<folder data> -DOUTPUT=<folder> -P test_convert_case.cmake
cmake_minimum_required(VERSION 3.19)
file(REMOVE_RECURSE ${OUTPUT})
file(MAKE_DIRECTORY ${OUTPUT})
set(case ${DATA}/cases/d2_square_corner)
set(tolerances --relative --xi 1e-4 --delta 5e-3)

# runs the tool with the arguments behind `expected`, and checks the exit status
function(expect expected)
  execute_process(COMMAND ${TOOL} ${ARGN} RESULT_VARIABLE status ERROR_VARIABLE message
                  OUTPUT_QUIET)
  if(NOT status EQUAL expected)
    message(SEND_ERROR "convert_case ${ARGN}\n  ends with ${status} instead of ${expected}:\n${message}")
  endif()
  if(NOT status EQUAL 0 AND message STREQUAL "")
    message(SEND_ERROR "convert_case ${ARGN} fails without a message")
  endif()
endfunction()

function(expect_file file)
  if(NOT EXISTS ${OUTPUT}/${file})
    message(SEND_ERROR "${file} is not written")
  endif()
endfunction()

function(expect_status report expected)
  file(READ ${OUTPUT}/${report} text)
  string(JSON status GET ${text} status)
  if(NOT status STREQUAL expected)
    message(SEND_ERROR "${report}: the status is '${status}' instead of '${expected}'")
  endif()
endfunction()

expect(0 ${case} ${tolerances} --output ${OUTPUT}/new/a.step --report ${OUTPUT}/a.json
       --history ${OUTPUT}/a.csv --vtk ${OUTPUT}/a.vtu --pictures ${OUTPUT}/pictures)
foreach(file new/a.step a.json a.csv a.svg a.vtu pictures/layout.png pictures/patches.png
        pictures/deviation.png pictures/zebra.png)
  expect_file(${file})
endforeach()
expect_status(a.json "ok")
file(READ ${OUTPUT}/a.json report)
foreach(keys "input;loops" "xi" "delta" "quad_size" "boundary;max_deviation"
        "boundary;certified_bound" "boundary;worst;t" "interior;max_deviation" "interior;worst;2"
        "counts;patches" "counts;nurbs_faces" "smoothness;max_normal_angle_degrees"
        "map;flipped_triangles" "iterations;0;patches" "stages;0;seconds" "peak_memory_bytes")
  string(JSON value ERROR_VARIABLE error GET ${report} ${keys})
  if(error OR value STREQUAL "")
    message(SEND_ERROR "the report has no number ${keys}")
  endif()
endforeach()

expect(0 --help)
expect(0 ${case}/case.json ${tolerances} --quiet --no-merge)
expect(0 ${case}/mesh.off ${tolerances} --preset coarse --quiet)
expect(3 ${case} --relative --xi 1e-9 --delta 1e-3 --max-patches 10 --report ${OUTPUT}/b.json
       --output ${OUTPUT}/b.step)
expect_status(b.json "a tolerance was not reached")
expect_file(b.step)

expect(2)
foreach(option --xi --delta --quad-size --max-patches --threads)
  foreach(value 0 -1 nan inf 1x "")
    expect(2 ${case} ${option} "${value}")
  endforeach()
endforeach()
expect(2 ${case} --preset finest)
expect(2 ${case} --error-metric mean)
expect(2 ${case} --xi)
expect(2 ${case} --unknown)
expect(2 ${case} ${case})
expect(2 ${case} --stitched ${OUTPUT}/solid.step)
expect(2 ${OUTPUT})
expect(2 ${OUTPUT}/missing.off)
expect(2 ${OUTPUT}/missing.vrml)

file(WRITE ${OUTPUT}/quad.off "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")
file(WRITE ${OUTPUT}/edge.off "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 0 1 3\n")
file(WRITE ${OUTPUT}/fans.off "OFF\n5 2 0\n0 0 0\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n3 0 1 2\n3 0 3 4\n")
file(WRITE ${OUTPUT}/area.off "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")
file(WRITE ${OUTPUT}/empty.off "OFF\n3 0 0\n0 0 0\n1 0 0\n2 0 0\n")
file(WRITE ${OUTPUT}/broken.off "OFF\n3 1 0\n0 0 0\n1 0")
file(WRITE ${OUTPUT}/broken.json "{ \"format\": ")
foreach(file quad.off edge.off fans.off area.off empty.off broken.off broken.json)
  expect(2 ${OUTPUT}/${file} --report ${OUTPUT}/bad.json)
  expect_file(bad.json)
  file(REMOVE ${OUTPUT}/bad.json)
endforeach()
