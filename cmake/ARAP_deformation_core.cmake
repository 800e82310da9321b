# The library ARAP_deformation::core: the parts of the package that are not templates, compiled once.
# Programs linked with it compile faster than with ARAP_deformation::headers, which is header-only.
# With ARAP_DEFORMATION_HEADER_ONLY there are only the headers.
if(NOT TARGET ARAP_deformation_headers)
  include(${CMAKE_CURRENT_LIST_DIR}/ARAP_deformation_accelerators.cmake)
  set(ARAP_deformation_libraries CGAL::CGAL CGAL::Eigen3_support ARAP_deformation_accelerators)
  get_filename_component(ARAP_deformation_include ${CMAKE_CURRENT_LIST_DIR}/../include ABSOLUTE)

  add_library(ARAP_deformation_headers INTERFACE)
  target_compile_features(ARAP_deformation_headers INTERFACE cxx_std_17)
  target_include_directories(ARAP_deformation_headers SYSTEM INTERFACE # no warnings of any kind
                             $<BUILD_INTERFACE:${ARAP_deformation_include}>)
  target_link_libraries(ARAP_deformation_headers INTERFACE ${ARAP_deformation_libraries})
  add_library(ARAP_deformation::headers ALIAS ARAP_deformation_headers)
  set_property(TARGET ARAP_deformation_headers PROPERTY EXPORT_NAME headers)
endif()

if(NOT TARGET ARAP_deformation_core AND NOT ARAP_DEFORMATION_HEADER_ONLY)
  add_library(ARAP_deformation_core STATIC EXCLUDE_FROM_ALL
              ${CMAKE_CURRENT_LIST_DIR}/../src/ARAP_deformation/core.cpp)
  if(NOT DEFINED CMAKE_POSITION_INDEPENDENT_CODE) # a shared library may link with it, too
    set_property(TARGET ARAP_deformation_core PROPERTY POSITION_INDEPENDENT_CODE ON)
  endif()
  target_compile_features(ARAP_deformation_core PRIVATE cxx_std_17)
  target_compile_definitions(ARAP_deformation_core PUBLIC CGAL_ARAP_DEFORMATION_COMPILED)
  target_include_directories(ARAP_deformation_core PRIVATE ${ARAP_deformation_include})
  target_link_libraries(ARAP_deformation_core PRIVATE ${ARAP_deformation_libraries}
                                              INTERFACE ARAP_deformation_headers)
  add_library(ARAP_deformation::core ALIAS ARAP_deformation_core)
  set_property(TARGET ARAP_deformation_core PROPERTY EXPORT_NAME core)
  # optimized too where nothing says how
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES
     AND CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang" AND NOT CMAKE_CXX_FLAGS MATCHES "-O")
    message(STATUS "NOTICE: CMAKE_BUILD_TYPE is not set: the library ARAP_deformation_core is "
                   "optimized, what is linked with it is not. Release optimizes both.")
    target_compile_options(ARAP_deformation_core PRIVATE -O3)
  endif()
endif()
