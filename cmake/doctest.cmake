# doctest, for the tests only: the system's header, else a pinned upstream release.
find_path(DOCTEST_INCLUDE_DIR doctest/doctest.h)
add_library(doctest_header INTERFACE)
if(DOCTEST_INCLUDE_DIR)
  target_include_directories(doctest_header SYSTEM INTERFACE ${DOCTEST_INCLUDE_DIR})
else()
  include(FetchContent)
  FetchContent_Declare(doctest_upstream
    URL https://github.com/doctest/doctest/archive/refs/tags/v2.4.9.tar.gz)
  FetchContent_Populate(doctest_upstream)
  target_include_directories(doctest_header SYSTEM INTERFACE ${doctest_upstream_SOURCE_DIR})
endif()
