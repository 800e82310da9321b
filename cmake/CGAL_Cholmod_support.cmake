# Looks for CHOLMOD, of SuiteSparse. If it is found there is a target CGAL::Cholmod_support, with
# which programs that use CGAL::ARAP::Cholmod_solver are linked, and which defines
# CGAL_LINKED_WITH_CHOLMOD.
if(NOT TARGET CGAL::Cholmod_support)
  find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
  find_library(CHOLMOD_LIBRARY cholmod)
  mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)
  if(CHOLMOD_INCLUDE_DIR AND CHOLMOD_LIBRARY)
    add_library(CGAL::Cholmod_support INTERFACE IMPORTED)
    set_target_properties(CGAL::Cholmod_support PROPERTIES
      INTERFACE_COMPILE_DEFINITIONS CGAL_LINKED_WITH_CHOLMOD
      INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}"
      INTERFACE_LINK_LIBRARIES "${CHOLMOD_LIBRARY}")
  endif()
endif()
