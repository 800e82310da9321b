# Optional libraries that make programs faster. The target ARAP_deformation_accelerators links those
# that are found: TBB (threads), and for programs that select them CHOLMOD (another factorization)
# and METIS (an ordering with smaller factors).
if(NOT TARGET ARAP_deformation_accelerators)
  find_package(TBB QUIET)
  include(CGAL_TBB_support)
  find_package(METIS QUIET)
  include(CGAL_METIS_support)
  include(${CMAKE_CURRENT_LIST_DIR}/CGAL_Cholmod_support.cmake)
  add_library(ARAP_deformation_accelerators INTERFACE IMPORTED)
  foreach(library TBB Cholmod METIS)
    if(TARGET CGAL::${library}_support)
      set_property(TARGET ARAP_deformation_accelerators APPEND PROPERTY
                   INTERFACE_LINK_LIBRARIES CGAL::${library}_support)
    else()
      message(STATUS "NOTICE: ${library} was not found; the README tells what it is used for.")
    endif()
  endforeach()
endif()
