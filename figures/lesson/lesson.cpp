// SPDX-License-Identifier: MIT
// Writes the lesson: the guide's six pictures as a page whose sites the reader drags.
// Usage: lesson PAGE.html   (`make figures` writes docs/lesson.html)
#include <cstdio>
#include <string>

#include "base/check.h"
#include "base/text.h"
#include "lesson/field.h"
#include "view/page/page.h"
#include "view/page/web_sources.h"

namespace deliso {

// The files of figures/lesson/web.
std::span<const WebSource> lesson_sources();

namespace {

template <class Items, class Print>
std::string list_of(const Items& items, Print&& print) {
  std::string all = "[";
  for (const auto& item : items) {
    if (all.size() > 1) all += ',';
    all += print(item);
  }
  all += ']';
  return all;
}

std::string lesson_header() {
  using namespace lesson;
  return text("{\"kind\":\"lesson\",\"columns\":", kColumns, ",\"rows\":", kRows,
              ",\"isovalue\":", kIsovalue,
              ",\"samples\":", list_of(kSamples, [](int value) { return text(value); }),
              ",\"sites\":",
              list_of(kPlaces, [](const Place& p) { return text("[", p.x, ",", p.y, "]"); }), "}");
}

}  // namespace
}  // namespace deliso

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s PAGE.html\n", argv[0]);
    return 2;
  }
  try {
    deliso::write_page(argv[1], "A mesh in six screens", deliso::lesson_header(), {},
                       {"lesson.html", deliso::lesson_sources()});
  } catch (const deliso::InputError& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 2;
  }
}
