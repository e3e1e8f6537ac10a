// SPDX-License-Identifier: MIT
#include "recover/certified.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "base/triangle.h"
#include "contour/fine_contour.h"
#include "delaunay/predicates.h"
#include "paper/poles.h"
#include "recover/certificate.h"

namespace deliso {
namespace {

// The first sites, and the auxiliary vertices.
Triangulation first_sites(const ContourMesh& contour, const Box3& box,
                          const paper::Options& options) {
  std::vector<Vec3> sample;
  for (VertexId v = 0; v < contour.points.size(); ++v) {
    if (contour.on_boundary(v)) sample.push_back(contour.points[v]);
  }
  Random random(options.seed);
  const std::size_t count = std::max<std::size_t>(options.lines, 1);  // labels need a site
  for (std::size_t n = 0; n < count; ++n) {
    const VertexId v(random.below(static_cast<std::uint32_t>(contour.points.size())));
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
                 const paper::Options& options, paper::Report& report);

  const Triangulation& del() const { return del_; }
  // Adds sites until C1 to C4 hold at every site, and every facet of K has an area and keeps to
  // `epsilon`; infinite: no limit.
  void certify(double epsilon);
  std::size_t count_uncertified() const;
  // Returns K as T_S. `poles`: of every site, or none.
  paper::SurfaceMesh build_dual(const std::vector<double>& poles) const;

 private:
  struct Site {
    VertexId at = kNoId;     // its vertex of T; kNoId: an auxiliary one
    SiteId seen_by = kNoId;  // the last new site with this one as a neighbor
    bool is_queued = false;
    bool is_uncertified = false;  // the certificate fails here, and no vertex can be inserted
  };
  void queue(SiteId s);
  // Makes the vertex v of T a site. Returns false if a site is there.
  bool add_site(VertexId v);
  bool has_flat_facet() const;
  // Of facets_, those whose first site has the smallest number: returns why one is bad, and a
  // vertex of T in place of its x, which is none. kNoId: all are good.
  std::pair<paper::Reason, VertexId> bad_facet(double epsilon);

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

CertifiedSites::CertifiedSites(const ContourMesh& contour, Triangulation del,
                               const paper::Sigma& sigma, const paper::Options& options,
                               paper::Report& report)
    : contour_(contour),
      sigma_(sigma),
      options_(options),
      report_(report),
      del_(std::move(del)),
      sites_(del_.vertex_capacity()),
      labels_(contour, del_),
      certificate_(labels_) {
  for (VertexId v = 0; v < contour.points.size(); ++v) {
    Site& site = sites_[labels_.label(v)];
    if (!labels_.is_site(v) || site.at != kNoId) continue;
    site.at = v;
    ++(contour.on_boundary(v) ? report.points_on_curves : report.points_on_lines);
  }
  require_few(report.points_initial(), options);
  if (options.observer) options.observer->labels_ready(labels_, sigma.volume().box(), report);
}

void CertifiedSites::queue(SiteId s) {
  if (sites_[s].is_queued) return;
  sites_[s].is_queued = true;
  stack_.push_back(s);
}

bool CertifiedSites::add_site(VertexId v) {
  const Vec3& p = contour_.points[v];
  del_.find_conflicts(p, del_.incident_cell(labels_.label(v)), zone_);
  if (zone_.duplicate != kNoId) return false;
  if (options_.observer) options_.observer->insertion_begins(p, zone_);
  const SiteId s = del_.insert_in_zone(p, zone_, created_);
  sites_.emplace_back().at = v;
  neighbors_.clear();
  for (const CellId c : created_) {
    for (const SiteId n : del_.vertices(c)) {
      if (n == s || n == Triangulation::kInfinite || sites_[n].seen_by == s) continue;
      sites_[n].seen_by = s;
      neighbors_.push_back(n);
    }
  }
  std::ranges::sort(neighbors_);
  const std::vector<SiteId> changed = labels_.add_site(s, neighbors_);
  queue(s);
  for (const SiteId n : changed) queue(n);
  // Sites adjacent to a relabeled vertex have a new neighbor.
  for (const VertexId u : labels_.region(s)) {
    for (const VertexId w : labels_.ring(u)) {
      if (labels_.label(w) != s) queue(labels_.label(w));
    }
  }
  ++report_.insertions_recover;
  if (options_.observer) options_.observer->site_added(s);
  paper::require_few(report_.points_initial() + report_.insertions_recover, options_);
  return true;
}

// Figure 9 needs the circumcircle of a facet.
bool CertifiedSites::has_flat_facet() const {
  return std::ranges::any_of(facets_, [&](const DualFacet& f) {
    const Vec3 &a = del_.point(f.sites[0]), &b = del_.point(f.sites[1]),
               &c = del_.point(f.sites[2]);
    return !(length2(cross(b - a, c - a)) > 0) || collinear(a, b, c);
  });
}

// The triangle of T where three labels meet is where V_sigma meets T.
std::pair<paper::Reason, VertexId> CertifiedSites::bad_facet(double epsilon) {
  for (const DualFacet& f : facets_) {
    if (f.sites[1] < f.sites[0] || f.sites[2] < f.sites[0]) continue;
    const Vec3 &a = del_.point(f.sites[0]), &b = del_.point(f.sites[1]),
               &c = del_.point(f.sites[2]);
    const VertexId v = labels_.furthest(f.t_triangle);
    if (v == kNoId || distance(circumcenter(a, b, c), a) <= report_.r_min) continue;
    const auto dual = find_dual(a, b, c, sigma_, report_.searches_recover);
    const auto [worst, reason] = violation(paper::measure(a, b, c, dual.x), epsilon,
                                           std::numeric_limits<double>::infinity(), options_);
    if (worst > 1 || !dual.on_sigma) return {reason, v};
  }
  return {paper::Reason::h_over_r, kNoId};
}

void CertifiedSites::certify(double epsilon) {
  for (SiteId s = 1; s < sites_.size(); ++s) {
    if (sites_[s].at != kNoId) queue(s);
  }
  paper::Steps steps(options_.observer);
  while (!stack_.empty()) {
    steps.step(stack_.size());
    const SiteId s = stack_.back();
    stack_.pop_back();
    sites_[s].is_queued = false;
    const Verdict verdict = certificate_.check(s, sites_[s].at, facets_);
    sites_[s].is_uncertified = verdict.violation.has_value();
    auto [reason, v] = std::pair(paper::Reason::no_area, verdict.insert);
    if (verdict.violation) {
      reason = *verdict.violation;
    } else if (has_flat_facet()) {
      v = labels_.furthest(labels_.region(s));
    } else if (std::isfinite(epsilon)) {
      std::tie(reason, v) = bad_facet(epsilon);
    }
    if (v == kNoId) continue;
    if (options_.observer) options_.observer->asks_site(reason, s, v);
    if (add_site(v)) {
      queue(s);
    } else if (options_.observer) {
      options_.observer->refused(paper::Refusal::vertex_there);
    }
  }
}

std::size_t CertifiedSites::count_uncertified() const {
  return static_cast<std::size_t>(std::ranges::count(sites_, true, &Site::is_uncertified));
}

paper::SurfaceMesh CertifiedSites::build_dual(const std::vector<double>& poles) const {
  paper::SurfaceMesh out;
  std::vector<Triangle> facets;
  std::vector<Vec3> points;
  IdArray<SiteId, VertexId> vertex_of(sites_.size(), kNoId);
  for (const Triangle& t : contour_.triangles) {
    const SiteTriangle v{labels_.label(t[0]), labels_.label(t[1]), labels_.label(t[2])};
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
    for (const SiteId q : v) {
      if (vertex_of[q] != kNoId) continue;
      vertex_of[q] = VertexId(points.size());
      points.push_back(del_.point(q));
      if (!poles.empty()) out.poles.push_back(poles[q]);
    }
    facets.push_back({vertex_of[v[0]], vertex_of[v[1]], vertex_of[v[2]]});
    out.duals.push_back(find_dual(del_.point(v[0]), del_.point(v[1]), del_.point(v[2]), sigma_,
                                  report_.searches_recover));
  }
  out.mesh = make_tri_mesh(std::move(points), facets);
  return out;
}

}  // namespace

TriMesh certified_deliso(const Volume& volume, double isovalue, const paper::Options& options,
                         paper::Report& report) {
  using paper::stage;
  return paper::deliso(volume, isovalue, options, report, [&](paper::Sigma& sigma) {
    const ContourMesh contour = stage("contour", report.seconds_contour, options, [&] {
      return fine_contour(build_contour(volume, sigma.kappa()), volume, sigma.kappa());
    });
    report.contour_vertices = contour.points.size();
    if (contour.points.empty()) return paper::SurfaceMesh{};
    Triangulation s0 = stage("initial", report.seconds_init, options,
                             [&] { return first_sites(contour, volume.box(), options); });
    CertifiedSites s = stage("labels", report.seconds_labels, options, [&] {
      return CertifiedSites(contour, std::move(s0), sigma, options, report);
    });
    stage("recover", report.seconds_recover, options, [&] {
      s.certify(std::numeric_limits<double>::infinity());
      report.insertions_certified = report.insertions_recover;
      if (std::isfinite(options.epsilon)) s.certify(options.epsilon);
    });
    report.uncertified_sites = s.count_uncertified();
    if (options.observer) options.observer->recovered();
    if (options.stop_after_recover) return s.build_dual({});
    const std::vector<double> poles = stage("poles", report.seconds_poles, options,
                                            [&] { return compute_poles(s.del(), sigma); });
    return s.build_dual(poles);
  });
}

}  // namespace deliso
