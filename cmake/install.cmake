# What `cmake --install` lays down: the library, its headers, the program, the library for other
# languages with the Python package, and the packages that find_package(deliso) and pkg-config find.
include(CMakePackageConfigHelpers)

install(TARGETS deliso EXPORT deliso_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(CODE "
  include(\"${PROJECT_SOURCE_DIR}/cmake/public_headers.cmake\")
  deliso_public_headers(\"${PROJECT_SOURCE_DIR}\" \"${PROJECT_BINARY_DIR}/generated\"
      \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}\")")
if(TARGET deliso_app)
  install(TARGETS deliso_app RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  # The program writes its manual page, the completions of two shells, the schema of its JSON, and
  # the options of the Python package.
  if(NOT CMAKE_CROSSCOMPILING)
    set(share ${CMAKE_INSTALL_DATAROOTDIR})
    foreach(text "man:deliso.1:${share}/man/man1" "schema:report.schema.json:${share}/deliso"
                 "bash:deliso:${share}/bash-completion/completions"
                 "zsh:_deliso:${share}/zsh/site-functions"
                 "python:_options.py:${CMAKE_INSTALL_LIBDIR}/python/deliso")
      string(REPLACE ":" ";" text ${text})
      list(GET text 0 topic)
      list(GET text 1 name)
      list(GET text 2 folder)
      set(file ${PROJECT_BINARY_DIR}/generated/${topic}/${name})
      add_custom_command(TARGET deliso_app POST_BUILD VERBATIM
                         COMMAND deliso_app help ${topic} > ${file})
      file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/generated/${topic})
      install(FILES ${file} DESTINATION ${folder})
    endforeach()
  endif()
  install(TARGETS deliso_c EXPORT deliso_targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  # It finds the library two folders up.
  install(DIRECTORY python/deliso DESTINATION ${CMAKE_INSTALL_LIBDIR}/python
          FILES_MATCHING PATTERN "*.py" PATTERN py.typed PATTERN __pycache__ EXCLUDE)
endif()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/deliso)
install(EXPORT deliso_targets NAMESPACE deliso:: DESTINATION ${package_dir})
configure_package_config_file(cmake/deliso-config.cmake.in ${PROJECT_BINARY_DIR}/deliso-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/deliso-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/deliso-config.cmake
              ${PROJECT_BINARY_DIR}/deliso-config-version.cmake DESTINATION ${package_dir})

file(RELATIVE_PATH DELISO_PC_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/deliso.pc.in ${PROJECT_BINARY_DIR}/deliso.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/deliso.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
