// SPDX-License-Identifier: MIT
// Closed meshes and the checks that all must pass; tiny volumes that are hard to close.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "base/triangle.h"
#include "base/vec2.h"
#include "check/check_mesh.h"
#include "check/place_faults.h"
#include "check/quality.h"
#include "check/self_intersections.h"
#include "deliso/mesh_isosurface.h"
#include "mesh/meshes.h"
#include "more/cap/box_caps.h"
#include "more/planar/plane_predicates.h"
#include "volume/sampled.h"

namespace deliso {

struct ClosedMesh {
  TriMesh mesh;
  Report report;
  std::size_t crossings = 0;
  double lambda = 0;  // the bound on r/l
};

// `make`: mesh_isosurface(), or a substitute.
inline ClosedMesh solid_of(const Volume& volume, double kappa, Options options = {},
                           TriMesh (&make)(const Volume&, double, const Options&,
                                           Report&) = mesh_isosurface) {
  ClosedMesh solid;
  options.cap = true;
  solid.lambda = options.limits[Criterion::r_over_l].value;
  solid.mesh = make(volume, kappa, options, solid.report);
  if (solid.report.cap.failure.empty()) {
    solid.crossings = find_place_faults(solid.mesh.points, solid.mesh.triangles()).crossings;
  }
  return solid;
}

// Returns the face of the box that a cap triangle lies on; -1 if it lies on none.
inline int face_of(const TriMesh& mesh, const Face& face, const Box3& box) {
  unsigned common = 63;
  for (const VertexId v : face.v) common &= box_faces_at(mesh.points[v], box);
  for (int f = 0; f < 6; ++f) {
    if ((common >> f & 1) != 0) return f;
  }
  return -1;
}

inline std::size_t crossing_pairs(const TriMesh& mesh) {
  const std::vector<Triangle> triangles = test::triangles_of(mesh);
  const TriangleTree tree(mesh.points, triangles);
  return find_crossings(mesh.points, triangles, tree).pairs.size();
}

// Checks that the mesh is closed, manifold and oriented. Caps lie on the box and face out of it;
// the surface lies nowhere flat on it. Caps over the bound on r/l are counted.
inline void check_closed(const ClosedMesh& solid, const Box3& box) {
  CHECK(solid.report.cap.failure == "");
  CHECK(check_mesh(solid.mesh) == "");
  CHECK(mesh_topology(solid.mesh).boundary_edges == 0);
  CHECK(enclosed_volume(solid.mesh) > 0);
  CHECK(crossing_pairs(solid.mesh) == solid.crossings);
  int unparted = 0, turned = 0;
  std::size_t over = 0;
  for (FaceId f = 0; f < solid.mesh.faces.size(); ++f) {
    const Face& face = solid.mesh.faces[f];
    const int on = face_of(solid.mesh, face, box);
    unparted += (on >= 0) != (f >= solid.report.cap.surface_triangles);
    if (on < 0) continue;
    const int u = (on / 2 + 1) % 3, v = (on / 2 + 2) % 3;
    const auto drop = [&](int i) {
      const Vec3& p = solid.mesh.points[face.v[i]];
      return Vec2{p[u], p[v]};
    };
    const auto corner = [&](int i) { return solid.mesh.points[face.v[i]]; };
    over +=
        radius_ratio2(corner(0), corner(1), corner(2)) > (1 + 1e-6) * solid.lambda * solid.lambda;
    turned += orient2d(drop(0), drop(1), drop(2)) != (on % 2 == 0 ? -1 : 1);
  }
  CHECK(unparted == 0);
  CHECK(turned == 0);
  CHECK(over <= solid.report[Counter::cap_refused]);
}

// Returns how many samples on the box are inside and not on a cap, or the reverse. Samples within
// about half a voxel of the caps' boundary do not count.
inline int misplaced_samples(const ClosedMesh& solid, const Volume& volume, double kappa) {
  const Box3 box = volume.box();
  int misplaced = 0;
  for (int f = 0; f < 6; ++f) {
    const int across = f / 2, u = (across + 1) % 3, v = (across + 2) % 3;
    std::vector<std::array<Vec2, 3>> caps;
    for (std::size_t n = solid.report.cap.surface_triangles; n < solid.mesh.faces.size(); ++n) {
      const Face& face = solid.mesh.faces[FaceId(n)];
      if (face_of(solid.mesh, face, box) != f) continue;
      std::array<Vec2, 3> t;
      for (int i = 0; i < 3; ++i) {
        t[i] = {solid.mesh.points[face.v[i]][u], solid.mesh.points[face.v[i]][v]};
      }
      if (f % 2 == 0) std::swap(t[1], t[2]);
      caps.push_back(t);
    }
    Index3 at;
    at[across] = f % 2 == 0 ? 0 : volume.dims()[across] - 1;
    for (at[u] = 0; at[u] < volume.dims()[u]; ++at[u]) {
      for (at[v] = 0; at[v] < volume.dims()[v]; ++at[v]) {
        const Vec2 p{at[u] * volume.spacing()[u], at[v] * volume.spacing()[v]};
        const bool covered = std::any_of(caps.begin(), caps.end(), [&](const auto& t) {
          return orient2d(t[0], t[1], p) >= 0 && orient2d(t[1], t[2], p) >= 0 &&
                 orient2d(t[2], t[0], p) >= 0;
        });
        const double value = volume.sample(at.i, at.j, at.k) - kappa;
        if (covered == (value >= 0)) continue;
        Vec3 corner;
        for (int axis = 0; axis < 3; ++axis) corner[axis] = at[axis] * volume.spacing()[axis];
        misplaced += std::abs(value) > 0.5 * length(volume.gradient(corner));
      }
    }
  }
  return misplaced;
}

// Returns the volume of {f >= kappa}, by a fine regular sampling.
inline double sampled_volume(const Volume& volume, double kappa, int per_voxel) {
  const Vec3 s = volume.spacing();
  const Index3 n = volume.voxels();
  std::size_t inside = 0, all = 0;
  for_each_index({n.i * per_voxel, n.j * per_voxel, n.k * per_voxel}, [&](int i, int j, int k) {
    const Vec3 p{(i + 0.5) / per_voxel * s.x, (j + 0.5) / per_voxel * s.y,
                 (k + 0.5) / per_voxel * s.z};
    inside += volume.value(p) >= kappa;
    ++all;
  });
  const Vec3 size = volume.box().size();
  return size.x * size.y * size.z * static_cast<double>(inside) / static_cast<double>(all);
}

struct Scattered {
  Volume volume;
  double kappa;
};

// Pure noise of a few values. In every other volume some samples equal the isovalue.
inline Volume noise(std::uint64_t seed, Vec3 spacing) {
  Random random(seed);
  const Index3 dims{2 + static_cast<int>(random.below(5)), 2 + static_cast<int>(random.below(5)),
                    2 + static_cast<int>(random.below(5))};
  std::vector<std::uint8_t> samples(static_cast<std::size_t>(dims.i * dims.j * dims.k));
  for (auto& s : samples) s = static_cast<std::uint8_t>(random.below(seed % 4 == 0 ? 3 : 200));
  return Volume::from_samples(dims, spacing, samples);
}

// Samples and isovalues of either sign, of sizes spread over as many orders of magnitude as given.
inline Scattered scattered(std::uint64_t seed, double orders) {
  Random random(seed);
  const Index3 dims{2 + static_cast<int>(random.below(4)), 2 + static_cast<int>(random.below(4)),
                    2 + static_cast<int>(random.below(4))};
  const auto value = [&] {
    const double size = std::pow(10.0, random.uniform(-orders, orders));
    return random.below(2) == 0 ? size : -size;
  };
  std::vector<double> samples(static_cast<std::size_t>(dims.i * dims.j * dims.k));
  for (double& s : samples) s = value();
  const double kappa = value();
  return {Volume::from_samples(dims, {1, 1, 1}, samples), kappa};
}

}  // namespace deliso
