# Compiles each public header alone with COMPILER as what the package does not work with: the first error
# has the sentence that says so.
# usage: cmake -DCOMPILER=FILE -P first_errors.cmake
cmake_minimum_required(VERSION 3.12...3.31)
set(include_dir ${CMAKE_CURRENT_LIST_DIR}/../../include)
file(GLOB_RECURSE headers RELATIVE ${include_dir} ${include_dir}/CGAL/*.h)
list(FILTER headers EXCLUDE REGEX "/internal/|/license/")

function(check_first_error flag sentence)
  foreach(header IN LISTS headers)
    execute_process(
      COMMAND ${COMPILER} -std=c++17 ${flag} -fsyntax-only -Wfatal-errors -x c++
              -I ${include_dir} ${include_dir}/${header}
      RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
    string(REGEX MATCH "error[ :][^\n]*" first_error "${output}")
    string(FIND "${first_error}" "${sentence}" position)
    if(position EQUAL -1)
      message(SEND_ERROR "${header} with ${flag}: the first error is not \"${sentence}\":\n${output}")
    endif()
  endforeach()
endfunction()
check_first_error(-std=c++14 "CGAL/ARAP_deformation needs C++17")
check_first_error(-DARAP=1 "CGAL/ARAP_deformation: the macro ARAP is defined")
list(LENGTH headers number)
message(STATUS "${number} headers compiled")
