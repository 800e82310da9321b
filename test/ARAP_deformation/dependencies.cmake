# Compares package_info/ARAP_deformation/dependencies with the packages of CGAL whose headers the headers
# of this package include, also by way of others. CGAL's own headers include more with each version: with
# older versions than the one that the list is of, it may have packages that these do not need.
# usage: cmake -DCOMPILER=FILE "-DINCLUDE_DIRS=FOLDER;..." [-DWRITE=ON] -P dependencies.cmake
#   INCLUDE_DIRS  where CGAL, Boost and Eigen are;  WRITE  writes the list instead
cmake_minimum_required(VERSION 3.12...3.31)
set(newest 6.2) # the version that the list is of
set(root ${CMAKE_CURRENT_LIST_DIR}/../..)
set(file ${root}/package_info/ARAP_deformation/dependencies)
file(GLOB_RECURSE headers ${root}/include/CGAL/*.h)
list(FILTER headers EXCLUDE REGEX "/license/")
list(TRANSFORM headers PREPEND "-include;")
set(folders ${INCLUDE_DIRS})
list(TRANSFORM folders PREPEND "-isystem;")
execute_process( # what is not installed, as PETSC may be, counts as a file yet to be made (-MG)
  COMMAND ${COMPILER} -std=c++17 -DCGAL_EIGEN3_ENABLED -M -MG -x c++ -I${root}/include ${folders} ${headers} -
  INPUT_FILE /dev/null OUTPUT_VARIABLE rule ERROR_VARIABLE errors RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${errors}")
endif()
string(REGEX MATCHALL "[^ \\\n]+/CGAL/[^ \\\n]+" included "${rule}")

set(packages ARAP_deformation)
foreach(header IN LISTS included)
  file(STRINGS ${header} url REGEX "[$]URL: .*/include/" LIMIT_COUNT 1) # as releases of CGAL have it
  if(url MATCHES "/([A-Za-z_0-9]+)/include/")
    list(APPEND packages ${CMAKE_MATCH_1})
  endif()
  if(header MATCHES "/CGAL/version\\.h$")
    file(STRINGS ${header} line REGEX "#define CGAL_VERSION ")
    string(REGEX MATCH "[0-9.]+" version "${line}")
  endif()
endforeach()
list(REMOVE_DUPLICATES packages)
list(SORT packages)
list(LENGTH packages number)
if(number LESS 10) # in a branch of CGAL headers have no version
  message(STATUS "the headers of this CGAL do not say which package they belong to")
  return()
endif()

string(REPLACE ";" "\n" text "${packages}\n")
if(WRITE)
  file(WRITE ${file} "${text}")
  return()
endif()
file(STRINGS ${file} listed)
set(missing ${packages})
list(REMOVE_ITEM missing ${listed})
set(unused ${listed})
list(REMOVE_ITEM unused ${packages})
if(missing OR (unused AND version VERSION_GREATER_EQUAL newest))
  message(FATAL_ERROR "${file} with CGAL ${version}:\n missing: ${missing}\n not included: ${unused}")
endif()
message(STATUS "${number} packages of CGAL ${version}; listed for a newer one only: ${unused}")
