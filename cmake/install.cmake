# What `cmake --install` lays down: the library, its headers, the program, and the package that
# find_package(deliso) finds.
include(CMakePackageConfigHelpers)

install(TARGETS deliso EXPORT deliso_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY src/ ${PROJECT_BINARY_DIR}/generated/
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/deliso
        FILES_MATCHING PATTERN "*.h" PATTERN "app" EXCLUDE)
if(TARGET deliso_app)
  install(TARGETS deliso_app RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/deliso)
install(EXPORT deliso_targets NAMESPACE deliso:: DESTINATION ${package_dir})
configure_package_config_file(cmake/deliso-config.cmake.in ${PROJECT_BINARY_DIR}/deliso-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/deliso-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/deliso-config.cmake
              ${PROJECT_BINARY_DIR}/deliso-config-version.cmake DESTINATION ${package_dir})
