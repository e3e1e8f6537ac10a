// SPDX-License-Identifier: MIT
// The published program with the certified Stage 1, against the exact contour: the mesh is like T
// component by component, when it is handed over and when it is refined.
#include "recover/certified.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "base/check.h"
#include "base/triangle.h"
#include "cases.h"
#include "check/check_mesh.h"
#include "coarsen/contour_as_mesh.h"
#include "contour/fine_contour.h"
#include "delaunay/voronoi.h"
#include "exact/predicates.h"
#include "io/volume/builtin_volume.h"
#include "isosurface/isosurface.h"
#include "mesh/meshes.h"
#include "recover/certificate.h"
#include "stress/tiny_volume.h"

using namespace deliso;

namespace {

struct CertifiedRun {
  paper::Report report;
  TriMesh mesh;
};

CertifiedRun run(const Volume& volume, double isovalue, const paper::Options& options) {
  CertifiedRun out;
  out.mesh = certified_deliso(volume, isovalue, options, out.report);
  return out;
}

ContourMesh contour_of(const Volume& volume, double isovalue) {
  const double kappa = geometric_isovalue(volume.type(), isovalue);
  return fine_contour(build_contour(volume, kappa), volume, kappa);
}

// Returns what the mesh lacks of being a surface like T, component by component, with T's boundary
// vertices as its own. Sites, of which each component has some, are vertices of T.
std::string difference(const TriMesh& mesh, const ContourMesh& t) {
  const std::string fault = check_mesh(mesh);
  if (!fault.empty()) return fault;
  std::map<std::tuple<double, double, double>, ContourId> at;
  for (ContourId v = 0; v < t.points.size(); ++v) {
    const Vec3& p = t.points[v];
    at[{p.x, p.y, p.z}] = v;
  }
  const MeshTopology topology = mesh_topology(mesh);
  const std::vector<std::uint32_t> of_mesh =
      vertex_components(mesh.points.size(), mesh.triangles());
  std::vector<std::uint32_t> of_t(topology.components.size(), kNoId);
  std::size_t on_box = 0;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = mesh.points[v];
    const auto found = at.find({p.x, p.y, p.z});
    if (found == at.end()) continue;
    on_box += t.on_boundary(found->second);
    std::uint32_t& c = of_t[of_mesh[v]];
    const std::uint32_t other = t.component[found->second];
    if (c != kNoId && c != other) return "two components are joined";
    c = other;
  }
  const auto wanted =
      t.points.size() - static_cast<std::size_t>(std::ranges::count(t.box_faces, 0));
  if (on_box != wanted) return "the boundary has not all vertices of T's";
  std::vector<int> seen(t.summary.components.size(), 0);
  for (std::size_t c = 0; c < of_t.size(); ++c) {
    if (of_t[c] == kNoId) return "a component without a site";
    const ContourComponent& like = t.summary.components[of_t[c]];
    const ComponentTopology& is = topology.components[c];
    if (is.euler() != like.euler || is.boundary_loops != like.boundary_loops) {
      return "a component of another topology";
    }
    ++seen[of_t[c]];
  }
  return std::ranges::count(seen, 1) == std::ssize(seen) ? "" : "a component is missing";
}

double volume_of(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  double six = 0;
  for (const Triangle& t : triangles) six += dot(points[t[0]], cross(points[t[1]], points[t[2]]));
  return six / 6;
}

constexpr double kNone = std::numeric_limits<double>::infinity();

// What the certificate says at the end of Stage 1, of all sites anew, and what ApproximateGeom
// left.
class Judge : public paper::Observer {
 public:
  explicit Judge(const Isosurface& surface, double epsilon = kNone)
      : surface_(surface), epsilon_(epsilon) {}

  std::size_t sites = 0, broken = 0, bad = 0;
  std::map<paper::Reason, int> asked;

  void labels_ready(const Labels& labels, const Box3&, const paper::Report& report) override {
    labels_ = &labels;
    report_ = &report;
    sites = broken = bad = 0;
  }
  void asks_site(paper::Reason reason, SiteId, ContourId) override { ++asked[reason]; }
  void recovered() override {
    Certificate certificate(*labels_);
    std::vector<DualFacet> facets;
    for (ContourId v = 0; v < labels_->all().size(); ++v) {
      if (!labels_->is_site(v)) continue;
      ++sites;
      broken += certificate.check(labels_->label(v), v, facets).violation.has_value();
      bad += std::isfinite(epsilon_)
                 ? std::ranges::count_if(facets, [&](const DualFacet& f) { return is_bad(f); })
                 : 0;
    }
  }

 private:
  // A criterion does not hold, and there is a vertex of T to insert.
  bool is_bad(const DualFacet& f) const {
    if (std::ranges::all_of(f.t_triangle, [&](ContourId v) { return labels_->is_site(v); })) {
      return false;
    }
    const auto at = [&](std::size_t i) { return labels_->triangulation().point(f.sites[i]); };
    const FacetLine line = facet_line(at(0), at(1), at(2));
    if (line.radius <= report_->r_min) return false;
    SearchCounters counters;
    const auto x = surface_.nearest(line.center, line.normal, line.radius, counters);
    const double shortest = std::sqrt(shortest_edge2(at(0), at(1), at(2)));
    return !x || distance(x->point, line.center) > 1.001 * epsilon_ * line.radius ||
           line.radius > 2.001 * shortest;
  }

  const Isosurface& surface_;
  double epsilon_;
  const Labels* labels_ = nullptr;
  const paper::Report* report_ = nullptr;
};

}  // namespace

TEST_CASE("what is handed over, and what becomes of it, is like T component by component") {
  std::map<paper::Reason, int> asked;
  for (const std::string name :
       {"torus", "linked_tori", "five_spheres", "fuel", "gyroid", "machine"}) {
    CAPTURE(name);
    const Volume volume = make_builtin_volume("builtin:" + name + ":20");
    const double isovalue = find_builtin_field("builtin:" + name)->isovalue;
    const ContourMesh t = contour_of(volume, isovalue);
    const Isosurface surface(volume, geometric_isovalue(volume.type(), isovalue));
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      CAPTURE(seed);
      std::size_t first = 0;
      for (const double epsilon : {kNone, 0.2}) {
        CAPTURE(epsilon);
        Judge judge(surface, epsilon);
        paper::Options options{
            .epsilon = epsilon, .r_min = 0.04, .lines = 3, .seed = seed, .observer = &judge};
        const CertifiedRun refined = run(volume, isovalue, options);
        const paper::Report& r = refined.report;
        CHECK(difference(refined.mesh, t) == "");
        // The inside is on T's side, though Refine leaves parts of Sigma out.
        const bool closed = t.boundary.size() == 0;
        CHECK((!closed || volume_of(refined.mesh.points, refined.mesh.triangles()) *
                                  volume_of(t.points, contour_as_mesh(t).mesh.triangles()) >
                              0));
        CHECK(r.uncertified_sites == 0);
        CHECK(judge.broken == 0);
        CHECK(judge.bad == 0);
        CHECK(judge.sites == r.points_initial() + r.insertions_recover);
        CHECK(refined.mesh.points.size() == judge.sites + r.insertions_refine);
        for (const auto& [reason, count] : judge.asked) asked[reason] += count;
        options.stop_after_recover = true;
        const CertifiedRun k = run(volume, isovalue, options);
        CHECK(k.mesh.points.size() == r.points_initial() + r.insertions_recover);
        CHECK(difference(k.mesh, t) == "");
        if (epsilon == kNone) {
          first = k.mesh.points.size();
          CHECK(first < t.points.size() / 2);
        } else {
          CHECK(r.points_initial() + r.insertions_certified == first);
          CHECK(judge.sites > first);
        }
      }
    }
  }
  for (const auto reason : {paper::Reason::region, paper::Reason::interface, paper::Reason::triple,
                            paper::Reason::h_over_r, paper::Reason::r_over_l}) {
    CHECK(asked[reason] > 0);
  }
}

TEST_CASE("random volumes: K is like T, and its facets have an area") {
  std::size_t open = 0, flat = 0;
  const auto seeds = static_cast<std::uint64_t>(test::cases(700));
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    CAPTURE(seed);
    const stress::TinyVolume tiny = stress::make_tiny_volume(seed);
    const ContourMesh t = contour_of(tiny.volume, tiny.isovalue);
    const Isosurface surface(tiny.volume, geometric_isovalue(tiny.volume.type(), tiny.isovalue));
    Judge judge(surface);
    const CertifiedRun k = run(tiny.volume, tiny.isovalue,
                               {.epsilon = seed % 2 == 0 ? 0.2 : kNone,
                                .lines = 1 + seed % 3,
                                .seed = seed,
                                .stop_after_recover = true,
                                .observer = &judge});
    if (k.report.uncertified_sites > 0) {
      ++open;
      continue;
    }
    flat += judge.asked.contains(paper::Reason::no_area);
    CHECK(judge.broken == 0);
    CHECK(difference(k.mesh, t) == "");
    for (const Face& face : k.mesh.faces) {
      const auto at = [&](std::size_t i) { return k.mesh.points[face.v[i]]; };
      CHECK_FALSE(collinear(at(0), at(1), at(2)));
    }
  }
  CHECK(open == 0);
  CHECK(flat > 0);
}

// The published program has them only if a line meets them, or a Voronoi edge.
TEST_CASE("components that no first site is on are found") {
  const Volume volume = make_builtin_volume("builtin:five_spheres:24");
  const double isovalue = find_builtin_field("builtin:five_spheres")->isovalue;
  paper::Options options{.epsilon = kNone, .lines = 1, .stop_after_recover = true};
  const CertifiedRun k = run(volume, isovalue, options);
  CHECK(k.report.points_initial() == 1);
  CHECK(mesh_topology(k.mesh).components.size() == 5);
  options.lines = 20;
  paper::Report report;
  const TriMesh published = paper::deliso(volume, isovalue, options, report);
  CHECK(mesh_topology(published).components.size() < 5);
}

TEST_CASE("no surface, no lines, too many vertices") {
  const Volume volume = make_builtin_volume("builtin:torus:16");
  CHECK(run(volume, 100, {}).mesh.faces.empty());
  const CertifiedRun one = run(volume, 0, {.lines = 0, .stop_after_recover = true});
  CHECK(one.report.points_initial() == 1);
  CHECK(mesh_topology(one.mesh).counts().euler == 0);
  CHECK_THROWS_AS(run(volume, 0, {.max_vertices = 10}), InputError);
  CHECK(test::same_mesh(run(volume, 0, {}).mesh, run(volume, 0, {}).mesh));
}
