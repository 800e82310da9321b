# Preprocesses each public header alone with COMPILER as what the package does not work with: the first
# error has the sentence that says so.
# usage: cmake -DCOMPILER=FILE "-DINCLUDE_DIRS=FOLDER;..." -P first_errors.cmake
#   INCLUDE_DIRS  where CGAL, Boost and Eigen are
cmake_minimum_required(VERSION 3.12...3.31)
set(include_dir ${CMAKE_CURRENT_LIST_DIR}/../../include)
file(GLOB_RECURSE headers RELATIVE ${include_dir} ${include_dir}/CGAL/*.h)
list(FILTER headers INCLUDE REGEX "ARAP_deformation|arap_deform") # a release has all headers in one folder
list(FILTER headers EXCLUDE REGEX "/internal/|/license/")

list(REMOVE_ITEM INCLUDE_DIRS "")
list(TRANSFORM INCLUDE_DIRS PREPEND "-I")

# with other headers than all, where only these include what is not there
function(check_first_error flag sentence)
  if(ARGN)
    set(headers ${ARGN})
  endif()
  foreach(header IN LISTS headers)
    execute_process(
      COMMAND ${COMPILER} -std=c++17 ${flag} -E -Wfatal-errors -x c++
              -I${include_dir} ${INCLUDE_DIRS} ${include_dir}/${header}
      OUTPUT_QUIET ERROR_VARIABLE output)
    string(REGEX MATCH "error[ :][^\n]*" first_error "${output}")
    if(NOT first_error MATCHES "${sentence}")
      message(SEND_ERROR "${header} with ${flag}: the first error is not \"${sentence}\":\n${output}")
    endif()
  endforeach()
endfunction()
check_first_error(-std=c++14 "CGAL/ARAP_deformation needs C[+][+]17|CGAL requires C[+][+] 17")
check_first_error(-DARAP=1 "CGAL/ARAP_deformation: the macro ARAP is defined")
check_first_error("-DCGAL_VERSION_H;-DCGAL_VERSION_NR=1050411000" "CGAL/ARAP_deformation needs CGAL 5.5")
set(old ${CMAKE_CURRENT_BINARY_DIR}/old_eigen)
foreach(header Core SparseCore)
  file(WRITE ${old}/Eigen/${header} "#define EIGEN_VERSION_AT_LEAST(x, y, z) 0\n")
endforeach()
check_first_error(-I${old} "CGAL/ARAP_deformation needs Eigen 3.4 or newer" CGAL/ARAP_deformation.h
                  CGAL/arap_deform.h CGAL/ARAP_deformation/Surface_mesh_deformation.h)
set(INCLUDE_DIRS "")
check_first_error("" "CGAL/ARAP_deformation needs Eigen")
list(LENGTH headers number)
message(STATUS "${number} headers preprocessed")
