// SPDX-License-Identifier: MIT
// Writes the lesson: one page that explains the method, with pictures that the reader changes.
// Usage: lesson PAGE.html   (`make figures` writes docs/index.html)
#include <algorithm>
#include <cstdio>
#include <string>

#include "base/check.h"
#include "base/text.h"
#include "io/files/append_format.h"
#include "lesson/cells.h"
#include "lesson/field.h"
#include "lesson/small_surfaces.h"
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

std::string point(const Vec3& p) {
  std::string out;
  append_format(out, "[%.3g,%.3g,%.3g]", p.x, p.y, p.z);
  return out;
}
std::string points(const std::vector<Vec3>& all) {
  return list_of(all, point);
}
template <class Tuples>
std::string numbers(const Tuples& tuples) {
  return list_of(tuples,
                 [](const auto& tuple) { return list_of(tuple, [](int n) { return text(n); }); });
}

std::string cell(const lesson::Cell& c) {
  return text("\n{\"title\":\"", c.title, "\",\"text\":\"", c.text,
              "\",\"sides\":", list_of(c.sides, points),
              ",\"surface\":", list_of(c.surface, points), ",\"ends\":", list_of(c.ends, points),
              "}");
}

// What of the surface is in a cell, and its ends, by numbers of points.
std::string piece(const lesson::Cell& c) {
  std::vector<Vec3> all;
  const auto number_of = [&](const Vec3& p) {
    const auto is_here = [&](const Vec3& q) { return distance2(p, q) < 1e-14; };
    const std::size_t n = std::ranges::find_if(all, is_here) - all.begin();
    if (n == all.size()) all.push_back(p);
    return text(n);
  };
  const auto numbered = [&](const lesson::Polygon& polygon) { return list_of(polygon, number_of); };
  const std::string surface = list_of(c.surface, numbered), ends = list_of(c.ends, numbered);
  return text("\n{\"site\":", point(c.site), ",\"points\":", points(all), ",\"surface\":", surface,
              ",\"ends\":", ends, "}");
}

// Both meshes in the unit ball.
std::string small_surface(lesson::SmallSurface s) {
  for (auto* mesh : {&s.t, &s.k}) {
    for (Vec3& p : mesh->points) p = 0.4 * (p - Vec3{2, 1.6, 0.7});
  }
  return text("\n{\"title\":\"", s.title, "\",\"text\":\"", s.above, "; K: ", s.below,
              "\",\"points\":", points(s.t.points), ",\"labels\":\"", s.t.labels,
              "\",\"triangles\":", numbers(s.t.triangles), ",\"dual\":", points(s.k.points),
              ",\"facets\":", numbers(s.k.triangles), ",\"wrong\":", numbers(s.wrong),
              ",\"marks\":\"", s.marks, "\"}");
}

std::string lesson_header() {
  using namespace lesson;
  return text(
      "{\"kind\":\"lesson\",\"columns\":", kColumns, ",\"rows\":", kRows,
      ",\"isovalue\":", kIsovalue, ",\"chosen\":[", kSaddleColumn, ",", kSaddleRow, "]",
      ",\"samples\":", list_of(kSamples, [](int value) { return text(value); }),
      ",\"sites\":", list_of(kPlaces, [](const Place& p) { return text("[", p.x, ",", p.y, "]"); }),
      ",\"torus\":", list_of(torus_cells(), piece), ",\"cells\":", list_of(example_cells(), cell),
      ",\"broken\":", list_of(small_surfaces(), small_surface), "}");
}

}  // namespace
}  // namespace deliso

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s PAGE.html\n", argv[0]);
    return 2;
  }
  try {
    deliso::write_page(argv[1], "A mesh in six pictures: how DelIso meshes an isosurface",
                       deliso::lesson_header(), {}, {"lesson.html", deliso::lesson_sources()});
  } catch (const deliso::InputError& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 2;
  }
}
