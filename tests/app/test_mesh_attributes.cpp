// SPDX-License-Identifier: MIT
// The values of --attributes, of meshes whose surface is known.
#include "app/mesh_attributes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "app/facet_values.h"
#include "base/triangle.h"
#include "deliso/mesh_isosurface.h"
#include "volume/sampled.h"

using namespace deliso;

namespace {

// A ball of that radius about the middle of a box of 24 voxels, whose last samples in x are left
// out from `end` on; in a frame with sheared axes, mirrored or not.
Volume ball(double radius, int end, bool mirrored) {
  std::vector<float> samples;
  for_each_index({end, 25, 25}, [&](int i, int j, int k) {
    samples.push_back(
        static_cast<float>(radius - length(Vec3{1.0 * i, 1.0 * j, 1.0 * k} - Vec3{12, 12, 12})));
  });
  const double s = mirrored ? -1 : 1;
  const Frame frame{{100, -20, 3}, {Vec3{s, 0, 0}, Vec3{0.6, 0.8, 0}, Vec3{0, 0, 1}}};
  return Volume::from_samples({end, 25, 25}, {1, 1, 1}, samples, frame);
}

struct Run {
  TriMesh mesh, surface;
  MeshAttributes values;
  double kappa = 0;  // lowered, as samples equal the isovalue
};

Run run(const Volume& volume, bool cap) {
  Options options;
  options.cap = cap;
  Report report;
  Run result{mesh_isosurface(volume, 0, options, report), {}, {}};
  result.kappa = report.kappa_effective;
  std::vector<Triangle> triangles;
  const std::size_t end = cap ? report.cap.surface_triangles : result.mesh.faces.size();
  for (FaceId f(0); f < end; ++f) triangles.push_back(result.mesh.faces[f].v);
  result.surface = make_tri_mesh(result.mesh.points, triangles);
  result.values = mesh_attributes(result.mesh, result.surface, volume, report, 2);
  return result;
}

Vec3 normal_at(const Run& run, VertexId v) {
  const auto& [x, y, z] = run.values.normals[v.number()];
  return {x, y, z};
}

}  // namespace

TEST_CASE(
    "normals are unit, at right angles to the surface in the world, and point out of facets") {
  for (const bool mirrored : {false, true}) {
    const Volume volume = ball(8, 25, mirrored);
    const Run r = run(volume, false);
    REQUIRE(r.mesh.points.size() > 100);
    double worst = 1;
    for (VertexId v(0); v < r.mesh.points.size(); ++v) {
      CHECK(length(normal_at(r, v)) == doctest::Approx(1).epsilon(1e-6));
      // The ellipsoid |A^-1 x| = 8 in the world, whose normal is A^-T A^-1 x.
      const Vec3 p = r.mesh.points[v] - Vec3{12, 12, 12};
      const auto& [a, b, c] = volume.frame().axes;
      const double det = dot(cross(a, b), c);
      const Vec3 n = (p.x * cross(b, c) + p.y * cross(c, a) + p.z * cross(a, b)) / det;
      worst = std::min(worst, dot(n / length(n), normal_at(r, v)));
    }
    CHECK(worst > 0.99);
    // Facets as written: reversed if the frame mirrors.
    for (const Face& face : r.mesh.faces) {
      Vec3 w[3];
      for (int i = 0; i < 3; ++i) w[i] = volume.frame().to_world(r.mesh.points[face.v[i]]);
      const Vec3 n = area_normal(w[0], w[mirrored ? 2 : 1], w[mirrored ? 1 : 2]);
      for (const VertexId v : face.v) CHECK(dot(n, normal_at(r, v)) > 0);
    }
  }
}

TEST_CASE("caps have distance 0, and their own vertices the normal of the box") {
  const Volume volume = ball(8, 15, false);
  const Run r = run(volume, true);
  const std::size_t surface = r.surface.faces.size(), all = r.mesh.faces.size();
  REQUIRE(surface < all);
  REQUIRE(r.values.distance.size() == all);
  REQUIRE(r.values.component.size() == all);
  for (std::size_t f = surface; f < all; ++f) CHECK(r.values.distance[f] == 0);
  const std::vector<double> distances = facet_distances(r.surface, volume, r.kappa, 1);
  for (std::size_t f = 0; f < surface; ++f) {
    CHECK(r.values.distance[f] == static_cast<float>(distances[f]));
  }
  CHECK(*std::max_element(distances.begin(), distances.end()) > 0.01);
  std::vector<bool> of_surface(r.mesh.points.size(), false);
  for (const Face& face : r.surface.faces) {
    for (const VertexId v : face.v) of_surface[v.number()] = true;
  }
  // The box's normal at x = 14: along cross(y, z) of the frame.
  std::size_t inside = 0;
  for (VertexId v(0); v < r.mesh.points.size(); ++v) {
    if (of_surface[v.number()]) {
      CHECK(normal_at(r, v).x < 0.99);
    } else {
      ++inside;
      CHECK(distance(normal_at(r, v), Vec3{0.8, -0.6, 0}) < 1e-6);
    }
  }
  CHECK(inside > 0);
  for (const std::uint32_t component : r.values.component) CHECK(component == 0);
}

TEST_CASE("where the gradient is 0 the facets' mean is the normal") {
  const Volume volume = Volume::from_samples({3, 3, 3}, {1, 1, 1}, std::vector<float>(27, 1));
  const TriMesh mesh = make_tri_mesh({{0, 0, 1}, {2, 0, 1}, {0, 2, 1}, {2, 2, 1}},
                                     std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
  Report report;
  const MeshAttributes values = mesh_attributes(mesh, mesh, volume, report, 1);
  for (const auto& normal : values.normals) {
    CHECK(normal == std::array<float, 3>{0, 0, 1});
  }
  // No surface is near: the length of the search.
  for (const float d : values.distance) CHECK(d == doctest::Approx(4 * std::sqrt(3)));
}
