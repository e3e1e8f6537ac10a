// SPDX-License-Identifier: MIT
// The numbers behind --color-by, against triangles and fields where they are known.
#include "app/facet_values.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

using Triangles = std::vector<Triangle>;

// x + 2 y - 2 z, whose gradient is 3 everywhere: trilinear interpolation reproduces it.
Volume slope() {
  return sampled<float>({9, 9, 9}, {0.5, 0.5, 0.5}, [&](int i, int j, int k) {
    return 0.5f * static_cast<float>(i + 2 * j - 2 * k);
  });
}

}  // namespace

TEST_CASE("smallest angles: of an equilateral, a right, a flat triangle and one without area") {
  const TriMesh mesh = make_tri_mesh(
      {{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}, {0, 1, 0}, {2, 0, 0}, {0.5, 0, 1e-3}},
      Triangles{{0, 1, 2}, {0, 1, 3}, {0, 1, 5}, {0, 1, 4}});
  const std::vector<double> angles = smallest_angles(mesh);
  REQUIRE(angles.size() == 4);
  CHECK(angles[0] == doctest::Approx(60));
  CHECK(angles[1] == doctest::Approx(45));
  CHECK(angles[2] == doctest::Approx(std::atan(2e-3) * 180 / 3.14159265358979));
  CHECK(angles[3] == 0);
}

TEST_CASE("components are numbered from the largest on, and share vertices") {
  // Sizes 1, 3, 2, 1; the second is a fan around one vertex, two of whose facets share no edge.
  std::vector<Vec3> points(20);
  const TriMesh mesh = make_tri_mesh(
      points,
      Triangles{
          {0, 1, 2}, {3, 4, 5}, {10, 11, 12}, {3, 5, 6}, {3, 7, 8}, {11, 10, 13}, {17, 18, 19}});
  const FacetComponents components = facet_components(mesh);
  CHECK(components.count == 4);
  CHECK(components.of_facet == std::vector<std::uint32_t>{2, 0, 1, 0, 0, 1, 3});
  CHECK(facet_components(TriMesh{}).count == 0);
}

TEST_CASE("the largest components that have 99 % of the area are framed, specks are not") {
  // Right triangles with legs 10, 0.8, and 0.3: areas 50, 0.32, 0.045.
  std::vector<Vec3> points;
  Triangles triangles;
  for (const double leg : {0.3, 10.0, 0.8}) {
    const auto v = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), {{0, 0, leg}, {leg, 0, leg}, {0, leg, leg}});
    triangles.push_back(triangle_of(v, v + 1, v + 2));
  }
  const auto framed = [&](const TriMesh& mesh) {
    return facets_of_most_area(mesh, facet_components(mesh));
  };
  using Marks = std::vector<std::uint8_t>;
  CHECK(framed(make_tri_mesh(points, triangles)) == Marks{0, 1, 0});
  points[4].x = 1;  // the largest has now an area of 5
  CHECK(framed(make_tri_mesh(points, triangles)) == Marks{0, 1, 1});
  const std::vector<Vec3> flat(6);
  CHECK(framed(make_tri_mesh(flat, Triangles{{0, 1, 2}, {3, 4, 5}})) == Marks{1, 1});
}

TEST_CASE("distances of triangles beside a plane, in voxels") {
  const Volume volume = slope();
  const Vec3 normal = Vec3{1, 2, -2} / 3;
  const Vec3 across{2 / std::sqrt(5), -1 / std::sqrt(5), 0}, other = cross(normal, across);
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const double kappa = random.uniform(0.5, 2.5), off = random.uniform(-0.3, 0.3);
    // Where the plane has the value kappa, and `off` beside it.
    const Vec3 middle{2, 2, 2};
    const Vec3 on = middle + (kappa - dot({1, 2, -2}, middle)) / 3 * normal;
    const Vec3 p = on + off * normal;
    const TriMesh mesh =
        make_tri_mesh({p, p + 0.2 * across, p + 0.3 * other}, Triangles{{0, 1, 2}});
    CHECK(distances_in_voxels(mesh, volume, kappa)[0] ==
          doctest::Approx(std::abs(off) / 0.5).epsilon(1e-4));
    CHECK(gradient_sizes(mesh, volume)[0] == doctest::Approx(3));
  }
  TriMesh far = make_tri_mesh({{1e3, 0, 0}, {1e3, 1, 0}, {1e3, 0, 1}}, Triangles{{0, 1, 2}});
  CHECK(distances_in_voxels(far, volume, 1)[0] == std::numeric_limits<double>::infinity());
}
