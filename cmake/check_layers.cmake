# Checks that each header includes only headers of its own layer or of layers below.
# usage: cmake -DROOT=<root of the package> -P check_layers.cmake
cmake_minimum_required(VERSION 3.16)

# from bottom to top; `base` is below all, `rim` (input and output) is used by nothing else
set(layers base curves field map layout patches surface fitting export entry rim)

# (layer, regular expression of file names); the first match counts
set(rules
  rim     "^(IO|internal/IO)/"
  entry   "^convert_to_T_NURCC\\.h$|^internal/conversion/"
  base    "^(Error_code|Conversion_report|Stitching_report|Default_visitor|Error_metric)\\.h$|^internal/[^/]*\\.h$"
  layout  "^Quad_layout\\.h$"
  field   "^(Cross_field|compute_cross_field)\\.h$|^internal/(field/|proxy/|map/(make_|refine_)?[Ww]orking_mesh\\.h$)"
  field   "^internal/map/limit_gradation\\.h$"
  map     "^Integer_grid_map\\.h$|^internal/map/"
  # the lengths of an integer grid map are verified by extracting its quads
  layout  "^(compute_integer_grid_map|extract_quad_layout|compute_quad_layout|measure_layout_quality)\\.h$|^internal/layout/"
  patches "^Transfinite_patch_network_3\\.h$|^internal/patches/"
  surface "^T_NURCC_surface_3\\.h$|^internal/surface/"
  fitting "^fit_(boundary|interior)\\.h$|^internal/fitting/"
  export  "^(NURBS_shell_3|Knot_vector|extract_NURBS_faces|find_boundary_vertices|measure_deviation|bound_interior_deviation)\\.h$"
  export  "^internal/(caps|export)/"
  # boundary representations of Open CASCADE
  curves  "^(associate_boundary_with_BRep|Free_edge_normals_3)\\.h$|^internal/open_cascade/(Edge_on_surface|Curve_set|Free_edges)\\.h$"
  export  "^((stitch_with|measure)_BRep|try_BRep_operation)\\.h$|^internal/open_cascade/"
  curves  "_traits_3\\.h$|^(Boundary_curve_network_3|Curve_segment|NURBS_curve_3)\\.h$"
  curves  "^(Elementary_surface_3|Curve_joint|Conversion_case|interpolate_boundary_curves)\\.h$"
  curves  "^smallest_enclosing_sphere_diameter\\.h$|^internal/curves/")

function(find_layer file result)
  set(remaining ${rules})
  while(remaining)
    list(POP_FRONT remaining layer pattern)
    if(file MATCHES "${pattern}")
      list(FIND layers ${layer} index)
      set(${result} ${index} PARENT_SCOPE)
      return()
    endif()
  endwhile()
  set(${result} -1 PARENT_SCOPE)
endfunction()

set(include_dir ${ROOT}/include/CGAL)
file(GLOB_RECURSE headers RELATIVE ${include_dir} ${include_dir}/*.h)
list(FILTER headers EXCLUDE REGEX "^license/")
foreach(header ${headers})
  string(REPLACE "Surface_mesh_spline_conversion/" "" name ${header})
  find_layer(${name} layer)
  if(layer EQUAL -1)
    message(SEND_ERROR "${header} belongs to no layer; add it to cmake/check_layers.cmake")
    continue()
  endif()
  file(STRINGS ${include_dir}/${header} lines REGEX "^# *include <CGAL/")
  foreach(line ${lines})
    string(REGEX REPLACE "^# *include <CGAL/([^>]*)>.*" "\\1" included ${line})
    if(NOT included IN_LIST headers)
      continue()
    endif()
    string(REPLACE "Surface_mesh_spline_conversion/" "" included ${included})
    find_layer(${included} included_layer)
    if(included_layer GREATER layer)
      list(GET layers ${layer} from)
      list(GET layers ${included_layer} to)
      message(SEND_ERROR "${name} (layer ${from}) includes ${included} (layer ${to})")
    endif()
  endforeach()
endforeach()
list(LENGTH headers count)
message(STATUS "checked the includes of ${count} headers")
