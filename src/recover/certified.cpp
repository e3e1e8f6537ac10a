// SPDX-License-Identifier: MIT
#include "recover/certified.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "base/sorted_list.h"
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
  CertifiedSites(const ContourMesh& contour, Triangulation del, const Box3& box,
                 const paper::Options& options, paper::Report& report);

  const Triangulation& del() const { return del_; }
  // Adds sites until C1 to C4 hold at every site and every facet of K has an area.
  void recover();
  // Returns K as T_S. `poles`: of every site, or none.
  paper::SurfaceMesh build_dual(const std::vector<double>& poles, const paper::Sigma& sigma) const;

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

  const ContourMesh& contour_;
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

CertifiedSites::CertifiedSites(const ContourMesh& contour, Triangulation del, const Box3& box,
                               const paper::Options& options, paper::Report& report)
    : contour_(contour),
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
    queue(labels_.label(v));
  }
  require_few(report.points_initial(), options);
  if (options.observer) options.observer->labels_ready(labels_, box, report);
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

void CertifiedSites::recover() {
  paper::Steps steps(options_.observer);
  while (!stack_.empty()) {
    steps.step(stack_.size());
    const SiteId s = stack_.back();
    stack_.pop_back();
    sites_[s].is_queued = false;
    Verdict verdict = certificate_.check(s, sites_[s].at, facets_);
    if (!verdict.violation && has_flat_facet()) {
      verdict.insert = labels_.furthest(labels_.region(s));
    }
    sites_[s].is_uncertified = verdict.violation && verdict.insert == kNoId;
    if (verdict.insert == kNoId) continue;
    if (options_.observer) {
      const auto reason = verdict.violation.value_or(paper::Reason::no_area);
      options_.observer->asks_site(reason, s, verdict.insert);
    }
    if (add_site(verdict.insert)) {
      queue(s);
    } else {
      sites_[s].is_uncertified = verdict.violation.has_value();
      if (options_.observer) options_.observer->refused(paper::Refusal::vertex_there);
    }
  }
  for (const Site& s : sites_) report_.uncertified_sites += s.is_uncertified;
}

paper::SurfaceMesh CertifiedSites::build_dual(const std::vector<double>& poles,
                                              const paper::Sigma& sigma) const {
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
    out.duals.push_back(find_dual(del_.point(v[0]), del_.point(v[1]), del_.point(v[2]), sigma,
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
      return CertifiedSites(contour, std::move(s0), volume.box(), options, report);
    });
    stage("recover", report.seconds_recover, options, [&] { s.recover(); });
    if (options.observer) options.observer->recovered();
    if (options.stop_after_recover) return s.build_dual({}, sigma);
    const std::vector<double> poles = stage("poles", report.seconds_poles, options,
                                            [&] { return compute_poles(s.del(), sigma); });
    return s.build_dual(poles, sigma);
  });
}

}  // namespace deliso
