# Which header may include which: the folders of internal/ stand on each other like floors. A header
# there includes headers of its own floor and of lower ones, also by way of public headers, whose floor
# is the highest of what they include. No header includes itself by way of others, but for X_impl.h,
# which X.h includes where nothing is compiled once: it includes X.h, and nothing else that does.
# usage: cmake [-DINCLUDE_DIR=FOLDER] -P check_layers.cmake
cmake_minimum_required(VERSION 3.12...3.31)
if(NOT DEFINED INCLUDE_DIR)
  set(INCLUDE_DIR ${CMAKE_CURRENT_LIST_DIR}/../../include)
endif()
set(floors parallel simd cholesky region rotation constraints solver energy coarse minimizer domain
           session drop_in) # from the ground up
file(GLOB_RECURSE headers RELATIVE ${INCLUDE_DIR} ${INCLUDE_DIR}/CGAL/*.h)
list(FILTER headers INCLUDE REGEX "ARAP_deformation|arap_deform") # a release has all headers in one folder
if(NOT headers)
  message(FATAL_ERROR "there are no headers in '${INCLUDE_DIR}'")
endif()

# Sets the global properties floor_HEADER and way_HEADER: by way of which headers it stands there.
function(visit header)
  set(path ${ARGN})
  if(header IN_LIST path)
    string(REPLACE ";" "\n    -> " cycle "${path};${header}")
    message(SEND_ERROR "a cycle:\n    ${cycle}")
  endif()
  get_property(is_visited GLOBAL PROPERTY floor_${header} SET)
  if(header IN_LIST path OR is_visited)
    return()
  endif()
  set(own -1) # of headers beside the folders, which all may include
  if(header MATCHES "/internal/([^/]+)/")
    list(FIND floors ${CMAKE_MATCH_1} own)
    if(own EQUAL -1)
      message(SEND_ERROR "a folder that is no floor:\n    ${header}")
    endif()
  endif()
  set(highest ${own})
  set(way ${header})
  set(closure "") # all that the header includes
  get_filename_component(name ${header} NAME_WE)
  string(REGEX REPLACE "_impl\\.h$" ".h" declarations ${header})
  file(STRINGS ${INCLUDE_DIR}/${header} lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]CGAL/")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE ".*[<\"](CGAL/[^>\"]+).*" "\\1" included "${line}")
    if(NOT included IN_LIST headers OR included MATCHES "/${name}_impl\\.h$")
      continue() # CGAL's own, or the implementation of this header
    endif()
    visit(${included} ${path} ${header})
    get_property(further_closure GLOBAL PROPERTY closure_${included})
    list(APPEND closure ${included} ${further_closure})
    if(NOT included STREQUAL declarations AND declarations IN_LIST further_closure)
      message(SEND_ERROR "a cycle, where nothing is compiled once:\n    ${declarations}\n    -> ${header}\n    -> "
                         "${included}\n    -> ... -> ${declarations}")
    endif()
    get_property(floor GLOBAL PROPERTY floor_${included})
    if(floor GREATER highest)
      set(highest ${floor})
      get_property(further GLOBAL PROPERTY way_${included})
      set(way "${header}\n    -> ${further}")
    endif()
    if(header MATCHES "/internal/" AND highest GREATER own)
      message(SEND_ERROR "an arrow upwards:\n    ${way}")
      set(highest ${own}) # told, and does not count for those who include this one
      set(way ${header})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES closure)
  set_property(GLOBAL PROPERTY closure_${header} ${closure})
  set_property(GLOBAL PROPERTY floor_${header} ${highest})
  set_property(GLOBAL PROPERTY way_${header} "${way}")
endfunction()

foreach(header IN LISTS headers)
  visit(${header})
endforeach()
list(LENGTH headers number)
message(STATUS "${number} headers visited")
