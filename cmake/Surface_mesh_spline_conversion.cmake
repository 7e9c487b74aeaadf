# Defines the target CGAL::Surface_mesh_spline_conversion: the headers of this package and what they
# need. The top-level project and each folder that is configured alone include this file; it is
# dropped when the package is merged, because CGAL::CGAL then knows the headers.
if(TARGET Surface_mesh_spline_conversion)
  return()
endif()
get_filename_component(SMSC_ROOT_DIR "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)

set(CGAL_DATA_DIR "${SMSC_ROOT_DIR}/data")
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
find_package(CGAL 5.5 REQUIRED)
find_package(Eigen3 3.3 REQUIRED)
include(CGAL_Eigen3_support)

add_library(Surface_mesh_spline_conversion INTERFACE)
add_library(CGAL::Surface_mesh_spline_conversion ALIAS Surface_mesh_spline_conversion)
target_include_directories(Surface_mesh_spline_conversion BEFORE INTERFACE
  $<BUILD_INTERFACE:${SMSC_ROOT_DIR}/include> $<INSTALL_INTERFACE:include>)
target_link_libraries(Surface_mesh_spline_conversion INTERFACE CGAL::CGAL CGAL::Eigen3_support)

# Without it, one thread does everything, with the same result.
option(SMSC_WITH_TBB "Use several threads, if TBB is found" ON)
if(SMSC_WITH_TBB)
  find_package(TBB QUIET)
  include(CGAL_TBB_support)
  if(TARGET CGAL::TBB_support)
    target_link_libraries(Surface_mesh_spline_conversion INTERFACE CGAL::TBB_support)
  endif()
endif()

# The factorisation of this package suffices; CHOLMOD pays with a fast BLAS and large systems.
option(SMSC_USE_CHOLMOD "Factorise sparse matrices with CHOLMOD of SuiteSparse" OFF)
if(SMSC_USE_CHOLMOD)
  find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
  find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
  target_include_directories(Surface_mesh_spline_conversion SYSTEM INTERFACE ${CHOLMOD_INCLUDE_DIR})
  target_link_libraries(Surface_mesh_spline_conversion INTERFACE ${CHOLMOD_LIBRARY})
  target_compile_definitions(Surface_mesh_spline_conversion INTERFACE
    CGAL_SURFACE_MESH_SPLINE_CONVERSION_USE_CHOLMOD)
endif()
target_compile_features(Surface_mesh_spline_conversion INTERFACE cxx_std_17)

include(${CMAKE_CURRENT_LIST_DIR}/Open_cascade.cmake)

# adds a program from one source file, with warnings switched on
function(smsc_add_program name source)
  add_executable(${name} ${source})
  target_compile_options(${name} PRIVATE
    $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-Wall;-Wextra>)
  target_link_libraries(${name} PRIVATE Surface_mesh_spline_conversion CGAL::Data)
endfunction()

# gives a program what needs Open CASCADE, which must be found
function(smsc_use_open_cascade name)
  target_link_libraries(${name} PRIVATE Surface_mesh_spline_conversion_OpenCASCADE)
endfunction()
