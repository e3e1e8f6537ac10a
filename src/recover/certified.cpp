// SPDX-License-Identifier: MIT
#include "recover/certified.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "base/sorted_list.h"
#include "contour/fine_contour.h"
#include "exact/predicates.h"
#include "paper/poles.h"
#include "recover/certificate.h"

namespace deliso {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

// Returns Del S of the first sites, and of the auxiliary vertices.
Triangulation first_sites(const ContourMesh& contour, const Box3& box,
                          const paper::Options& options) {
  std::vector<Vec3> sample;
  for (ContourId v = 0; v < contour.points.size(); ++v) {
    if (contour.on_boundary(v)) sample.push_back(contour.points[v]);
  }
  Random random(options.seed);
  for (std::size_t n = 0; n < std::max<std::size_t>(options.lines, 1); ++n) {  // a label needs one
    const ContourId v(random.below(static_cast<std::uint32_t>(contour.points.size())));
    sample.push_back(contour.points[v]);
  }
  append_auxiliary(box, sample);
  Triangulation del;
  std::vector<SiteId> ids;
  DELISO_CHECK(del.build(sample, ids));
  return del;
}

// Del S and the labels of T, while sites are added.
class CertifiedSites {
 public:
  // Keeps references. pre: T has vertices.
  CertifiedSites(const ContourMesh& contour, Triangulation del, const paper::Sigma& sigma,
                 const paper::Options& options, paper::Report& report)
      : contour_(contour),
        sigma_(sigma),
        options_(options),
        report_(report),
        del_(std::move(del)),
        sites_(del_.vertex_capacity()),
        labels_(contour, del_),
        certificate_(labels_) {
    for (ContourId v = 0; v < contour.points.size(); ++v) {
      Site& site = sites_[labels_.label(v)];
      if (!labels_.is_site(v) || site.at != kNoId) continue;
      site.at = v;
      ++(contour.on_boundary(v) ? report.points_on_curves : report.points_on_lines);
    }
    if (options.observer) options.observer->labels_ready(labels_, sigma.volume().box(), report);
  }

  const Triangulation& del() const { return del_; }
  // Adds sites until C1 to C4 hold at every site, and every facet of K has an area and keeps to
  // `epsilon`.
  void certify(double epsilon);
  // Returns the facets of K, by sites: where three labels of a triangle of T are different.
  std::vector<Triangle> dual_facets() const {
    std::vector<Triangle> facets;
    for (const ContourTriangle& t : contour_.triangles) {
      const SiteTriangle v{labels_.label(t[0]), labels_.label(t[1]), labels_.label(t[2])};
      if (v[0] != v[1] && v[1] != v[2] && v[2] != v[0]) facets.push_back(as_mesh_triangle(v));
    }
    return facets;
  }

 private:
  struct Site {
    ContourId at = kNoId;  // its vertex of T; kNoId: an auxiliary one
    bool is_queued = false;
    bool is_uncertified = false;  // the certificate fails here, and no vertex can be inserted
  };
  void queue(SiteId s) {
    if (!std::exchange(sites_[s].is_queued, true)) stack_.push_back(s);
  }
  // Makes the vertex v of T a site, unless another is there.
  void add_site(ContourId v);
  // Of facets_, those whose first site has the smallest number: returns why one is bad, and a
  // vertex of T to insert; kNoId: there is none.
  std::pair<paper::Reason, ContourId> bad_facet(double epsilon);

  const ContourMesh& contour_;
  const paper::Sigma& sigma_;
  const paper::Options& options_;
  paper::Report& report_;
  Triangulation del_;
  IdArray<SiteId, Site> sites_;
  Labels labels_;
  Certificate certificate_;
  // Sites to be tested, the last one first: it is near the one before, and its region is still in
  // the cache.
  std::vector<SiteId> stack_;
  std::vector<DualFacet> facets_;  // of the last site that was tested
  ConflictZone zone_;
  std::vector<CellId> created_;
  std::vector<SiteId> neighbors_;
};

void CertifiedSites::add_site(ContourId v) {
  const Vec3& p = contour_.points[v];
  del_.find_conflicts(p, del_.incident_cell(labels_.label(v)), zone_);
  if (zone_.duplicate != kNoId) return;
  if (options_.observer) options_.observer->insertion_begins(p, zone_);
  const SiteId s = del_.insert_in_zone(p, zone_, created_);
  sites_.emplace_back().at = v;
  neighbors_.clear();
  for (const CellId c : created_) {
    for (const SiteId n : del_.vertices(c)) {
      if (n != s && n != Triangulation::kInfinite) neighbors_.push_back(n);
    }
  }
  sort_unique(neighbors_);
  const std::vector<SiteId> changed = labels_.add_site(s, neighbors_);
  queue(s);
  for (const SiteId n : changed) queue(n);
  // Sites adjacent to a relabeled vertex have a new neighbor.
  for (const ContourId u : labels_.region(s)) {
    for (const ContourId w : labels_.ring(u)) queue(labels_.label(w));
  }
  ++report_.insertions_recover;
  if (options_.observer) options_.observer->site_added(s);
}

// V_sigma meets T near the triangle where the three labels meet, so a corner of that stands for x,
// which is no vertex of T.
std::pair<paper::Reason, ContourId> CertifiedSites::bad_facet(double epsilon) {
  for (const DualFacet& f : facets_) {
    const ContourId v = labels_.furthest(f.t_triangle);
    if (v == kNoId || f.sites[1] < f.sites[0] || f.sites[2] < f.sites[0]) continue;
    const Vec3 &a = del_.point(f.sites[0]), &b = del_.point(f.sites[1]),
               &c = del_.point(f.sites[2]);
    if (!(length2(cross(b - a, c - a)) > 0) || collinear(a, b, c)) {
      return {paper::Reason::no_area, v};  // Figure 9 needs a circumcircle
    }
    if (!std::isfinite(epsilon)) continue;
    const auto dual = find_dual(a, b, c, sigma_, report_.searches_recover);
    const FacetShape m = measure(a, b, c, dual.x);
    const auto [worst, reason] = violation(m, epsilon, kNoLimit, options_);
    if (m.r > report_.r_min && (worst > 1 || !dual.on_sigma)) return {reason, v};
  }
  return {paper::Reason::no_area, kNoId};
}

void CertifiedSites::certify(double epsilon) {
  for (SiteId s = 1; s < sites_.size(); ++s) {
    if (sites_[s].at != kNoId) queue(s);
  }
  Steps steps(options_.observer);
  while (!stack_.empty()) {
    steps.step(stack_.size());
    paper::require_few(report_.points_initial() + report_.insertions_recover, options_);
    const SiteId s = stack_.back();
    stack_.pop_back();
    sites_[s].is_queued = false;
    const Verdict verdict = certificate_.check(s, sites_[s].at, facets_);
    sites_[s].is_uncertified = verdict.violation.has_value();
    const auto [reason, v] =
        verdict.violation ? std::pair(*verdict.violation, verdict.insert) : bad_facet(epsilon);
    if (v == kNoId) continue;
    if (options_.observer) options_.observer->asks_site(reason, s, v);
    add_site(v);  // s is tested again
  }
  const auto open = std::ranges::count(sites_, true, &Site::is_uncertified);
  report_.uncertified_sites = static_cast<std::size_t>(open);
}

// Stage 1: returns T_S, with pole heights unless it is all that is asked for.
paper::SurfaceMesh stage_one(const Volume& volume, const paper::Sigma& sigma,
                             const paper::Options& options, paper::Report& report) {
  const ContourMesh contour = stage("contour", report.seconds_contour, options, [&] {
    return fine_contour(build_contour(volume, sigma.kappa()), volume, sigma.kappa());
  });
  report.contour_vertices = contour.points.size();
  if (contour.points.empty()) return paper::SurfaceMesh{};
  CertifiedSites s = stage("initial", report.seconds_init, options, [&] {
    return CertifiedSites(contour, first_sites(contour, volume.box(), options), sigma, options,
                          report);
  });
  stage("recover", report.seconds_recover, options, [&] {
    s.certify(kNoLimit);
    report.insertions_certified = report.insertions_recover;
    if (std::isfinite(options.epsilon)) s.certify(options.epsilon);
  });
  if (options.observer) options.observer->recovered();
  std::vector<double> poles;
  if (!options.stop_after_recover) {
    stage("poles", report.seconds_poles, options, [&] { poles = compute_poles(s.del(), sigma); });
  }
  paper::SurfaceMesh k = paper::as_mesh(s.del(), s.dual_facets(), poles);
  for (const Face& face : k.mesh.faces) {
    const auto at = [&](std::size_t i) { return k.mesh.points[face.v[i]]; };
    k.duals.push_back(paper::find_dual(at(0), at(1), at(2), sigma, report.searches_recover));
  }
  return k;
}

}  // namespace

TriMesh certified_deliso(const Volume& volume, double isovalue, const paper::Options& options,
                         paper::Report& report) {
  const StepTimer total(report.seconds_total);
  const VoxelTree tree = paper::begin_run(volume, isovalue, options, report);
  const paper::Sigma sigma(tree, report.kappa, options.solver);
  return paper::finish(stage_one(volume, sigma, options, report), sigma, options, report);
}

}  // namespace deliso
