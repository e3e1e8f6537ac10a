# doctest, for the tests only: the system's header, else a pinned upstream release.
find_path(DOCTEST_INCLUDE_DIR doctest/doctest.h)
add_library(doctest_header INTERFACE)
if(DOCTEST_INCLUDE_DIR)
  target_include_directories(doctest_header SYSTEM INTERFACE ${DOCTEST_INCLUDE_DIR})
else()
  message(STATUS "doctest/doctest.h not found: fetching the upstream release")
  include(FetchContent)
  FetchContent_Declare(doctest_upstream
    URL https://github.com/doctest/doctest/archive/refs/tags/v2.4.11.tar.gz
    URL_HASH SHA256=632ed2c05a7f53fa961381497bf8069093f0d6628c5f26286161fbd32a560186)
  FetchContent_Populate(doctest_upstream)
  target_include_directories(doctest_header SYSTEM INTERFACE ${doctest_upstream_SOURCE_DIR})
endif()
# An assertion is one call, not a block of code with its own handlers of exceptions: a fifth less to
# compile. A test case ends where an assertion throws.
target_compile_definitions(doctest_header INTERFACE DOCTEST_CONFIG_SUPER_FAST_ASSERTS)
