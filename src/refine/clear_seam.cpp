// SPDX-License-Identifier: MIT
#include "refine/clear_seam.h"

#include <algorithm>
#include <vector>

#include "refine/collapse.h"
#include "refine/judge.h"
#include "refine/replace_disk.h"

namespace deliso {
namespace {

// How far off the seam a vertex is moved that cannot be merged: from a hair on nearer by this
// factor, so many times.
constexpr double kNearer = 0x1p-4;
constexpr int kSteps = 5;

// What is tried, the next only where the one before has left some.
enum class Effort : std::uint8_t { merge, merge_at_any_cost, lift };

class SeamClearer {
 public:
  SeamClearer(SurfaceMesh& s, const Isosurface& surface, const BoundaryCurves& curves,
              const Parameters& parameters, Report& report)
      : s_(s),
        volume_(surface.volume()),
        hair_(kHair * parameters.voxel),
        replacer_(s, surface, parameters, report),
        judge_(s, replacer_, parameters),
        collapser_(s, replacer_, judge_, surface, curves, parameters, s.mesh.points.size()) {}

  // Whether v went.
  bool take_out(VertexId v, Effort effort) {
    const auto at_v = std::ranges::find_if(s_.mesh.faces,
                                           [&](const Face& face) { return has_corner(face.v, v); });
    if (at_v == s_.mesh.faces.end()) return false;
    const auto f = static_cast<FaceId>(at_v - s_.mesh.faces.begin());
    if (cut_ear(f, v)) return true;
    if (effort == Effort::lift) return lift(f, v);
    return collapser_.take_out(f, v, effort == Effort::merge_at_any_cost);
  }

 private:
  // Where f is all there is at v, the edge between v's neighbours becomes the boundary.
  bool cut_ear(FaceId f, VertexId v) {
    const Face& ear = s_.mesh.faces[f];
    const int at_v = corner_index(ear, v);
    const FaceId g = ear.n[at_v];
    if (ear.n[(at_v + 1) % 3] != kNoId || ear.n[(at_v + 2) % 3] != kNoId || g == kNoId) {
      return false;
    }
    Change change;
    change.out = {f, g};
    change.in.facets = {s_.mesh.faces[g].v};
    change.leaves_box = true;
    if (!replacer_.mark_old(change) || replacer_.replace(change, [] { return true; })) return false;
    s_.chain.remove(v);
    return true;
  }
  // A triangle more, between v and its neighbours, and v a hair off the seam.
  bool lift(FaceId f, VertexId v) {
    Change change;
    facets_around(s_.mesh, f, v, change.out);
    if (!replacer_.mark_old(change)) return false;
    change.in.facets = change.was.facets;
    change.in.facets.push_back({s_.chain.previous(v), s_.chain.next(v), v});
    change.what = Change::Vertex::moves;
    change.vertex = v;
    change.leaves_box = true;
    const Vec3 from = s_.mesh.points[v];
    Vec3 inwards;
    const Box3 box = volume_.box();
    for (int axis = 0; axis < 3; ++axis) {
      if (from[axis] == box.lo[axis]) inwards[axis] = 1;
      if (from[axis] == box.hi[axis]) inwards[axis] = -1;
    }
    double off = hair_;
    for (int step = 0; step < kSteps; ++step, off *= kNearer) {
      change.place = from + off * inwards;
      if (replacer_.replace(change, [] { return true; })) continue;
      s_.chain.remove(v);
      return true;
    }
    return false;
  }

  SurfaceMesh& s_;
  const Volume& volume_;
  double hair_;
  DiskReplacer replacer_;
  Judge judge_;
  Collapser collapser_;
};

}  // namespace

std::size_t clear_seam(SurfaceMesh& s, const Isosurface& surface, const BoundaryCurves& curves,
                       const Parameters& parameters, Report& report) {
  std::vector<VertexId> left;
  for (VertexId v = 0; v < s.mesh.points.size(); ++v) {
    if (!s.chain.is_boundary(v)) continue;
    const CurvePlace place = s.chain.place(v);
    if (curves.is_on_seam(place) && !curves.is_kept(place)) left.push_back(v);
  }
  if (left.empty()) return 0;
  SeamClearer clearer(s, surface, curves, parameters, report);
  for (const Effort effort : {Effort::merge, Effort::merge_at_any_cost, Effort::lift}) {
    // One that goes may make way for another.
    for (std::size_t before = left.size() + 1; left.size() < before && !left.empty();) {
      before = left.size();
      std::erase_if(left, [&](VertexId v) { return clearer.take_out(v, effort); });
    }
  }
  remove_dead(s);
  return left.size();
}

}  // namespace deliso
