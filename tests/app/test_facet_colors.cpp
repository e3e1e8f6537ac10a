// SPDX-License-Identifier: MIT
// The colors and scales that --color-by gives meshes whose numbers are known.
#include "app/facet_colors.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "app/parsed_line.h"
#include "base/check.h"
#include "view/render/color_map.h"

using namespace deliso;

using Triangles = std::vector<Triangle>;

namespace {

FacetColors colors_of(std::span<const TriMesh> meshes, const std::string& more,
                      const std::vector<MeshNotes>& notes = {}) {
  std::string arguments = "render -o m.png";
  for (std::size_t n = 0; n < meshes.size(); ++n) arguments += " m.ply";
  const CommandLine line = test::parsed(arguments + more);
  if (line.input.empty()) return color_facets(meshes, notes, line, nullptr);
  const Input input = read_input(line);
  return color_facets(meshes, notes, line, &input);
}

}  // namespace

TEST_CASE("colors of a known mesh by side, component and angle") {
  const std::array meshes{
      make_tri_mesh({{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}, {0, 1, 0}},
                    Triangles{{0, 1, 2}, {0, 1, 3}}),
      make_tri_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {4, 4, 4}, {5, 4, 4}, {4, 5, 4}},
                    Triangles{{0, 1, 2}, {3, 4, 5}})};
  const FacetColors sides = colors_of(meshes, "");
  REQUIRE(sides.of_mesh.size() == 2);
  CHECK(sides.of_mesh[0].empty());
  CHECK_FALSE(sides.bar.has_value());
  CHECK(sides.components.empty());

  const FacetColors components = colors_of(meshes, " --color-by component");
  CHECK(components.components == std::vector<std::size_t>{1, 2});
  CHECK(components.of_mesh[1] == std::vector<Rgb>{category_color(0), category_color(1)});
  CHECK_FALSE(components.bar.has_value());

  const FacetColors angles = colors_of(meshes, " --color-by angle");
  REQUIRE(angles.bar.has_value());
  CHECK(angles.bar->hi == 60);
  CHECK_FALSE(angles.bar->open);
  CHECK(angles.of_mesh[0] == std::vector<Rgb>{sequential_color(1), sequential_color(0.75)});
}

TEST_CASE("colors by label are those of the file, or of the label behind") {
  const std::array meshes{
      make_tri_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, Triangles{{0, 1, 2}, {0, 1, 3}})};
  MeshNotes notes;
  CHECK_THROWS_WITH_AS(
      colors_of(meshes, " --color-by label", {notes}),
      "--color-by label: 'm.ply' has no colors; a .glb, .3mf or .vtp of --label all has, and a "
      ".ply, .vtp or .glb of --shared",
      InputError);
  notes.sides = {{2, 0}, {-3, 5}};
  CHECK(colors_of(meshes, " --color-by label", {notes}).of_mesh.front() ==
        std::vector<Rgb>{category_color(2), category_color(5)});
  notes.colors = {{1, 2, 3}, {4, 5, 6}};
  CHECK(colors_of(meshes, " --color-by label", {notes}).of_mesh.front() ==
        std::vector<Rgb>{{1, 2, 3}, {4, 5, 6}});
}

TEST_CASE("colors by the volume: triangles that touch shells around a sphere") {
  // The built-in sphere: radius 0.7 of half the box, which is 31.5 voxels; its field grows by 1
  // over that half, and its own isovalue is the default.
  const Vec3 top{31.5, 31.5, 31.5 + 0.7 * 31.5};
  std::vector<TriMesh> meshes;
  for (const double above : {0.0, 0.5, 1.0}) {
    const Vec3 p = top + Vec3{0, 0, above};
    meshes.push_back(make_tri_mesh(
        {p + Vec3{0.1, 0, 0}, p + Vec3{0, 0.1, 0}, p - Vec3{0.1, 0.1, 0}}, Triangles{{0, 1, 2}}));
  }
  const FacetColors distances = colors_of(meshes, " --color-by distance --volume builtin:sphere");
  REQUIRE(distances.bar.has_value());
  CHECK(distances.bar->hi >= 1);
  CHECK(distances.bar->hi <= 1.2);
  const FacetColors gradients = colors_of(meshes, " --color-by gradient --volume builtin:sphere");
  REQUIRE(gradients.bar.has_value());
  CHECK(gradients.bar->hi == doctest::Approx(0.04));  // from 1 / 31.5 up
  for (std::size_t n = 0; n < 3; ++n) {
    const Rgb expected = sequential_color(0.5 * static_cast<double>(n) / distances.bar->hi);
    const Rgb is = distances.of_mesh[n].at(0);
    CHECK(std::abs(is.green - expected.green) < 12);
    CHECK(std::abs(gradients.of_mesh[n].at(0).green -
                   sequential_color(1 / 31.5 / gradients.bar->hi).green) < 4);
  }
  std::vector<TriMesh> far{meshes[0]};
  for (Vec3& p : far[0].points) p.x += 1e6;
  CHECK_THROWS_WITH_AS(colors_of(far, " --color-by distance --volume builtin:sphere"),
                       "no triangle is near the isosurface of the volume", InputError);
}
