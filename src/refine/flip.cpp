// SPDX-License-Identifier: MIT
#include "refine/flip.h"

#include <cmath>

#include "mesh/flip.h"

namespace deliso {
namespace {

// By so much of it must a flip lower the sum of radii: more than rounding.
constexpr double kLower = 1e-9;

}  // namespace

bool Flipper::flip_if_not_delaunay(FaceId f, int i) {
  const TriMesh& mesh = s_.mesh;
  if (mesh.faces[f].n[i] == kNoId) return false;
  const Quad q = quad_at(mesh, f, i);
  const Dual &at_f = s_.duals[q.f], &at_g = s_.duals[q.g];
  if (!at_f.holds(mesh.points[q.d]) && !at_g.holds(mesh.points[q.a])) return false;
  const double radii = std::sqrt(at_f.radius2) + std::sqrt(at_g.radius2);
  change_.out = {q.f, q.g};
  change_.in.facets = {{q.a, q.b, q.d}, {q.d, q.c, q.a}};
  change_.least_cosine = kSharpest;
  const auto accept = [&] {
    const Dual &x = change_.duals[0], &y = change_.duals[1];
    return x.on_surface && y.on_surface && !x.holds(mesh.points[q.c]) &&
           !y.holds(mesh.points[q.b]) &&
           std::sqrt(x.radius2) + std::sqrt(y.radius2) < (1 - kLower) * radii;
  };
  const auto refusal = replacer_.mark_old(change_) ? replacer_.replace(change_, accept)
                                                   : std::optional(Refusal::not_a_disk);
  return !replacer_.count(Rung::flip, change_, refusal);
}

}  // namespace deliso
