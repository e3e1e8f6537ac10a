// SPDX-License-Identifier: MIT
#include "check/boundary_orientation.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "base/box3.h"

namespace deliso {
namespace {

// Per face of the box, twice the signed area that the boundary edges of a component enclose there.
struct FaceAreas {
  std::array<double, 6> sums{};
  std::optional<Vec3> origin;  // a point of the boundary, for accuracy

  void add(int face, const Vec3& from, const Vec3& to) {
    if (!origin) origin = from;
    sums[face] += cross(from - *origin, to - *origin)[face >> 1];
  }
};

// Returns the areas for T, 0 for components whose boundary passes an edge of the box.
std::vector<FaceAreas> areas_of(const ContourMesh& contour) {
  std::vector<FaceAreas> areas(contour.summary.components.size());
  std::vector<std::uint8_t> passes_edge(areas.size(), 0);
  for (std::size_t l = 0; l < contour.boundary.size(); ++l) {
    const BoundaryLoop& loop = contour.boundary.loops[l];
    const std::uint32_t component = contour.boundary.component[l];
    for (std::size_t n = 0; n < loop.size(); ++n) {
      const LoopPoint &from = loop[n], &to = loop[n + 1 < loop.size() ? n + 1 : 0];
      areas[component].add(from.face, from.point, to.point);
      passes_edge[component] |= to.face != from.face;
    }
  }
  for (std::size_t e = 0; e < areas.size(); ++e) {
    if (passes_edge[e]) areas[e] = {};
  }
  return areas;
}

// Returns the axis of the only edge of the box that p lies on, -1 if there is none. Next to a
// sample the derivative along the edge is not known, so -1 there too.
int edge_axis(const Vec3& p, const Volume& volume, double tolerance) {
  const unsigned faces = box_faces_at(p, volume.box());
  if (std::popcount(faces) != 2) return -1;
  int axis = 0;
  while ((faces >> (2 * axis) & 3) != 0) ++axis;
  const double u = volume.in_samples(p, axis);
  const double side = volume.sides(volume.voxel_at(p))[axis];
  return std::fabs(u - std::round(u)) * side > tolerance ? axis : -1;
}

// Returns 1 if the curve passes the edge of the box between the samples around p, and the inside
// follows along the axis; -1 if it goes before, 0 if the curve does not pass there. A vertex may
// lie on an edge along which all samples equal kappa.
int growth_along(int axis, const Vec3& p, const Isosurface& surface) {
  const Volume& volume = surface.volume();
  Index3 low = volume.voxel_at(p);
  for (int n = 0; n < 3; ++n) low[n] += n != axis && volume.in_samples(p, n) - low[n] > 0.5;
  Index3 high = low;
  ++high[axis];
  const auto is_inside = [&](const Index3& at) {
    return volume.sample(at.i, at.j, at.k) >= surface.kappa();
  };
  return is_inside(high) - is_inside(low);
}

// Returns 1 if the inside of g lies to the right of the boundary edge at its end p, seen from
// outside of the face; -1 if to the left, 0 if the curve passes no edge of the box at p.
int side_at(const Vec3& p, const Vec3& direction, int face, const Isosurface& surface,
            double tolerance) {
  const int axis = edge_axis(p, surface.volume(), tolerance);
  if (axis < 0) return 0;
  Vec3 outwards;
  outwards[face >> 1] = (face & 1) != 0 ? 1 : -1;
  const double right = cross(direction, outwards)[axis];
  return (right > 0 ? 1 : -1) * growth_along(axis, p, surface);
}

}  // namespace

std::vector<double> boundary_orientations(const CleanMesh& mesh,
                                          const std::vector<std::uint32_t>& stands_for,
                                          const ContourMesh& contour, const Isosurface& surface,
                                          double tolerance) {
  const Box3 box = surface.volume().box();
  std::vector<double> orientations(stands_for.size(), 0);
  std::vector<FaceAreas> areas(stands_for.size());
  for (const CleanMesh::End& end : mesh.ends) {
    const std::uint32_t m = mesh.component[end.from];
    const Vec3 &from = mesh.points[end.from], &to = mesh.points[end.to];
    const unsigned faces = box_faces_at(from, box) & box_faces_at(to, box);
    if (!std::has_single_bit(faces)) continue;
    const int face = std::countr_zero(faces);
    areas[m].add(face, from, to);
    for (const Vec3& p : {from, to}) {
      orientations[m] += side_at(p, to - from, face, surface, tolerance);
    }
  }
  const std::vector<FaceAreas> exact = areas_of(contour);
  for (std::size_t m = 0; m < stands_for.size(); ++m) {
    if (orientations[m] != 0 || stands_for[m] == kNoId) continue;
    for (std::size_t face = 0; face < 6; ++face) {
      orientations[m] += areas[m].sums[face] * exact[stands_for[m]].sums[face];
    }
  }
  return orientations;
}

}  // namespace deliso
