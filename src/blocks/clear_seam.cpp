// SPDX-License-Identifier: MIT
#include "blocks/clear_seam.h"

#include <algorithm>
#include <array>
#include <vector>

#include "embedding/triangle_pair.h"
#include "refine/operations.h"

namespace deliso {
namespace {

// A vertex that cannot be merged is moved off the seam. The distance starts at the perturbation,
// and shrinks by this factor, this many times.
constexpr double kOffsetFactor = 0x1p-4;
constexpr int kMaxOffsets = 5;

// The attempts for a vertex. The next one is made only if some are left.
enum class Effort : std::uint8_t { merge, merge_at_any_cost, lift };

// Removes f if it is the only facet at v: the edge between v's neighbors becomes the boundary.
bool cut_ear(Refinement& r, FaceId f, VertexId v) {
  const Face& ear = r.mesh.faces[f];
  const int at_v = corner_index(ear, v);
  const FaceId g = ear.n[at_v];
  if (ear.n[(at_v + 1) % 3] != kNoId || ear.n[(at_v + 2) % 3] != kNoId || g == kNoId) return false;
  const Triangle left = r.mesh.faces[g].v;
  Proposal* c = r.propose(std::array{f, g}, kAnyFold);
  if (!c) return false;
  c->facets({&left, 1});
  c->asks_surface = false;
  return !r.replace();
}

// Adds a facet between v and its neighbors, and moves v slightly off the seam.
bool lift(Refinement& r, FaceId f, VertexId v) {
  Proposal* c = r.propose(r.star(f, v), kAnyFold);
  if (!c) return false;
  c->asks_surface = false;
  const Vec3 from = r.point(v);
  const Vec3 inward = inwards(box_faces_at(from, r.surface.volume().box()));
  double off = kPerturbationVoxels * r.parameters.voxel;
  for (int step = 0; step < kMaxOffsets; ++step, off *= kOffsetFactor) {
    c->move(v, from + off * inward);
    if (step == 0) c->in.facets.push_back({r.s.chain.previous(v), r.s.chain.next(v), v});
    if (!r.replace()) return true;
  }
  return false;
}

// Merges v into a neighbor on the boundary. `at_any_cost`: whatever the shapes.
bool merge(Refinement& r, FaceId f, VertexId v, bool at_any_cost) {
  for (const VertexId to : {r.s.chain.previous(v), r.s.chain.next(v)}) {
    auto refusal = propose_merge(r, f, v, to, at_any_cost ? kAnyFold : kSharpestFold);
    r.proposal.asks_surface = !at_any_cost;
    if (!refusal) refusal = r.replace();
    if (!r.done(Operation::collapse, refusal)) return true;
  }
  return false;
}

// Removes v from the chain. Returns true if it was removed.
bool remove_boundary_vertex(Refinement& r, VertexId v, Effort effort) {
  const auto at_v =
      std::ranges::find_if(r.mesh.faces, [&](const Face& face) { return has_corner(face.v, v); });
  if (at_v == r.mesh.faces.end()) return false;
  const auto f = FaceId(at_v - r.mesh.faces.begin());
  if (cut_ear(r, f, v)) return true;
  return effort == Effort::lift ? lift(r, f, v)
                                : merge(r, f, v, effort == Effort::merge_at_any_cost);
}

}  // namespace

std::size_t clear_seam(SurfaceMesh& s, const Isosurface& surface, const BoundaryCurves& curves,
                       const Parameters& parameters, Report& report) {
  std::vector<VertexId> left;
  for (VertexId v = 0; v < s.mesh.points.size(); ++v) {
    if (!s.chain.is_boundary(v)) continue;
    const CurvePlace place = s.chain.place(v);
    if (curves.is_on_fixed(place) && !curves.is_kept(place)) left.push_back(v);
  }
  if (left.empty()) return 0;
  Refinement r(s, surface, curves, parameters, report);
  for (const Effort effort : {Effort::merge, Effort::merge_at_any_cost, Effort::lift}) {
    // A removed vertex may make way for another.
    for (std::size_t before = left.size() + 1; left.size() < before && !left.empty();) {
      before = left.size();
      std::erase_if(left, [&](VertexId v) { return remove_boundary_vertex(r, v, effort); });
    }
  }
  remove_dead(s);
  return left.size();
}

}  // namespace deliso
