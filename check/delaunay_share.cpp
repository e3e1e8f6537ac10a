// SPDX-License-Identifier: MIT
#include "check/delaunay_share.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/box3.h"
#include "base/parallel.h"
#include "check/vertex_grids.h"
#include "delaunay/voronoi.h"
#include "exact/predicates.h"
#include "isosurface/patch_at.h"
#include "mesh/incidence.h"

namespace deliso {
namespace {

constexpr std::size_t kTrianglesPerTask = 1u << 11;

// More than the rounding of a vertex's distance from a center, relative.
constexpr double kBallRounding = 1e-6;

enum class Kind : std::uint8_t { no_facet, facet, restricted };

// The balls through the corners of a triangle, by t: centered at center + t * normal.
class Balls {
 public:
  Balls(const CleanMesh& mesh, const Triangle& t, const VertexGrids& grids, std::size_t& looked_at)
      : triangle_(t),
        a_(mesh.points[t[0]]),
        b_(mesh.points[t[1]]),
        c_(mesh.points[t[2]]),
        grids_(grids),
        looked_at_(looked_at) {}

  const FacetLine& line() const { return line_; }
  // Returns the balls that hold none of the vertices found in others.
  const Range& open() const { return open_; }
  Vec3 at(double t) const { return line_.center + t * line_.normal; }

  // True if the ball holds no vertex. Else vertices in it close the balls that they are in, until
  // none is open.
  bool is_empty(double t) {
    const Vec3 middle = at(t);
    const double radius2 = line_.radius * line_.radius + t * t;
    const double beyond2 = (1 + kBallRounding) * radius2;
    bool empty = true;
    const Box3 box = Box3{middle, middle}.grown(std::sqrt(beyond2));
    grids_.for_each_near(box, looked_at_, [&](const NumberedPoint& p) {
      if (distance2(p.at, middle) < beyond2 && !has_corner(triangle_, VertexId(p.number))) {
        empty &= !close(p.at, t);
      }
      return !open_.empty();
    });
    return empty;
  }

 private:
  // Closes the balls that p is in, if the one at t is among them.
  bool close(const Vec3& p, double t) {
    const int side = orient3d(a_, b_, c_, p);
    if (side == 0) {  // in the plane, p is in all balls or in none
      const Vec3 apex = a_ + line_.radius * line_.normal;
      if (insphere(a_, b_, c_, apex, p) * orient3d(a_, b_, c_, apex) <= 0) return false;
      open_ = {1, 0};
      return true;
    }
    const double end = equidistant_parameter(a_, b_, c_, p, line_);
    if (side > 0 ? end >= t : end <= t) return false;
    if (side > 0) {
      open_.hi = std::min(open_.hi, end);
    } else {
      open_.lo = std::max(open_.lo, end);
    }
    return true;
  }

  const Triangle& triangle_;
  const Vec3 &a_, &b_, &c_;
  const VertexGrids& grids_;
  std::size_t& looked_at_;
  FacetLine line_ = facet_line(a_, b_, c_);
  Range open_;
};

// Looks at one triangle after another, with its own counters.
class Look {
 public:
  Look(const CleanMesh& mesh, const VertexGrids& grids, const Isosurface& surface)
      : mesh_(mesh), grids_(grids), surface_(surface) {}

  // Returns what the triangle is, as far as it is not given up, and sets its h.
  Kind operator()(const Triangle& t, double& height) {
    Balls balls(mesh_, t, grids_, looked_at_);
    const FacetLine& line = balls.line();
    const double nearest =
        PatchAt(surface_, line.center)
            .parameter_along(line.normal, kBallLimitRadii * line.radius, counters_);
    height = std::fabs(nearest);
    if (!std::isfinite(line.radius) || gives_up()) return Kind::no_facet;
    // Where the nearest point of Sigma is too far for a ball, the vertices in the circumball leave
    // less of the line to be searched.
    const bool has_ball = std::isfinite(nearest);
    const bool empty = balls.is_empty(has_ball ? nearest : 0);
    if (empty && has_ball) return Kind::restricted;
    if (is_restricted(balls)) return Kind::restricted;
    return empty || is_facet(balls) ? Kind::facet : Kind::no_facet;
  }
  bool gives_up() const { return looked_at_ > kMaxVerticesPerTriangle * kTrianglesPerTask; }

 private:
  // True if an open ball with its center on Sigma holds no vertex.
  bool is_restricted(Balls& balls) {
    const FacetLine& line = balls.line();
    const Range range = clip(line.center, line.normal, balls.open(), surface_.volume().box());
    if (range.empty()) return false;
    surface_.intersect({balls.at(range.lo), balls.at(range.hi)}, hits_, counters_);
    for (Hit& hit : hits_) hit.t = range.lo + hit.t * (range.hi - range.lo);
    // Small balls first: what they hold closes the large ones.
    std::ranges::sort(hits_, {}, [](const Hit& hit) { return std::fabs(hit.t); });
    for (const auto& [t, point, leaves] : hits_) {
      if (gives_up()) break;
      if (balls.open().lo <= t && t <= balls.open().hi && balls.is_empty(t)) return true;
    }
    return false;
  }
  // True if any open ball holds no vertex.
  bool is_facet(Balls& balls) const {
    while (!balls.open().empty() && !gives_up()) {
      if (balls.is_empty(std::clamp(0.0, balls.open().lo, balls.open().hi))) return true;
    }
    return false;
  }

  const CleanMesh& mesh_;
  const VertexGrids& grids_;
  const Isosurface& surface_;
  std::vector<Hit> hits_;
  SearchCounters counters_;
  std::size_t looked_at_ = 0;
};

}  // namespace

DelaunayShare measure_delaunay_share(const CleanMesh& mesh, const VertexGrids& grids,
                                     const Isosurface& surface, std::vector<double>& heights,
                                     int threads) {
  const std::size_t triangles = mesh.triangles.size();
  std::vector<Kind> kinds(triangles);
  heights.resize(triangles);
  std::vector<std::uint8_t> given_up(runs_of(triangles, kTrianglesPerTask), 0);
  for_each_run(threads, triangles, kTrianglesPerTask,
               [&](std::size_t run, std::size_t begin, std::size_t end) {
                 Look look(mesh, grids, surface);
                 for (std::size_t n = begin; n < end; ++n) {
                   kinds[n] = look(mesh.triangles[n], heights[n]);
                 }
                 given_up[run] = look.gives_up();
               });
  DelaunayShare share;
  share.triangles = triangles;
  share.measured = std::ranges::count(given_up, 1) == 0;
  if (!share.measured) return share;
  for (std::size_t n = 0; n < triangles; ++n) {
    share.delaunay += kinds[n] != Kind::no_facet;
    share.restricted += kinds[n] == Kind::restricted;
    if (kinds[n] == Kind::restricted) continue;
    if (share.first_outside.size() < Faults::kShown) share.first_outside.push_back(mesh.id[n]);
    const bool has_ball = std::isfinite(heights[n]);
    share.occupied += has_ball;
    share.without_ball += !has_ball;
  }
  return share;
}

}  // namespace deliso
