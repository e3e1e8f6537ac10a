// SPDX-License-Identifier: MIT
#include "refine/refine.h"

#include <algorithm>
#include <cstdlib>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/check.h"
#include "refine/collapse.h"
#include "refine/flip.h"
#include "refine/insert.h"
#include "refine/move.h"
#include "refine/replace_disk.h"
#include "refine/retriangulate.h"
#include "refine/worst_first.h"
#include "surface/criteria.h"

namespace deliso {
namespace {

class Refiner {
 public:
  Refiner(SurfaceMesh& surface_mesh, const Isosurface& surface, const BoundaryCurves& curves,
          const Parameters& parameters, Report& report)
      : s_(surface_mesh),
        mesh_(surface_mesh.mesh),
        parameters_(parameters),
        report_(report),
        replacer_(surface_mesh, surface, parameters, report),
        inserter_(surface_mesh, replacer_, curves, parameters, report),
        flipper_(surface_mesh, replacer_, report),
        collapser_(surface_mesh, replacer_, surface, curves, parameters, report),
        retriangulator_(surface_mesh, replacer_, report),
        mover_(surface_mesh, replacer_, parameters, report) {}

  // RefineGeom, Figure 9.
  void refine_geom();
  void count_left();

 private:
  FacetShape shape(FaceId f) const;
  double judge(FaceId f);
  // New facets: judged, and looked at for flips and for leaving the boundary's curve.
  void take(std::span<const FaceId> created);
  bool refine(FaceId f);
  bool rearrange(FaceId f);
  std::array<std::optional<Vec3>, 2> other_points(FaceId f);
  void legalize();
  void follow_curves();
  bool is_full();
  void show_progress();

  SurfaceMesh& s_;
  const TriMesh& mesh_;
  const Parameters& parameters_;
  Report& report_;
  DiskReplacer replacer_;
  Inserter inserter_;
  Flipper flipper_;
  Collapser collapser_;
  Retriangulator retriangulator_;
  Mover mover_;

  WorstFirst queue_;
  std::vector<FaceId> refused_;
  std::vector<std::uint8_t> stuck_;  // per facet: every rung refused, and nothing around it has changed
  std::vector<FaceId> changed_;  // since legalize() last looked at them
  std::vector<FaceId> ends_;     // facets whose boundary edges are to be looked at
  std::size_t steps_ = 0;
  double share_ = 0;
};

FacetShape Refiner::shape(FaceId f) const {
  const Triangle& v = mesh_.faces[f].v;
  const Dual& dual = s_.duals[f];
  FacetShape s = measure(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]], dual.center);
  if (!dual.on_surface) s.h = s.r;  // the most there is
  return s;
}

double Refiner::judge(FaceId f) {
  const double v = violation(shape(f), s_.pole(mesh_.faces[f].v), parameters_.refinement);
  queue_.set(f, v);
  return v;
}

void Refiner::take(std::span<const FaceId> created) {
  stuck_.resize(mesh_.faces.size(), 0);
  for (const FaceId f : created) {
    judge(f);
    changed_.push_back(f);
    stuck_[f] = 0;
    for (const FaceId g : mesh_.faces[f].n) {
      if (g != kNoId) stuck_[g] = 0;
    }
    const Face& face = mesh_.faces[f];
    if (std::find(face.n.begin(), face.n.end(), kNoId) != face.n.end()) ends_.push_back(f);
  }
}

void Refiner::refine_geom() {
  stuck_.assign(mesh_.faces.size(), 0);
  changed_.resize(mesh_.faces.size());
  std::iota(changed_.rbegin(), changed_.rend(), 0);
  legalize();
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) judge(f);
  ends_.resize(mesh_.faces.size());
  std::iota(ends_.rbegin(), ends_.rend(), 0);
  follow_curves();
  int rounds = 0;
  for (bool dear = false;;) {
    bool any = false;
    for (FaceId f = queue_.pop(); f != kNoId; f = queue_.pop()) {
      if (is_dead(mesh_.faces[f])) continue;
      if (refine(f) || (dear && rearrange(f))) {
        any = true;
      } else {
        stuck_[f] = dear;
        refused_.push_back(f);
      }
      follow_curves();
      show_progress();
      if (is_full()) return;
    }
    // New facets are Delaunay with each other, but need not be with those beyond their rim.
    legalize();
    // What was refused is tried again once its surroundings have changed.
    for (const FaceId f : std::exchange(refused_, {})) {
      if (!is_dead(mesh_.faces[f]) && !stuck_[f]) judge(f);
    }
    if (!any && dear) {
      if (++rounds > (getenv("RD") ? atoi(getenv("RD")) : 2)) break;
      for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
        if (is_dead(mesh_.faces[f]) || stuck_[f]) continue;
        if (!s_.duals[f].on_surface || replacer_.holds_vertex(mesh_.faces[f].v, s_.duals[f])) {
          if ((shape(f).r > 0.5 * parameters_.r_min && refine(f)) || rearrange(f)) any = true; else stuck_[f] = 1;
        }
      }
      if (!any) break;
    }
    dear = !any;
  }
}

bool Refiner::is_full() {
  if (mesh_.points.size() < parameters_.max_vertices) return false;
  if (!parameters_.keep_partial) {
    throw InputError("more than --max-vertices " + std::to_string(parameters_.max_vertices) +
                     " vertices needed");
  }
  report_.stopped_at_max_vertices = true;
  return true;
}

// What is done, of that and what is queued; the queue grows at first, so the share is a guess.
void Refiner::show_progress() {
  constexpr std::size_t kEvery = 4096;
  if (!parameters_.progress || ++steps_ % kEvery != 0) return;
  const double done = static_cast<double>(steps_), left = static_cast<double>(queue_.size());
  share_ = std::max(share_, done / (done + left));
  parameters_.progress("refine", share_);
}

// The cheap rungs.
bool Refiner::refine(FaceId f) {
  if (is_dead(mesh_.faces[f])) return false;
  if (collapser_.collapse(f)) {
    take(collapser_.created());
    return true;
  }
  if (s_.duals[f].on_surface && !inserter_.insert(Rung::surface_point, f, s_.duals[f].center)) {
    take(inserter_.created());
    return true;
  }
  for (const std::optional<Vec3>& p : other_points(f)) {
    if (!p || inserter_.insert(Rung::foot, f, *p)) continue;
    take(inserter_.created());
    return true;
  }
  // Next to the boundary a shorter boundary edge makes room, unless it is short already.
  for (int i = 0; i < 3; ++i) {
    if (mesh_.faces[f].n[i] != kNoId) continue;
    const Triangle& v = mesh_.faces[f].v;
    const Vec3 &a = mesh_.points[v[(i + 1) % 3]], &b = mesh_.points[v[(i + 2) % 3]];
    if (distance(a, b) < shape(f).r || !inserter_.split_boundary({f, i})) continue;
    take(inserter_.created());
    return true;
  }
  for (int i = 0; i < 3; ++i) {
    if (!flipper_.flip_if_not_delaunay(f, i)) continue;
    take(flipper_.created());
    return true;
  }
  return false;
}

// The dear ones.
bool Refiner::rearrange(FaceId f) {
  if (retriangulator_.retriangulate(f)) {
    take(retriangulator_.created());
    return true;
  }
  if (collapser_.take_out_corner(f)) {
    take(collapser_.created());
    return true;
  }
  if (mover_.move_corner(f)) {
    take(mover_.created());
    return true;
  }
  return false;
}

// Where the steepest lines through its circumcenter and through the middle of its longest edge meet
// Sigma.
std::array<std::optional<Vec3>, 2> Refiner::other_points(FaceId f) {
  const Triangle& v = mesh_.faces[f].v;
  const std::array<Vec3, 3> p = {mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]};
  const Vec3 normal = area_normal(p[0], p[1], p[2]), center = circumcenter(p[0], p[1], p[2]);
  std::size_t i = 0;  // the corner opposite the longest edge
  const auto length2_opposite = [&](std::size_t k) {
    return distance2(p[(k + 1) % 3], p[(k + 2) % 3]);
  };
  for (const std::size_t k : {1u, 2u}) {
    if (length2_opposite(k) > length2_opposite(i)) i = k;
  }
  const Vec3 middle = 0.5 * (p[(i + 1) % 3] + p[(i + 2) % 3]);
  SearchCounters& counters = report_.searches_refine;
  SurfacePointFinder& finder = replacer_.finder();
  return {finder.foot(center, normal, distance(center, p[0]), counters),
          finder.foot(middle, normal, 0.5 * std::sqrt(length2_opposite(i)), counters)};
}

// Flips edges of what changed, and then around that, until all are Delaunay or cannot be.
void Refiner::legalize() {
  while (!changed_.empty()) {
    const FaceId f = changed_.back();
    changed_.pop_back();
    for (int i = 0; i < 3 && !is_dead(mesh_.faces[f]); ++i) {
      if (!flipper_.flip_if_not_delaunay(f, i)) continue;
      take(flipper_.created());
      break;
    }
  }
}

// Splits the boundary edges of the facets in ends_ that leave their curve, as facets leave Sigma.
void Refiner::follow_curves() {
  while (!ends_.empty()) {
    const FaceId f = ends_.back();
    ends_.pop_back();
    for (int i = 0; i < 3 && !is_dead(mesh_.faces[f]); ++i) {
      if (mesh_.faces[f].n[i] != kNoId || !inserter_.leaves_curve({f, i})) continue;
      if (!inserter_.split_boundary({f, i})) continue;
      take(inserter_.created());
      break;
    }
  }
}

void Refiner::count_left() {
  if (getenv("DBG")) {
    long n=0, off=0, offsmall=0, rl=0, h=0, occ=0, occsmall=0; long hist[8]={};
    for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
      if (is_dead(mesh_.faces[f])) continue;
      const FacetShape s = shape(f); const bool small = s.r <= parameters_.r_min; const Dual& d = s_.duals[f];
      ++n; off += !d.on_surface && !small; offsmall += !d.on_surface && small;
      const bool o = d.on_surface && replacer_.holds_vertex(mesh_.faces[f].v, d); occ += o && !small; occsmall += o && small;
      if (s.r > 2 * s.l && s.r > parameters_.refinement.shape_floor) { ++rl; int b = std::clamp(int(std::log2(s.r / parameters_.r_min)) + 4, 0, 7); ++hist[b]; }
      h += s.h > parameters_.refinement.max_distance && !small;
    }
    fprintf(stderr, "facets %ld: no surface point: %ld above r_min, %ld below; occupied ball %ld above, %ld below; r/l %ld (by log2 r/rmin from -4:", n, off, offsmall, occ, occsmall, rl);
    for (long x : hist) fprintf(stderr, " %ld", x);
    fprintf(stderr, "); h %ld\n", h);
  }
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    if (is_dead(mesh_.faces[f])) continue;
    const FacetShape s = shape(f);
    if (s.r > parameters_.r_min) report_.largest_h = std::max(report_.largest_h, s.h);
    report_[Counter::unrefined_facets] +=
        is_bad(s, s_.pole(mesh_.faces[f].v), parameters_.refinement);
  }
}

}  // namespace

void refine(SurfaceMesh& mesh, const Isosurface& surface, const BoundaryCurves& curves,
            std::span<const Vec3> witnesses, const Parameters& parameters, Report& report) {
  (void)witnesses;
  const StepTimer timer(report.seconds_refine);
  Refiner refiner(mesh, surface, curves, parameters, report);
  if (getenv("DBG")) refiner.count_left();
  refiner.refine_geom();
  refiner.count_left();
  remove_dead(mesh);
}

}  // namespace deliso
