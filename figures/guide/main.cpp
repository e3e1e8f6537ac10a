// SPDX-License-Identifier: MIT
// Draws the pictures of docs/guide, from built-in fields and by the library's own functions.
// Usage: guide_figures FOLDER [NAME...]   (all of them where none is named)
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string_view>
#include <vector>

#include "base/check.h"
#include "guide/figures.h"

namespace {

using namespace deliso::guide;

struct Figure {
  std::string_view name;
  void (*draw)(const std::string& folder);
};
constexpr Figure kFigures[] = {
    {"six-pictures", draw_six_pictures},
    {"roots", draw_roots},
    {"predicates", draw_predicates},
    {"delaunay", draw_delaunay},
    {"kdtree", draw_kdtree},
    {"oracle", draw_oracle},
    {"contour", draw_contour},
    {"recover-paper", draw_recover_paper},
    {"stars", draw_stars},
    {"patches", draw_patches},
    {"certificate", draw_certificate},
    {"cells", draw_cells},
    {"torus", draw_torus},
    {"certified", draw_certified},
    {"coarsen", draw_coarsen},
    {"insert", draw_insert},
    {"gates", draw_gates},
    {"operations", draw_operations},
    {"boundary", draw_boundary},
    {"checking", draw_checking},
    {"fineness", draw_fineness},
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s FOLDER [NAME...]\n", argv[0]);
    return 2;
  }
  const std::vector<std::string_view> names(argv + 2, argv + argc);
  try {
    for (const Figure& figure : kFigures) {
      if (!names.empty() && std::find(names.begin(), names.end(), figure.name) == names.end())
        continue;
      figure.draw(argv[1]);
    }
  } catch (const deliso::InputError& error) {
    std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
    return 2;
  }
}
