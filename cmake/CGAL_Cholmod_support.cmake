# Looks for CHOLMOD, part of SuiteSparse. If found, defines the target CGAL::Cholmod_support for
# programs that use CGAL::ARAP::Cholmod_solver. It defines CGAL_LINKED_WITH_CHOLMOD.
if(NOT TARGET CGAL::Cholmod_support)
  find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
  find_library(CHOLMOD_LIBRARY cholmod)
  mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)
  # these may be of one that was removed since
  if(EXISTS "${CHOLMOD_INCLUDE_DIR}/cholmod.h" AND EXISTS "${CHOLMOD_LIBRARY}")
    add_library(CGAL::Cholmod_support INTERFACE IMPORTED)
    set_target_properties(CGAL::Cholmod_support PROPERTIES
      INTERFACE_COMPILE_DEFINITIONS CGAL_LINKED_WITH_CHOLMOD
      INTERFACE_INCLUDE_DIRECTORIES "${CHOLMOD_INCLUDE_DIR}"
      INTERFACE_LINK_LIBRARIES "${CHOLMOD_LIBRARY}")
  endif()
endif()
