# doctest, for the tests only: the system's header, else a pinned upstream release.
find_path(DOCTEST_INCLUDE_DIR doctest/doctest.h)
add_library(doctest_header INTERFACE)
if(NOT DOCTEST_INCLUDE_DIR)
  set(DOCTEST_INCLUDE_DIR ${PROJECT_BINARY_DIR}/doctest-2.4.11)
  if(NOT EXISTS ${DOCTEST_INCLUDE_DIR})
    message(STATUS "doctest/doctest.h not found: fetching the upstream release")
    set(archive ${PROJECT_BINARY_DIR}/doctest.tar.gz)
    file(DOWNLOAD https://github.com/doctest/doctest/archive/refs/tags/v2.4.11.tar.gz ${archive}
         STATUS status)
    file(SHA256 ${archive} sum)
    if(NOT sum STREQUAL 632ed2c05a7f53fa961381497bf8069093f0d6628c5f26286161fbd32a560186)
      message(FATAL_ERROR "The tests need doctest, which is not there: install doctest-dev, or give "
                          "-DDOCTEST_INCLUDE_DIR=FOLDER that has doctest/doctest.h")
    endif()
    file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${PROJECT_BINARY_DIR})
  endif()
endif()
target_include_directories(doctest_header SYSTEM INTERFACE ${DOCTEST_INCLUDE_DIR})
# An assertion is one call, not a block of code with its own handlers of exceptions: a fifth less to
# compile. A test case ends where an assertion throws.
target_compile_definitions(doctest_header INTERFACE DOCTEST_CONFIG_SUPER_FAST_ASSERTS)
