# Defines the target CGAL::Surface_mesh_spline_conversion_OpenCASCADE if Open CASCADE is found (Debian:
# libocct-data-exchange-dev): what the headers of the package need that handle boundary
# representations. Everything else works without it.
option(SMSC_WITH_OPENCASCADE "Build what needs Open CASCADE, if it is found" ON)
if(NOT SMSC_WITH_OPENCASCADE)
  return()
endif()
find_package(OpenCASCADE QUIET)

# the variable OpenCASCADE_LIBRARIES also lists toolkits that need not be installed
set(SMSC_OPENCASCADE_TOOLKITS TKernel TKMath TKG2d TKG3d TKGeomBase TKBRep TKGeomAlgo TKTopAlgo TKPrim
  TKBO TKBool TKShHealing TKFillet TKOffset TKMesh TKXSBase)
if(OpenCASCADE_VERSION VERSION_LESS 7.8)
  list(APPEND SMSC_OPENCASCADE_TOOLKITS TKSTEPBase TKSTEPAttr TKSTEP209 TKSTEP)
else()
  list(APPEND SMSC_OPENCASCADE_TOOLKITS TKDE TKDESTEP)
endif()
foreach(toolkit ${SMSC_OPENCASCADE_TOOLKITS})
  if(NOT TARGET ${toolkit})
    message(STATUS "Open CASCADE is not found: there will be no curves on B-Reps and no stitching")
    return()
  endif()
endforeach()

add_library(Surface_mesh_spline_conversion_OpenCASCADE INTERFACE)
add_library(CGAL::Surface_mesh_spline_conversion_OpenCASCADE ALIAS
  Surface_mesh_spline_conversion_OpenCASCADE)
target_include_directories(Surface_mesh_spline_conversion_OpenCASCADE SYSTEM INTERFACE
  ${OpenCASCADE_INCLUDE_DIR})
target_link_libraries(Surface_mesh_spline_conversion_OpenCASCADE INTERFACE
  Surface_mesh_spline_conversion ${SMSC_OPENCASCADE_TOOLKITS})
target_compile_definitions(Surface_mesh_spline_conversion_OpenCASCADE INTERFACE
  CGAL_SMSC_USE_OPENCASCADE)
