// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "mesh/tri_mesh.h"
#include "refine/operations.h"

namespace deliso {
namespace {

// Least relative decrease of the sum of radii by a flip: more than rounding.
constexpr double kMinRadiusFall = 1e-9;

}  // namespace

bool is_edge_delaunay(const Refinement& r, FaceId f, int i) {
  const Face& face = r.mesh.faces[f];
  const FaceId g = face.n[i];
  if (g == kNoId) return true;
  const Face& across = r.mesh.faces[g];
  return !r.s.duals[f].holds(r.point(across.v[neighbor_index(across, f)])) &&
         !r.s.duals[g].holds(r.point(face.v[i]));
}

std::optional<Refusal> flip_if_not_delaunay(Refinement& r, FaceId f, int i) {
  if (r.mesh.faces[f].n[i] == kNoId) return Refusal::boundary;
  if (is_edge_delaunay(r, f, i)) return Refusal::no_gain;
  const Quad q = quad_at(r.mesh, f, i);
  const double radii = std::sqrt(r.s.duals[q.f].radius2) + std::sqrt(r.s.duals[q.g].radius2);
  const Cavity* cavity = r.open(std::array{q.f, q.g});
  if (!cavity) return r.done(Operation::flip, Refusal::not_a_disk);
  const auto is_delaunay = [&](const Replacement& c) {
    if (!c.has_duals()) return true;
    const Dual &x = c.duals[0], &y = c.duals[1];
    return x.on_surface && y.on_surface && !x.holds(r.point(q.c)) && !y.holds(r.point(q.b)) &&
           std::sqrt(x.radius2) + std::sqrt(y.radius2) < (1 - kMinRadiusFall) * radii;
  };
  return r.done(Operation::flip, r.make(cavity->fill(q.flipped(), Gates{}), is_delaunay));
}

}  // namespace deliso
