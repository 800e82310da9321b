# SET AT RELEASE: where the archive of the sources is published, and its SHA512.
set(SOURCE_URL "https://example.invalid/ARAP_deformation-${VERSION}.tar.gz")
set(SOURCE_SHA512 0)

vcpkg_check_linkage(ONLY_STATIC_LIBRARY)
vcpkg_download_distfile(ARCHIVE
    URLS "${SOURCE_URL}"
    FILENAME "ARAP_deformation-${VERSION}.tar.gz"
    SHA512 "${SOURCE_SHA512}"
)
vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE "${ARCHIVE}")

vcpkg_check_features(OUT_FEATURE_OPTIONS FEATURE_OPTIONS
    FEATURES
        tools ARAP_DEFORMATION_DEMO
)
set(accelerators "")
if("tbb" IN_LIST FEATURES)
    set(accelerators TBB)
endif()
vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        ${FEATURE_OPTIONS}
        "-DARAP_DEFORMATION_ACCELERATORS=${accelerators}"
        -DARAP_DEFORMATION_TESTS=OFF
        -DARAP_DEFORMATION_EXAMPLES=OFF
        -DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON
    MAYBE_UNUSED_VARIABLES
        CMAKE_DISABLE_FIND_PACKAGE_MPI
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME ARAP_deformation CONFIG_PATH lib/cmake/ARAP_deformation)
if("tools" IN_LIST FEATURES)
    vcpkg_copy_tools(TOOL_NAMES arap_deform AUTO_CLEAN)
endif()
file(REMOVE_RECURSE
    "${CURRENT_PACKAGES_DIR}/debug/include"
    "${CURRENT_PACKAGES_DIR}/debug/share"
    "${CURRENT_PACKAGES_DIR}/share/doc"
    "${CURRENT_PACKAGES_DIR}/share/man"
)
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
