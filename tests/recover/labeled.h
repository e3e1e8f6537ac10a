// SPDX-License-Identifier: MIT
// Small surfaces T with given labels, for tests of the certificate, and the dual of the labels.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "contour/mesh_checks.h"
#include "mesh/tri_mesh.h"
#include "recover/certificate.h"
#include "recover/labels.h"

namespace deliso::test {

using ContourTriangles = std::vector<ContourTriangle>;

// ContourTriangles and their labels: one letter for each vertex of T, the region that it is in; a
// capital is the region's site. Regions lie far apart, so that nearest sites give just these
// labels.
struct Shape {
  std::string letters;
  ContourTriangles triangles;
  std::vector<Vec3> offsets;  // of each vertex from its site

  ContourId site(ContourId v) const {
    const char name = static_cast<char>(std::toupper(letters[v]));
    const std::size_t site = letters.find(name);
    REQUIRE(site != std::string::npos);
    return ContourId(site);
  }
};

inline Shape shape_of(const std::string& letters, ContourTriangles triangles) {
  Shape shape{letters, std::move(triangles), {}};
  for (ContourId v = 0; v < letters.size(); ++v) {
    const double steps = static_cast<double>(v) - static_cast<double>(shape.site(v));
    shape.offsets.push_back({0.1 * steps, 0, 0});
  }
  return shape;
}

// Where boundary edges lead, as the triangles run.
inline std::map<ContourId, ContourId> boundary_of(const ContourTriangles& triangles) {
  std::map<ContourId, ContourId> next;
  std::set<std::pair<ContourId, ContourId>> edges;
  for (const ContourTriangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.insert({t[i], t[(i + 1) % 3]});
  }
  for (const auto& [a, b] : edges) {
    if (!edges.contains({b, a})) next[a] = b;
  }
  return next;
}

// Its boundary lies on the box.
inline ContourMesh contour_of(const Shape& shape) {
  ContourMesh t;
  for (ContourId v = 0; v < shape.letters.size(); ++v) {
    const double n = std::toupper(shape.letters[v]) - 'A';
    t.points.push_back(Vec3{10 * n, n * n, n * n * n} + shape.offsets[v]);
  }
  t.component.assign(t.points.size(), 0);
  t.box_faces.assign(t.points.size(), 0);
  t.triangles = shape.triangles;
  t.summary.components.resize(1);
  for (const auto& [a, b] : boundary_of(t.triangles)) t.box_faces[a] = 1;
  return t;
}

// T with its sites, which may become more.
class Labeled {
 public:
  explicit Labeled(const Shape& shape)
      : letters_(shape.letters),
        contour_(contour_of(shape)),
        triangulation_(first_sites()),
        labels_(contour_, triangulation_),
        certificate_(labels_) {
    for (ContourId v = 0; v < letters_.size(); ++v) {
      REQUIRE(vertex_[labels_.label(v)] == shape.site(v));
    }
  }

  Verdict check(ContourId v) { return certificate_.check(labels_.label(v), v, facets_); }
  Verdict check(char site) { return check(ContourId(letters_.find(site))); }

  // The sites that break a condition.
  std::string broken() {
    std::string names;
    for (const ContourId v : vertex_) {
      if (v != kNoId && check(v).violation) names += letters_[v];
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  void insert(ContourId v) {
    REQUIRE(v != kNoId);
    ConflictZone zone;
    std::vector<CellId> created;
    triangulation_.find_conflicts(contour_.points[v], kNoId, zone);
    REQUIRE(zone.duplicate == kNoId);
    const SiteId site = triangulation_.insert_in_zone(contour_.points[v], zone, created);
    std::vector<SiteId> neighbors;
    for (SiteId s = 1; s < site; ++s) neighbors.push_back(s);
    labels_.add_site(site, neighbors);
    vertex_.push_back(v);
  }

  // Inserts the vertices that the certificate names until it holds. Returns how many.
  int insert_until_certified() {
    int insertions = 0;
    for (bool any = true; any;) {
      any = false;
      for (ContourId s = 1; s < vertex_.size(); ++s) {
        if (vertex_[s] == kNoId) continue;
        const Verdict verdict = check(vertex_[s]);
        if (!verdict.violation) continue;
        insert(verdict.insert);
        any = true;
        ++insertions;
      }
    }
    return insertions;
  }

  // The conditions that are broken at any site.
  std::set<paper::Reason> broken_conditions() {
    std::set<paper::Reason> reasons;
    for (const ContourId v : vertex_) {
      if (v == kNoId) continue;
      if (const auto violation = check(v).violation) reasons.insert(*violation);
    }
    return reasons;
  }

  // Every site is a vertex, also one without facets.
  ContourMesh dual() {
    ContourMesh dual;
    std::vector<ContourId> number(vertex_.size(), kNoId);
    for (const ContourId v : vertex_) {
      if (v == kNoId) continue;
      number[labels_.label(v)] = ContourId(dual.points.size());
      dual.points.push_back(contour_.points[v]);
      dual.box_faces.push_back(contour_.box_faces[v]);
    }
    for (const ContourId v : vertex_) {
      if (v == kNoId) continue;
      check(v);
      for (const DualFacet& f : facets_) {
        if (f.sites[1] < f.sites[0] || f.sites[2] < f.sites[0]) continue;
        dual.triangles.push_back({number[f.sites[0]], number[f.sites[1]], number[f.sites[2]]});
      }
    }
    return dual;
  }

  bool has_facets_at_all_sites() {
    std::set<ContourId> corners;
    const ContourMesh k = dual();
    for (const ContourTriangle& t : k.triangles) corners.insert(t.begin(), t.end());
    return corners.size() == k.points.size();
  }

  // What the dual lacks of being a surface like T, as docs/proof.md, Theorem 2, promises it: with
  // the sites on the box as its boundary, in T's order. Empty if it lacks nothing.
  std::string fault_of_dual() {
    const ContourMesh k = dual();
    const std::string fault = check_manifold(k);
    if (!fault.empty()) return fault;
    std::set<ContourTriangle> facets;
    for (ContourTriangle t : k.triangles) {
      std::sort(t.begin(), t.end());
      if (!facets.insert(t).second) return "a facet twice";
    }
    const CountedTopology is = measure_topology(k), wanted = measure_topology(contour_);
    if (is.components != wanted.components || is.euler != wanted.euler ||
        is.boundary_loops != wanted.boundary_loops) {
      return "another topology";
    }
    const std::map<ContourId, ContourId> next = boundary_of(contour_.triangles);
    std::vector<ContourId> at;  // per vertex of the dual, its vertex of T
    std::ranges::copy_if(vertex_, std::back_inserter(at), [](ContourId v) { return v != kNoId; });
    for (const auto& [a, b] : boundary_of(k.triangles)) {
      ContourId v = next.at(at[a]);
      while (!labels_.is_site(v)) v = next.at(v);
      if (v != at[b]) return "the boundary in another order";
    }
    return "";
  }

 private:
  // Every capital, and four corners that hold the triangulation together.
  Triangulation first_sites() {
    std::vector<Vec3> points;
    std::vector<ContourId> at;
    for (ContourId v = 0; v < letters_.size(); ++v) {
      if (!std::isupper(letters_[v])) continue;
      points.push_back(contour_.points[v]);
      at.push_back(v);
    }
    for (const Vec3& corner : {Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}}) {
      points.push_back(1e5 * corner);
    }
    Triangulation t;
    std::vector<SiteId> ids;
    REQUIRE(t.build(points, ids));
    vertex_.assign(t.vertex_capacity(), kNoId);
    for (std::size_t n = 0; n < at.size(); ++n) vertex_[ids[n]] = at[n];
    return t;
  }

  std::string letters_;
  ContourMesh contour_;
  std::vector<ContourId> vertex_;  // per site, its vertex of T
  Triangulation triangulation_;
  Labels labels_;
  Certificate certificate_;
  std::vector<DualFacet> facets_;
};

}  // namespace deliso::test
