# Compares package_info/ARAP_deformation/dependencies with the packages of CGAL whose headers the
# headers of this package include, also by way of others. The headers of a release of CGAL say which
# package they are of, those of a branch do not. An older CGAL may need fewer packages.
# usage: cmake -DCOMPILER=FILE "-DINCLUDE_DIRS=FOLDER;..." [-DWRITE=ON] -P dependencies.cmake
#   INCLUDE_DIRS  where CGAL, Boost and Eigen are
#   WRITE         writes the list instead
cmake_minimum_required(VERSION 3.12...3.31)
set(version_of_list 6.2)
get_filename_component(root ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
set(file ${root}/package_info/ARAP_deformation/dependencies)
file(GLOB_RECURSE headers RELATIVE ${root}/include ${root}/include/CGAL/*.h)
list(FILTER headers INCLUDE REGEX "ARAP_deformation|arap_deform") # a release has all headers in one folder
list(TRANSFORM headers PREPEND "-include;")
list(REMOVE_ITEM INCLUDE_DIRS "")
list(TRANSFORM INCLUDE_DIRS PREPEND "-I")
execute_process( # what is not installed, as PETSc may be, counts as a file yet to be made (-MG)
  COMMAND ${COMPILER} -std=c++17 -DCGAL_EIGEN3_ENABLED -M -MG -x c++ -Iinclude ${INCLUDE_DIRS} ${headers} -
  WORKING_DIRECTORY ${root} INPUT_FILE /dev/null
  OUTPUT_VARIABLE rule ERROR_VARIABLE errors RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${errors}")
endif()
string(REGEX MATCHALL "/[^ \\\n]*/CGAL/[^ \\\n]+" included "${rule}") # of this package: relative

set(packages ARAP_deformation)
foreach(header IN LISTS included)
  file(STRINGS ${header} url REGEX "[$]URL: .*/include/" LIMIT_COUNT 1)
  if(url MATCHES "/([A-Za-z_0-9]+)/include/")
    list(APPEND packages ${CMAKE_MATCH_1})
  endif()
  if(header MATCHES "/CGAL/version\\.h$")
    file(STRINGS ${header} version REGEX "#define CGAL_VERSION ")
    string(REGEX MATCH "[0-9]+\\.[0-9]+" version "${version}")
  endif()
endforeach()
list(REMOVE_DUPLICATES packages)
list(SORT packages)
list(LENGTH packages number)
if(number LESS 10 OR version VERSION_GREATER version_of_list)
  message(STATUS "not compared: CGAL ${version}, whose headers are of ${number} packages")
  return()
endif()

if(WRITE)
  string(REPLACE ";" "\n" text "${packages}\n")
  file(WRITE ${file} "${text}")
  return()
endif()
file(STRINGS ${file} listed)
set(missing ${packages})
list(REMOVE_ITEM missing ${listed})
set(unused ${listed})
list(REMOVE_ITEM unused ${packages})
if(missing OR (unused AND version VERSION_EQUAL version_of_list))
  message(FATAL_ERROR "${file}, with CGAL ${version}:\n missing: ${missing}\n not included: ${unused}")
endif()
message(STATUS "${number} packages of CGAL ${version}; those of ${version_of_list} only: ${unused}")
