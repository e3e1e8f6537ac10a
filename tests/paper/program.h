// SPDX-License-Identifier: MIT
// The published program step by step, and what its tests look at.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "base/random.h"
#include "base/triangle.h"
#include "delaunay/voronoi.h"
#include "io/volume/builtin_volume.h"
#include "isosurface/isosurface.h"
#include "kdtree/voxel_tree.h"
#include "mesh/star.h"
#include "paper/deliso.h"
#include "volume/sampled.h"

namespace deliso::test {

struct Field {
  Volume volume;
  double isovalue;
};

inline Field builtin(const std::string& name, int size) {
  const std::string input = "builtin:" + name + ":" + std::to_string(size);
  return {make_builtin_volume(input), find_builtin_field(input)->isovalue};
}

// White noise, each sample the mean of it and its neighbors: thin sheets that the box cuts anyhow.
inline Field noise(std::uint64_t seed, int size) {
  Random random(seed);
  std::vector<double> white(static_cast<std::size_t>(size) * size * size);
  for (double& x : white) x = random.uniform(-1, 1);
  const auto mean_around = [&](int i, int j, int k) {
    double sum = 0;
    int count = 0;
    for (int c = std::max(k - 1, 0); c <= std::min(k + 1, size - 1); ++c) {
      for (int b = std::max(j - 1, 0); b <= std::min(j + 1, size - 1); ++b) {
        for (int a = std::max(i - 1, 0); a <= std::min(i + 1, size - 1); ++a, ++count) {
          sum += white[static_cast<std::size_t>(a + size * (b + size * c))];
        }
      }
    }
    return sum / count;
  };
  return {sampled<float>({size, size, size}, {1, 1, 1}, mean_around), 0.02};
}

// Of every run here: one that does not end by itself ends so.
inline paper::Options few_vertices(std::size_t most = 20'000) {
  paper::Options options;
  options.max_vertices = most;
  return options;
}

inline paper::Report begun(const Volume& volume, double isovalue, const paper::Options& options) {
  paper::Report report;
  report.kappa = geometric_isovalue(volume.type(), isovalue);
  report.r_min = options.r_min * volume.box().smallest_side();
  return report;
}

// A field as InitTriangulation leaves it.
struct Program {
  Program(Field field, const paper::Options& given)
      : volume(std::move(field.volume)),
        tree(volume),
        options(given),
        report(begun(volume, field.isovalue, options)),
        sigma(tree, report.kappa, options.solver),
        recovery(paper::init_triangulation(sigma, options, report)) {}
  Program(const Program&) = delete;

  const paper::RestrictedDelaunay& del() const { return recovery.del(); }

  Volume volume;
  VoxelTree tree;
  paper::Options options;
  paper::Report report;
  paper::Sigma sigma;
  paper::Recovery recovery;
};

// The whole program.
inline TriMesh run(const Field& field, const paper::Options& options, paper::Report& report) {
  return paper::deliso(field.volume, field.isovalue, options, report);
}

// Calls visit(facet) for every facet of three sites, once.
template <class Visit>
void for_each_finite_facet(const Triangulation& t, Visit&& visit) {
  for (CellId c = 0; c < t.cell_capacity(); ++c) {
    for (int i = 0; i < 4 && t.is_live(c); ++i) {
      if (c < t.neighbor(c, i) && !has_infinite_vertex(t, {c, i})) visit(Facet{c, i});
    }
  }
}

inline SiteTriangle sorted_corners(const Triangulation& t, Facet f) {
  SiteTriangle v = facet_vertices(t, f);
  std::ranges::sort(v);
  return v;
}

// Del S|Sigma: the points in which each facet's Voronoi edge meets Sigma, by the facet's corners.
using FacetHits = std::map<SiteTriangle, std::vector<Vec3>>;

inline FacetHits stored_hits(const paper::RestrictedDelaunay& del) {
  FacetHits all;
  for_each_finite_facet(del.del(), [&](Facet f) {
    for (const Hit& x : del.hits(f)) all[sorted_corners(del.del(), f)].push_back(x.point);
  });
  return all;
}

// The same by a search of every Voronoi edge, voxel by voxel.
inline FacetHits searched_hits(const paper::RestrictedDelaunay& del, double r_min) {
  const Isosurface surface(del.sigma().volume(), del.sigma().kappa());
  SearchCounters counters;
  std::vector<Hit> hits;
  FacetHits all;
  for_each_finite_facet(del.del(), [&](Facet f) {
    const FacetDual edge = facet_dual(del.del(), f);
    const Range t = clip(edge.center, edge.normal, {edge.t_lo, edge.t_hi}, surface.volume().box());
    if (t.empty()) return;
    surface.intersect({edge.at(t.lo), edge.at(t.hi)}, hits, counters);
    std::vector<Vec3> x;
    for (const Hit& hit : hits) {
      if (!x.empty() && distance(x.back(), hit.point) < paper::Options::kClosest * r_min) {
        x.pop_back();
      } else {
        x.push_back(hit.point);
      }
    }
    if (!x.empty()) all[sorted_corners(del.del(), f)] = x;
  });
  return all;
}

// D_q of every vertex q of a facet.
inline std::map<SiteId, std::vector<Triangle>> stars(const FacetHits& facets) {
  std::map<SiteId, std::vector<Triangle>> all;
  for (const auto& [v, hits] : facets) {
    for (const SiteId q : v) all[q].push_back(as_mesh_triangle(v));
  }
  return all;
}

inline std::size_t count_met_twice(const FacetHits& facets) {
  return static_cast<std::size_t>(
      std::ranges::count_if(facets, [](const auto& facet) { return facet.second.size() > 1; }));
}

// How far the worst of r/l and h/r is over its limit; 0 up to r_min.
inline double violation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x, double epsilon,
                        double lambda, double r_min) {
  const double ab = distance(a, b), bc = distance(b, c), ca = distance(c, a);
  const double r = ab * bc * ca / (2 * length(area_normal(a, b, c)));
  // x is over the circumcenter: |xa|^2 = h^2 + r^2.
  const double h = std::sqrt(std::max(0.0, distance2(x, a) - r * r));
  return r <= r_min ? 0 : std::max(h / r / epsilon, r / std::min({ab, bc, ca}) / lambda);
}

}  // namespace deliso::test
