# Writes OUTPUT, a C++ file with the text of every file of the list SOURCES, which FUNCTION returns:
# view/page/web_sources.h.
# Compilers need only take string literals of 65,536 characters, so a text is cut, at ends of lines.
set(most 15000)
set(definitions "")
set(table "")
set(number 0)
foreach(source IN LISTS SOURCES)
  file(READ ${source} rest)
  set(literals "")
  while(NOT rest STREQUAL "")
    string(SUBSTRING "${rest}" 0 ${most} piece)
    string(FIND "${piece}" "\n" end REVERSE)
    if(end EQUAL -1)
      message(FATAL_ERROR "${source}: a line is too long, or the last one has no end")
    endif()
    math(EXPR end "${end} + 1")
    string(SUBSTRING "${rest}" 0 ${end} piece)
    string(SUBSTRING "${rest}" ${end} -1 rest)
    string(APPEND literals "R\"~web~(${piece})~web~\",\n")
  endwhile()
  get_filename_component(name ${source} NAME)
  string(APPEND definitions "constexpr std::string_view kText${number}[] = {\n${literals}};\n")
  string(APPEND table "    {\"${name}\", kText${number}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUTPUT} "// Made by cmake/embed_web_sources.cmake.
#include \"view/page/web_sources.h\"

namespace deliso {
namespace {

${definitions}
constexpr WebSource kSources[] = {
${table}};

}  // namespace

std::span<const WebSource> ${FUNCTION}();
std::span<const WebSource> ${FUNCTION}() {
  return kSources;
}

}  // namespace deliso
")
