// SPDX-License-Identifier: MIT
#include <cmath>

#include "mesh/tri_mesh.h"
#include "refine/operations.h"

namespace deliso {
namespace {

// Least relative decrease of the sum of radii by a flip: more than rounding.
constexpr double kMinRadiusFall = 1e-9;

}  // namespace

std::optional<Refusal> flip_if_not_delaunay(Refinement& r, FaceId f, int i) {
  if (r.mesh.faces[f].n[i] == kNoId) return Refusal::boundary;
  const Quad q = quad_at(r.mesh, f, i);
  const Dual &at_f = r.s.duals[q.f], &at_g = r.s.duals[q.g];
  if (!at_f.holds(r.point(q.d)) && !at_g.holds(r.point(q.a))) return Refusal::no_gain;
  const double radii = std::sqrt(at_f.radius2) + std::sqrt(at_g.radius2);
  Change& c = r.begin_change(kSharpestFold);
  c.cavity = {q.f, q.g};
  c.in.facets = {{q.a, q.b, q.d}, {q.d, q.c, q.a}};
  const auto is_delaunay = [&] {
    if (!c.has_duals()) return true;
    const Dual &x = c.duals[0], &y = c.duals[1];
    return x.on_surface && y.on_surface && !x.holds(r.point(q.c)) && !y.holds(r.point(q.b)) &&
           std::sqrt(x.radius2) + std::sqrt(y.radius2) < (1 - kMinRadiusFall) * radii;
  };
  auto refusal = r.open_cavity(c);
  if (!refusal) refusal = r.replace(c, is_delaunay);
  return r.done(Operation::flip, refusal);
}

}  // namespace deliso
