# Tests of the structure of the package: every header compiles alone, included twice, and without a warning;
# the layers include only what lies below them; no header has the name of one of CGAL's headers.
file(GLOB_RECURSE SMSC_HEADERS CONFIGURE_DEPENDS RELATIVE ${SMSC_ROOT_DIR}/include
  ${SMSC_ROOT_DIR}/include/*.h)
list(FILTER SMSC_HEADERS EXCLUDE REGEX "parameters_interface\\.h$") # an X-macro list
# headers that need Open CASCADE are tested only if it is found, and after all others: its macro
# Handle() must not meet the class of CGAL
set(SMSC_OPENCASCADE_HEADERS ${SMSC_HEADERS})
set(SMSC_OPENCASCADE_REGEX "_BRep\\.h$|IO/BRep\\.h$|Open_cascade_|/open_cascade/")
list(FILTER SMSC_OPENCASCADE_HEADERS INCLUDE REGEX "${SMSC_OPENCASCADE_REGEX}")
list(FILTER SMSC_HEADERS EXCLUDE REGEX "${SMSC_OPENCASCADE_REGEX}")
if(TARGET Surface_mesh_spline_conversion_OpenCASCADE)
  list(APPEND SMSC_HEADERS ${SMSC_OPENCASCADE_HEADERS})
endif()

find_path(SMSC_CGAL_HEADERS CGAL/version.h HINTS ${CGAL_INCLUDE_DIRS})
add_test(NAME structure_layers
  COMMAND ${CMAKE_COMMAND} -DROOT=${SMSC_ROOT_DIR} -P ${CMAKE_CURRENT_LIST_DIR}/check_layers.cmake)
add_test(NAME structure_header_names
  COMMAND ${CMAKE_COMMAND} -DROOT=${SMSC_ROOT_DIR} -DCGAL_HEADERS=${SMSC_CGAL_HEADERS}/CGAL
          -P ${CMAKE_CURRENT_LIST_DIR}/check_header_names.cmake)

# adds a test for each of the compilers given: `content` compiles without a warning
function(smsc_add_compilation_test name content)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/headers/${name}.cpp)
  file(GENERATE OUTPUT ${source} CONTENT "${content}")
  set(system_folders $<TARGET_PROPERTY:CGAL::Eigen3_support,INTERFACE_INCLUDE_DIRECTORIES>)
  if(TARGET Surface_mesh_spline_conversion_OpenCASCADE)
    list(APPEND system_folders ${OpenCASCADE_INCLUDE_DIR})
  endif()
  foreach(compiler ${ARGN})
    get_filename_component(compiler_name ${compiler} NAME)
    set(test header_${name}_${compiler_name})
    add_test(NAME ${test}
      COMMAND ${compiler} -std=c++17 -fsyntax-only -Wall -Wextra -Werror
              -I ${SMSC_ROOT_DIR}/include "-isystem;$<JOIN:${system_folders},;-isystem;>" ${source}
      COMMAND_EXPAND_LISTS)
    set_tests_properties(${test} PROPERTIES LABELS headers TIMEOUT 600)
  endforeach()
endfunction()

if(SMSC_TEST_HEADERS AND NOT MSVC)
  set(SMSC_COMPILERS ${CMAKE_CXX_COMPILER})
  find_program(SMSC_CLANG NAMES clang++-14 clang++)
  if(SMSC_CLANG AND NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    list(APPEND SMSC_COMPILERS ${SMSC_CLANG})
  endif()
  # alone with the faster of the two compilers, together with both
  list(GET SMSC_COMPILERS -1 SMSC_HEADER_COMPILER)
  set(all "")
  foreach(header ${SMSC_HEADERS})
    string(REGEX REPLACE "^CGAL/(Surface_mesh_spline_conversion/)?" "" name ${header})
    string(REGEX REPLACE "[/.]" "_" name ${name})
    smsc_add_compilation_test(${name} "#include <${header}>\n#include <${header}>\n"
      ${SMSC_HEADER_COMPILER})
    string(APPEND all "#include <${header}>\n")
  endforeach()
  # internal names of different stages must not clash
  smsc_add_compilation_test(together "${all}" ${SMSC_COMPILERS})
endif()
