// SPDX-License-Identifier: MIT
// --largest and --min-component: the mesh is that of the chosen components, as if there were no
// others.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "base/random.h"
#include "check/triangle_tree.h"
#include "check/verify.h"
#include "coarsen/contour_as_mesh.h"
#include "deliso/mesh_isosurface.h"
#include "fields.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

// Round bodies of 1 to 4 voxels' radius, some of which meet, touch the box, or nearly touch.
Volume blobs(std::uint64_t seed, std::size_t count, Vec3 spacing = {1, 1, 1}) {
  constexpr int kSize = 22;
  Random random(seed);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t n = 0; n < count; ++n) {
    centers.push_back(
        {random.uniform(0, kSize), random.uniform(0, kSize), random.uniform(0, kSize)});
    radii.push_back(random.uniform(1, 4));
  }
  return sampled<float>({kSize, kSize, kSize}, spacing, [&](int i, int j, int k) {
    double inside = -100;
    for (std::size_t n = 0; n < count; ++n) {
      const Vec3 d = Vec3{1.0 * i, 1.0 * j, 1.0 * k} - centers[n];
      inside = std::max(inside, radii[n] - length(d));
    }
    return inside;
  });
}

double longest_edge(const TriMesh& mesh) {
  double longest = 0;
  for (const Face& face : mesh.faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      longest =
          std::max(longest, distance(mesh.points[face.v[i]], mesh.points[face.v[(i + 1) % 3]]));
    }
  }
  return longest;
}

// The component of T whose triangle is nearest, for each vertex of the mesh.
std::vector<std::uint32_t> nearest_components(const TriMesh& mesh, const ContourMesh& contour) {
  const TriMesh exact = contour_as_mesh(contour).mesh;
  const std::vector<Triangle> triangles = exact.triangles();
  const TriangleTree tree(exact.points, triangles);
  std::vector<std::uint32_t> components;
  for (const Vec3& p : mesh.points) {
    const FaceId t = tree.nearest(p).triangle;
    components.push_back(contour.component[contour.triangles[t][0]]);
  }
  return components;
}

// What holds of a mesh of some components, beside one of all.
void check_chosen(const Volume& volume, const Options& options) {
  Options of_all = options;
  of_all.components = {};
  Report report, report_of_all;
  const TriMesh mesh = mesh_isosurface(volume, 0, options, report);
  const TriMesh all = mesh_isosurface(volume, 0, of_all, report_of_all);
  CHECK(longest_edge(mesh) <= 2 * longest_edge(all));
  CHECK(report[Counter::points_far] <= report_of_all[Counter::points_far]);
  // Facets between sheets of noise stay over a limit or not by chance, one in twenty here.
  const std::uint64_t unrefined = report_of_all[Counter::unrefined_facets];
  CHECK(report[Counter::unrefined_facets] <= unrefined + 2 + unrefined / 20);

  const ContourMesh contour = build_contour(volume, report.kappa_effective);
  const std::vector<std::uint8_t> chosen = chosen_components(contour.summary, options.components);
  std::size_t elsewhere = 0;
  for (const std::uint32_t c : nearest_components(mesh, contour)) elsewhere += !chosen[c];
  CHECK(elsewhere == 0);

  VerifyOptions checks;
  checks.components = options.components;
  const Verification v = verify(mesh, volume, report.kappa_effective, checks);
  CHECK_FALSE(v.faults.any());
  CHECK(v.from_surface.max <= 2 * volume.voxel());
}

}  // namespace

TEST_CASE("no vertex lies on a component that is left out, and no edge leads to one") {
  std::size_t some_left_out = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    CAPTURE(seed);
    const Volume volume = blobs(seed, 2 + seed % 12, seed % 3 == 0 ? Vec3{1, 1, 3} : Vec3{1, 1, 1});
    Options options;
    options.stop_after_stage1 = seed % 5 == 4;
    if (seed % 2 == 0) options.components.largest = 1 + seed % 3;
    if (seed % 2 == 1) options.components.min_voxels = 6;
    check_chosen(volume, options);
    const ContourSummary all = summarize_contour(volume, geometric_isovalue(volume.type(), 0));
    some_left_out += std::ranges::count(chosen_components(all, options.components), 0) > 0;
  }
  CHECK(some_left_out >= 15);
}

// The distance that is reported with a number of vertices is that of chosen components.
TEST_CASE("points far from the mesh, and the furthest, are counted on chosen components") {
  const Volume volume = blobs(1, 8);
  Options options;
  options.components.largest = 1;
  options.target_vertices = 60;
  Report report;
  const TriMesh mesh = mesh_isosurface(volume, 0, options, report);
  CHECK(mesh.points.size() == 60);
  CHECK(report.max_distance < 1.5);

  // With this bound, and facets so large, most points of a component stay far.
  options = {};
  options.components.largest = 1;
  options.limits[Criterion::distance] = {1e-4, Length::Unit::voxel};
  options.r_min = {2, Length::Unit::voxel};
  mesh_isosurface(volume, 0, options, report = {});
  const ContourMesh contour = build_contour(volume, report.kappa_effective);
  const std::vector<std::uint8_t> chosen = chosen_components(contour.summary, options.components);
  std::uint64_t points = 0;
  for (const std::uint32_t c : contour.component) points += chosen[c];
  REQUIRE(points < contour.points.size());
  CHECK(report[Counter::points_far] > 0);
  CHECK(report[Counter::points_far] <= points);
}
