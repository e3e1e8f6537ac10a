// SPDX-License-Identifier: MIT
#include "io/mesh/region_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <tuple>

#include "base/box3.h"
#include "base/disjoint_sets.h"
#include "base/sorted_list.h"
#include "base/triangle.h"
#include "embedding/box_grid.h"

namespace deliso {
namespace {

// Facets of a component that are tried, the largest first, until the way to the next facet is not
// short beside the facet: a point in a narrow gap is as right, but harder to locate.
constexpr std::size_t kTriedFacets = 16;
constexpr double kShortWay = 0.1;  // of the root of twice the facet's area
// The ray begins near the centroid, not there: rays from there meet edges of regular meshes.
constexpr std::array<double, 3> kRayOrigin{0.31, 0.33, 0.36};
// A ray that misses a facet by this share of its heights meets it: none slips through an edge.
constexpr double kEdgeTolerance = 1e-9;

// The side of a facet that a label is on.
struct Side {
  std::int64_t label;
  std::uint32_t facet;
  std::uint8_t side;  // 0: in front, 1: behind
};

// An edge of a label's surface.
struct Edge {
  std::array<VertexId, 2> v;  // ascending
  std::uint32_t at;           // the number of its facet in the surface
  bool is_reversed;
};

// Returns the root of twice the facets' mean area. NaN: there are none.
double mean_size(const LabeledTriangles& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    area += length(area_normal(mesh.points[a], mesh.points[b], mesh.points[c]));
  }
  return std::sqrt(area / static_cast<double>(mesh.triangles.size()));
}

class Regions {
 public:
  Regions(const LabeledTriangles& mesh, double cell)
      : mesh_(mesh), box_(box_of(mesh.points)), grid_(box_, cell) {
    grid_.expect(mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      grid_.add(static_cast<BoxGrid::Id>(f), grid_.box_of(mesh.points, mesh.triangles[f]));
    }
  }

  RegionPoints find() {
    std::vector<Side> sides;
    for (std::uint32_t f = 0; f < mesh_.triangles.size(); ++f) {
      for (std::uint8_t side = 0; side < 2; ++side) {
        if (mesh_.has_label(f, side)) sides.push_back({mesh_.sides[f][side], f, side});
      }
    }
    std::ranges::stable_sort(sides, {}, &Side::label);
    for (std::size_t end, begin = 0; begin < sides.size(); begin = end) {
      for (end = begin; end < sides.size() && sides[end].label == sides[begin].label;) ++end;
      add_points_of({&sides[begin], end - begin});
    }
    return std::move(found_);
  }

 private:
  // Returns the corners counter-clockwise seen from outside of the label.
  Triangle outward(const Side& s) const {
    const Triangle& v = mesh_.triangles[s.facet];
    return s.side == 1 ? v : Triangle{v[0], v[2], v[1]};
  }
  Vec3 outward_normal(const Side& s) const {
    const Triangle v = outward(s);
    return area_normal(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]);
  }

  // Adds the points of one label. `surface` becomes sorted by components.
  void add_points_of(std::span<Side> surface) {
    std::vector<Edge> edges;
    edges.reserve(3 * surface.size());
    for (std::uint32_t n = 0; n < surface.size(); ++n) {
      const Triangle v = outward(surface[n]);
      for (std::size_t i = 0; i < 3; ++i) {
        const VertexId a = v[i], b = v[(i + 1) % 3];
        edges.push_back({{std::min(a, b), std::max(a, b)}, n, b < a});
      }
    }
    std::ranges::sort(edges, {}, [](const Edge& e) { return std::tuple(e.v, e.at); });
    DisjointSets joined(surface.size());
    std::vector<std::uint32_t> at_hole;  // facets at edges that bound the surface
    for (std::size_t end, begin = 0; begin < edges.size(); begin = end) {
      int balance = 0;
      for (end = begin; end < edges.size() && edges[end].v == edges[begin].v; ++end) {
        joined.unite(edges[begin].at, edges[end].at);
        balance += edges[end].is_reversed ? -1 : 1;
      }
      if (balance != 0) at_hole.push_back(edges[begin].at);
    }
    const std::vector<std::uint32_t> component = joined.take_numbers();
    std::vector<std::vector<Side>> components(*std::ranges::max_element(component) + 1);
    for (std::size_t n = 0; n < surface.size(); ++n) components[component[n]].push_back(surface[n]);
    for (const std::uint32_t n : at_hole) components[component[n]].clear();
    if (!at_hole.empty()) found_.open.push_back(surface[0].label);
    for (std::vector<Side>& facets : components) {
      if (!(enclosed_volume(facets) > 0)) continue;
      if (const auto p = point_inside(facets)) found_.points.push_back({*p, facets[0].label});
    }
  }

  // Returns six times the volume, negative for the boundary of a cavity.
  double enclosed_volume(std::span<const Side> facets) const {
    double sum = 0;
    for (const Side& s : facets) {
      const Vec3& origin = mesh_.points[mesh_.triangles[facets[0].facet][0]];
      const auto [a, b, c] = outward(s);
      sum += sixfold_volume(origin, mesh_.points[a], mesh_.points[b], mesh_.points[c]);
    }
    return sum;
  }

  std::optional<Vec3> point_inside(std::vector<Side>& facets) const {
    const std::size_t tried = std::min(kTriedFacets, facets.size());
    std::ranges::partial_sort(facets, facets.begin() + static_cast<std::ptrdiff_t>(tried),
                              std::ranges::greater{},
                              [&](const Side& s) { return length2(outward_normal(s)); });
    std::optional<Vec3> best;
    double longest = 0;
    for (const Side& s : std::span(facets).first(tried)) {
      const Vec3 normal = outward_normal(s);
      const double twice_area = length(normal);
      if (!(twice_area > 0)) break;
      const Vec3 inward = -1 / twice_area * normal;
      Vec3 origin;
      for (std::size_t i = 0; i < 3; ++i) {
        origin = origin + kRayOrigin[i] * mesh_.points[mesh_.triangles[s.facet][i]];
      }
      const double half_way = way_to_next(origin, inward, s) / 2;
      if (half_way <= longest) continue;
      longest = half_way;
      best = origin + half_way * inward;
      if (half_way > kShortWay * std::sqrt(twice_area)) break;
    }
    return best;
  }

  // Returns how far the ray goes to the next facet. 0: it meets none, or one that borders on
  // another label there, since rounding made it miss one.
  double way_to_next(const Vec3& origin, const Vec3& direction, const Side& from) const {
    double nearest = std::numeric_limits<double>::infinity();
    bool is_in_label = false;
    const double stride = 2 * grid_.cell(), all = length(box_.size());
    for (double way = 0; way < all && nearest > way; way += stride) {
      const std::array ends{origin + way * direction, origin + (way + stride) * direction};
      grid_.any<std::uint32_t>(grid_.box_of(ends), [&](std::uint32_t f, const BoxGrid::Box&) {
        if (f == from.facet) return false;
        const auto [a, b, c] = mesh_.triangles[f];
        const Vec3 u = mesh_.points[b] - mesh_.points[a], v = mesh_.points[c] - mesh_.points[a];
        const Vec3 to = origin - mesh_.points[a], across = cross(direction, v);
        const double slope = dot(u, across);  // negative if the ray comes from behind
        if (slope == 0) return false;
        const double at_u = dot(to, across) / slope, at_v = dot(direction, cross(to, u)) / slope;
        const double t = dot(v, cross(to, u)) / slope;
        if (at_u < -kEdgeTolerance || at_v < -kEdgeTolerance || at_u + at_v > 1 + kEdgeTolerance) {
          return false;
        }
        if (t <= 0 || t >= nearest) return false;
        nearest = t;
        const std::size_t side = slope > 0 ? 0 : 1;
        is_in_label = mesh_.has_label(f, side) && mesh_.sides[f][side] == from.label;
        return false;
      });
    }
    return is_in_label ? nearest : 0;
  }

  const LabeledTriangles& mesh_;
  Box3 box_;
  BoxGrid grid_;
  RegionPoints found_;
};

}  // namespace

RegionPoints region_points(const LabeledTriangles& mesh) {
  const double cell = mean_size(mesh);
  return cell > 0 ? Regions(mesh, cell).find() : RegionPoints{};
}

}  // namespace deliso
