# Looks for PETSc and MPI. If found, and if PETSc is built with MUMPS, for real numbers in double
# precision with indices of 32 bits, defines the target CGAL::Petsc_support for programs that use CGAL::ARAP::Petsc_solver. It defines
# CGAL_LINKED_WITH_PETSC.
if(NOT TARGET CGAL::Petsc_support)
  find_path(PETSC_INCLUDE_DIR petscksp.h HINTS ENV PETSC_DIR PATHS /usr/lib/petsc
            PATH_SUFFIXES include)
  find_path(PETSC_CONF_INCLUDE_DIR petscconf.h HINTS ${PETSC_INCLUDE_DIR}
            $ENV{PETSC_DIR}/$ENV{PETSC_ARCH}/include)
  find_library(PETSC_LIBRARY NAMES petsc_real petsc NAMES_PER_DIR # of the PETSC_DIR first
               HINTS ${PETSC_CONF_INCLUDE_DIR}/../lib ${PETSC_INCLUDE_DIR}/../lib)
  mark_as_advanced(PETSC_INCLUDE_DIR PETSC_CONF_INCLUDE_DIR PETSC_LIBRARY)
  # these may be of a PETSc that was removed since
  if(EXISTS "${PETSC_INCLUDE_DIR}/petscksp.h" AND EXISTS "${PETSC_CONF_INCLUDE_DIR}/petscconf.h" AND
     EXISTS "${PETSC_LIBRARY}")
    file(STRINGS ${PETSC_CONF_INCLUDE_DIR}/petscconf.h petsc_is_another
         REGEX "define PETSC_USE_(COMPLEX|64BIT_INDICES|REAL_SINGLE|REAL___FLOAT128)")
    file(STRINGS ${PETSC_CONF_INCLUDE_DIR}/petscconf.h petsc_has_mumps
         REGEX "define PETSC_HAVE_MUMPS ")
    find_package(MPI QUIET COMPONENTS CXX)
    if(TARGET MPI::MPI_CXX AND petsc_has_mumps AND NOT petsc_is_another)
      add_library(CGAL::Petsc_support INTERFACE IMPORTED)
      set_target_properties(CGAL::Petsc_support PROPERTIES
        INTERFACE_COMPILE_DEFINITIONS "CGAL_LINKED_WITH_PETSC;OMPI_SKIP_MPICXX;MPICH_SKIP_MPICXX"
        INTERFACE_INCLUDE_DIRECTORIES "${PETSC_INCLUDE_DIR};${PETSC_CONF_INCLUDE_DIR}"
        INTERFACE_LINK_LIBRARIES "${PETSC_LIBRARY};MPI::MPI_CXX")
    endif()
  endif()
endif()
