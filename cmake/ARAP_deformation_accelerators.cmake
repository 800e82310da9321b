# Optional libraries that make programs faster. The target ARAP_deformation_accelerators links those
# that are found: TBB (threads), and for programs that select them CHOLMOD (another factorization)
# and METIS (an ordering with smaller factors). The variable ARAP_DEFORMATION_ACCELERATORS, if it is
# set, names those that are looked for.
if(NOT TARGET ARAP_deformation_accelerators)
  if(NOT DEFINED ARAP_DEFORMATION_ACCELERATORS)
    set(ARAP_DEFORMATION_ACCELERATORS TBB Cholmod METIS)
  endif()
  add_library(ARAP_deformation_accelerators INTERFACE IMPORTED)
  foreach(library IN LISTS ARAP_DEFORMATION_ACCELERATORS)
    if(library STREQUAL "Cholmod")
      include(${CMAKE_CURRENT_LIST_DIR}/CGAL_Cholmod_support.cmake)
    else()
      find_package(${library} QUIET)
      include(CGAL_${library}_support)
    endif()
    if(TARGET CGAL::${library}_support)
      set_property(TARGET ARAP_deformation_accelerators APPEND PROPERTY
                   INTERFACE_LINK_LIBRARIES CGAL::${library}_support)
    else()
      message(STATUS "NOTICE: ${library} was not found; the README tells what it is used for.")
    endif()
  endforeach()
endif()
