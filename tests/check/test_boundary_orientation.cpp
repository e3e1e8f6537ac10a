// SPDX-License-Identifier: MIT
// A coarse mesh is not called reversed, and a reversed one is, whatever faces of the box it meets.
#include "check/boundary_orientation.h"

#include <doctest/doctest.h>

#include <vector>

#include "cases.h"
#include "check/verify.h"
#include "deliso/mesh_isosurface.h"
#include "stress/tiny_volume.h"

namespace deliso {
namespace {

std::size_t reversed_components(const TriMesh& mesh, const Volume& volume, double kappa) {
  return verify(mesh, volume, kappa, {}).faults.count(FaultKind::turned_components);
}

TriMesh reversed(const TriMesh& mesh) {
  std::vector<Triangle> triangles;
  for (const Face& face : mesh.faces) triangles.push_back({face.v[1], face.v[0], face.v[2]});
  return make_tri_mesh(mesh.points, triangles);
}

}  // namespace

// As few vertices as the topology allows: facets stand across the gradient, or lie in a face of the
// box. They bound no volume if they meet opposite faces.
TEST_CASE("the coarsest meshes of random volumes have the orientation of Sigma") {
  std::size_t components = 0, found = 0;
  for (std::uint64_t seed = 1; seed <= test::costly_cases(45u); ++seed) {
    CAPTURE(seed);
    const stress::TinyVolume tiny = stress::make_tiny_volume(seed);
    Options options;
    options.target_vertices = 4;
    Report report;
    const TriMesh mesh = mesh_isosurface(tiny.volume, tiny.isovalue, options, report);
    if (mesh.faces.empty()) continue;
    CHECK(reversed_components(mesh, tiny.volume, report.kappa_effective) == 0);
    components += report.exact.components;
    found += reversed_components(reversed(mesh), tiny.volume, report.kappa_effective);
  }
  // Components that lie in a face of the box face both ways.
  CHECK(components > test::costly_cases(90u));
  CHECK(found > 0.95 * static_cast<double>(components));
}

// Vertices lie along edges of the box whose samples equal the isovalue. No curve passes there, and
// they voted for a reversed component.
TEST_CASE("vertices on an edge of the box that lies on the surface do not vote") {
  const Volume volume = Volume::from_samples<double>(
      {2, 2, 3}, {1.902888514587888, 3.113465407225445, 0.7846870779761093},
      {1, 2, 1, 2, 1, 2, 0, 1, 1, 1, 0, 1});
  Report report;
  const TriMesh mesh = mesh_isosurface(volume, 1, {}, report);
  CHECK(reversed_components(mesh, volume, report.kappa_effective) == 0);
  CHECK(reversed_components(reversed(mesh), volume, report.kappa_effective) == 1);
}

}  // namespace deliso
