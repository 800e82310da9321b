# What `cmake --install` installs, in three parts: "development" (headers, compiled core if there is
# one, CMake's package), "command" (arap_deform and its man page), and "documents"; and the Debian
# packages of the first two.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(libraries ARAP_deformation_headers)
if(TARGET ARAP_deformation_core)
  list(APPEND libraries ARAP_deformation_core)
  set_property(TARGET ARAP_deformation_core PROPERTY EXCLUDE_FROM_ALL OFF)
endif()
target_include_directories(ARAP_deformation_headers INTERFACE # those of imported targets are SYSTEM
                           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/ARAP_deformation)
install(DIRECTORY include/CGAL DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(TARGETS ${libraries} EXPORT ARAP_deformation
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT ARAP_deformation NAMESPACE ARAP_deformation:: FILE ARAP_deformationTargets.cmake
        DESTINATION ${folder} COMPONENT development)

# programs are compiled with the libraries that the core is compiled with
set(ARAP_deformation_found)
foreach(library TBB Cholmod METIS)
  if(TARGET CGAL::${library}_support)
    list(APPEND ARAP_deformation_found ${library})
  endif()
endforeach()
configure_package_config_file(packaging/ARAP_deformationConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/ARAP_deformationConfig.cmake INSTALL_DESTINATION ${folder}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/ARAP_deformationConfigVersion.cmake
                                 COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/ARAP_deformationConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/ARAP_deformationConfigVersion.cmake
              cmake/ARAP_deformation_accelerators.cmake cmake/CGAL_Cholmod_support.cmake
        DESTINATION ${folder} COMPONENT development)
set(documents ${CMAKE_INSTALL_DATAROOTDIR}/doc/ARAP_deformation)
if(is_top_level) # else that folder is the parent's
  set(documents ${CMAKE_INSTALL_DOCDIR})
endif()
install(FILES LICENSE CHANGES.md DESTINATION ${documents} COMPONENT documents)

if(TARGET arap_deform)
  install(TARGETS arap_deform DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
  find_program(HELP2MAN help2man)
  mark_as_advanced(HELP2MAN)
  if(HELP2MAN AND NOT CMAKE_CROSSCOMPILING)
    set(page ${CMAKE_CURRENT_BINARY_DIR}/arap_deform.1)
    set(script ${CMAKE_CURRENT_SOURCE_DIR}/packaging/man_page.sh)
    add_custom_command(OUTPUT ${page}
      COMMAND ${script} $<TARGET_FILE:arap_deform> ${PROJECT_VERSION} > ${page}
      DEPENDS arap_deform ${script} VERBATIM)
    add_custom_target(arap_deform_man ALL DEPENDS ${page})
    install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
  else()
    message(STATUS "NOTICE: without help2man arap_deform gets no man page.")
  endif()
endif()

if(NOT is_top_level)
  return()
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The ARAP_deformation authors <nobody@example.invalid>")
if(NOT "$ENV{DEBEMAIL}" STREQUAL "" AND NOT "$ENV{DEBFULLNAME}" STREQUAL "") # who publishes the packages
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
    GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_SOURCE_DIR}/packaging/debian/documents.cmake)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)

set(CPACK_COMPONENTS_ALL development)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libarap-deformation-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "as-rigid-as-possible deformation of meshes with CGAL
Surfaces and tetrahedral volumes are deformed as rigidly as possible: some
vertices are moved, and the rest follows so that every small part only
rotates. These are the headers, the compiled core, and CMake's package
ARAP_deformation.")
set(depends "libcgal-dev (>= 5.5)" "libeigen3-dev (>= 3.4)")
foreach(library TBB:libtbb-dev Cholmod:libsuitesparse-dev METIS:libmetis-dev)
  string(REGEX MATCH "(.*):(.*)" library ${library})
  if(CMAKE_MATCH_1 IN_LIST ARAP_deformation_found)
    list(APPEND depends ${CMAKE_MATCH_2})
  endif()
endforeach()
string(REPLACE ";" ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${depends}")

if(TARGET arap_deform)
  list(APPEND CPACK_COMPONENTS_ALL command)
  set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME arap-deform)
  set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "ffmpeg, povray")
  set(CPACK_COMPONENT_COMMAND_DESCRIPTION "deform a mesh as rigidly as possible
The command arap_deform moves handles of a surface or of a tetrahedral volume
in a file, and lets the rest follow so that every small part only rotates. It
also makes frames and films, and time steps of bodies under gravity.")
endif()
include(CPack)
