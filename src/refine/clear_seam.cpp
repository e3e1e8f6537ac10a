// SPDX-License-Identifier: MIT
#include "refine/clear_seam.h"

#include <algorithm>

#include "refine/collapse.h"
#include "refine/judge.h"
#include "refine/replace_disk.h"

namespace deliso {
namespace {

class SeamClearer {
 public:
  SeamClearer(SurfaceMesh& s, const Isosurface& surface, const BoundaryCurves& curves,
              const Parameters& parameters, Report& report)
      : s_(s),
        replacer_(s, surface, parameters, report),
        judge_(s, replacer_, parameters),
        collapser_(s, replacer_, judge_, surface, curves, parameters, report) {}

  // Whether v went.
  bool take_out(VertexId v) {
    for (FaceId f = 0; f < s_.mesh.faces.size(); ++f) {
      if (!is_dead(s_.mesh.faces[f]) && has_corner(s_.mesh.faces[f].v, v)) {
        return collapser_.take_out(f, v);
      }
    }
    return false;
  }

 private:
  SurfaceMesh& s_;
  DiskReplacer replacer_;
  Judge judge_;
  Collapser collapser_;
};

}  // namespace

void clear_seam(SurfaceMesh& s, const Isosurface& surface, const BoundaryCurves& curves,
                const Parameters& parameters, Report& report) {
  std::vector<VertexId> left;
  for (VertexId v = 0; v < s.mesh.points.size(); ++v) {
    if (!s.chain.is_boundary(v)) continue;
    const CurvePlace place = s.chain.place(v);
    if (curves.is_on_seam(place) && !curves.is_kept(place)) left.push_back(v);
  }
  if (left.empty()) return;
  SeamClearer clearer(s, surface, curves, parameters, report);
  // One that goes may make way for another.
  for (std::size_t before = left.size() + 1; left.size() < before && !left.empty();) {
    before = left.size();
    std::erase_if(left, [&](VertexId v) { return clearer.take_out(v); });
  }
  remove_dead(s);
}

}  // namespace deliso
