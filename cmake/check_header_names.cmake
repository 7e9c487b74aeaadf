# Checks that no header of the package has the name of a header of CGAL, ignoring case, and that no
# two public headers of the package have the same name.
# usage: cmake -DROOT=<root of the package> -DCGAL_HEADERS=<folder CGAL of CGAL> -P ...
cmake_minimum_required(VERSION 3.16)

file(GLOB_RECURSE cgal_headers RELATIVE ${CGAL_HEADERS} ${CGAL_HEADERS}/*.h)
# the package itself may be installed beside CGAL; CGAL's internal headers repeat names freely
list(FILTER cgal_headers EXCLUDE REGEX
  "internal/|Surface_mesh_spline_conversion|^T_NURCC_surface_3\\.h$")
set(cgal_names)
foreach(header ${cgal_headers})
  get_filename_component(name ${header} NAME)
  string(TOLOWER ${name} name)
  list(APPEND cgal_names ${name})
endforeach()

file(GLOB_RECURSE headers RELATIVE ${ROOT}/include/CGAL ${ROOT}/include/CGAL/*.h)
list(FILTER headers EXCLUDE REGEX "/internal/|^license/")
# names that CGAL itself uses once per package
list(REMOVE_ITEM cgal_names error_code.h default_visitor.h)
set(names)
foreach(header ${headers})
  get_filename_component(name ${header} NAME)
  string(TOLOWER ${name} name)
  if(name IN_LIST cgal_names)
    message(SEND_ERROR "${header} has the name of a header of CGAL")
  endif()
  if(name IN_LIST names)
    message(SEND_ERROR "two headers have the name ${name}")
  endif()
  list(APPEND names ${name})
endforeach()
list(LENGTH cgal_names count)
message(STATUS "compared with ${count} headers of CGAL")
if(count EQUAL 0)
  message(SEND_ERROR "no headers of CGAL found in ${CGAL_HEADERS}")
endif()
