// SPDX-License-Identifier: MIT
#include "recover/recover.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/check.h"
#include "base/sorted_list.h"
#include "base/stopwatch.h"
#include "contour/bounded_volume.h"
#include "contour/fine_contour.h"
#include "recover/certificate.h"
#include "recover/dual_crossings.h"
#include "recover/protrusions.h"
#include "stage1/build_tri_mesh.h"
#include "surface/observer.h"
#include "surface/surface_point.h"

namespace deliso {
namespace {

class CertifiedRecovery {
 public:
  CertifiedRecovery(const Isosurface& surface, const ContourMesh& contour, FirstSample first,
                    const Parameters& parameters, Report& report)
      : surface_(surface),
        contour_(contour),
        parameters_(parameters),
        follower_(follower(parameters.observer)),
        steps_(parameters.observer),
        report_(report),
        triangulation_(std::move(first.triangulation)),
        chain_(std::move(first.chain)),
        sites_(triangulation_.vertex_capacity()),
        labels_(contour, triangulation_),
        certificate_(labels_),
        origins_(component_origins(contour, surface.volume().box())),
        wanted_volumes_(
            bounded_volumes(contour.points, contour.triangles, contour.component, origins_)) {
    // In reverse: the last one is tested first.
    for (std::size_t n = contour.points.size(); n-- > 0;) {
      const VertexId v(n);
      if (!labels_.is_site(v)) continue;
      sites_[labels_.label(v)].at = v;
      queue_site(labels_.label(v));
    }
    if (follower_) follower_->labels_ready(labels_, surface.volume().box());
  }

  SurfaceMesh run();

 private:
  struct Site {
    VertexId at = kNoId;     // its vertex of T; kNoId: an auxiliary site
    SiteId seen_by = kNoId;  // the last new site with this one as a neighbor
    bool queued = false;
    bool is_new = false;            // its facets were not tested for crossings since they changed
    bool is_uncertified = false;    // breaks the certificate, and no vertex can be inserted
    std::vector<DualFacet> facets;  // of K, each with this site first
  };

  void queue_site(SiteId s);
  // Makes the vertex v of T a site. Returns false if it coincides with a site.
  bool add_site(VertexId v);
  // Adds sites until the certificate holds at every site and no vertex of T is a protrusion.
  void certify_sites();
  // Adds a site for every crossing of facets of K. Returns how many it added.
  std::size_t resolve_crossings();
  // Adds a site to every reversed component: four sites on a thin component can have either
  // orientation. Returns how many it added.
  std::size_t correct_reversed();
  // Makes the vertices sites, but for kNoId. Returns how many it added.
  std::size_t add_sites(std::span<const VertexId> vertices, Reason reason);
  DualFacets all_facets() const;
  SurfaceMesh build_dual();

  const Isosurface& surface_;
  const ContourMesh& contour_;
  const Parameters& parameters_;
  Observer* const follower_;
  Steps steps_;
  Report& report_;
  Triangulation triangulation_;
  SiteChain chain_;
  IdArray<SiteId, Site> sites_;
  Labels labels_;
  Certificate certificate_;
  const std::vector<std::optional<Vec3>> origins_;  // per component of T
  const std::vector<double> wanted_volumes_;        // bounded by T; only the signs matter
  // Sites to be tested, the last one first: it is near the one before, and its region is still in
  // the cache. In any other order a large volume takes up to three times as long.
  std::vector<SiteId> stack_;
  ConflictZone zone_;
  std::vector<CellId> created_;
  std::vector<SiteId> neighbors_;
};

SurfaceMesh CertifiedRecovery::run() {
  const StepTimer timer(report_.seconds_recover);
  begin_stage(parameters_.observer, "recover");
  do {
    certify_sites();
  } while (resolve_crossings() > 0 || correct_reversed() > 0);
  for (const Site& s : sites_) report_[Counter::uncertified_sites] += s.is_uncertified;
  if (follower_) follower_->recovery_finished();
  return build_dual();
}

SurfaceMesh CertifiedRecovery::build_dual() {
  DualFacets k = all_facets();
  std::vector<Dual> duals;
  duals.reserve(k.triangles.size());
  SurfacePointFinder finder(surface_);
  for (const Triangle& v : k.triangles) {
    duals.push_back(
        finder.dual(k.points[v[0]], k.points[v[1]], k.points[v[2]], report_.searches_recover));
    report_[Counter::unready_facets] += !duals.back().on_surface;
  }
  return build_tri_mesh(triangulation_, std::move(k.triangles), std::move(duals), chain_);
}

void CertifiedRecovery::queue_site(SiteId s) {
  if (sites_[s].queued || sites_[s].at == kNoId) return;
  sites_[s].queued = true;
  stack_.push_back(s);
}

bool CertifiedRecovery::add_site(VertexId v) {
  const Vec3& p = contour_.points[v];
  triangulation_.find_conflicts(p, triangulation_.incident_cell(labels_.label(v)), zone_);
  if (zone_.duplicate != kNoId) return false;
  if (follower_) follower_->insertion_begins(p, zone_);
  const SiteId s = triangulation_.insert_in_zone(p, zone_, created_);
  require_room(triangulation_, parameters_);
  DELISO_ASSERT(sites_.size() == s);
  sites_.emplace_back().at = v;
  neighbors_.clear();
  for (const CellId c : created_) {
    for (const SiteId n : triangulation_.vertices(c)) {
      if (n == s || n == Triangulation::kInfinite || sites_[n].seen_by == s) continue;
      sites_[n].seen_by = s;
      neighbors_.push_back(n);
    }
  }
  std::sort(neighbors_.begin(), neighbors_.end());
  const std::vector<SiteId> changed = labels_.add_site(s, neighbors_);
  queue_site(s);
  for (const SiteId n : changed) queue_site(n);
  // Sites adjacent to a relabeled vertex have a new neighbor.
  for (const VertexId u : labels_.region(s)) {
    for (const VertexId w : labels_.ring(u)) {
      if (labels_.label(w) != s) queue_site(labels_.label(w));
    }
  }
  if (contour_.on_boundary(v)) {
    VertexId before = labels_.ring(v).back();
    double steps = 1;
    for (; !labels_.is_site(before); ++steps) before = labels_.ring(before).back();
    CurvePlace place = chain_.place(labels_.label(before));
    const std::size_t length = contour_.boundary.chain(place.loop).size();
    place.s = std::fmod(place.s + steps, static_cast<double>(length));
    chain_.insert_after(labels_.label(before), s, place);
    ++report_[Counter::boundary_splits_recover];
  }
  if (follower_) follower_->site_added(s);
  return true;
}

void CertifiedRecovery::certify_sites() {
  while (!stack_.empty()) {
    steps_.step(stack_.size());
    const SiteId s = stack_.back();
    stack_.pop_back();
    Site& site = sites_[s];
    site.queued = false;
    site.is_new = true;
    Verdict verdict = certificate_.check(s, site.at, site.facets);
    if (!verdict.violation) {
      verdict.insert = find_protrusion(s, site.facets, labels_, surface_, parameters_);
    }
    site.is_uncertified = false;
    if (!verdict.violation && verdict.insert == kNoId) continue;
    if (follower_ && verdict.violation) {
      follower_->site_asked(*verdict.violation, s, verdict.insert);
    } else if (follower_) {
      follower_->site_asked(Reason::protrusion, s, verdict.insert);
    }
    if (verdict.insert != kNoId && add_site(verdict.insert)) {
      queue_site(s);
    } else if (verdict.violation) {
      sites_[s].is_uncertified = true;
    }
  }
}

DualFacets CertifiedRecovery::all_facets() const {
  DualFacets k;
  k.points.resize(sites_.size());
  for (SiteId s = 1; s < sites_.size(); ++s) {
    k.points[s] = triangulation_.point(s);
    for (const DualFacet& facet : sites_[s].facets) {
      if (facet.sites[1] < s || facet.sites[2] < s) continue;  // added by its smallest site
      k.triangles.push_back(as_mesh_triangle(facet.sites));
      k.t_triangles.push_back(facet.t_triangle);
      k.is_new.push_back(sites_[s].is_new);
    }
  }
  return k;
}

std::size_t CertifiedRecovery::correct_reversed() {
  const DualFacets k = all_facets();
  std::vector<std::uint32_t> component(k.points.size(), kNoId);
  for (SiteId s = 1; s < sites_.size(); ++s) {
    if (sites_[s].at != kNoId) component[s] = contour_.component[sites_[s].at];
  }
  const std::vector<double> bounded = bounded_volumes(k.points, k.triangles, component, origins_);
  std::vector<std::uint8_t> is_reversed(bounded.size(), 0);
  for (const Triangle& t : k.triangles) {
    const std::uint32_t c = component[t[0]];
    is_reversed[c] = origins_[c] && !(bounded[c] * wanted_volumes_[c] > 0);
  }
  std::vector<VertexId> furthest(bounded.size(), kNoId);
  for (VertexId v = 0; v < contour_.points.size(); ++v) {
    const std::uint32_t c = contour_.component[v];
    if (is_reversed[c]) furthest[c] = labels_.further(furthest[c], v);
  }
  return add_sites(furthest, Reason::reversed);
}

std::size_t CertifiedRecovery::add_sites(std::span<const VertexId> vertices, Reason reason) {
  std::size_t added = 0;
  for (const VertexId v : vertices) {
    if (v == kNoId) continue;
    if (follower_) follower_->site_asked(reason, kNoId, v);
    added += add_site(v);
  }
  return added;
}

std::size_t CertifiedRecovery::resolve_crossings() {
  std::vector<VertexId> between = between_crossings(all_facets(), labels_, surface_.volume().box());
  report_[Counter::crossings_handed_over] = between.size();
  sort_unique(between);
  const std::size_t added = add_sites(between, Reason::crossing);
  // If a crossing remains, all facets stay new, so that it is counted again the next time.
  if (added == between.size()) {
    for (Site& s : sites_) s.is_new = false;
  }
  return added;
}

}  // namespace

void make_fine(ContourMesh& contour, const Isosurface& surface, const Parameters& parameters,
               Report& report) {
  begin_stage(parameters.observer, "cutting");
  const StepTimer timer(report.seconds_contour);
  contour = fine_contour(std::move(contour), surface.volume(), surface.kappa());
  report[Counter::voxels_cut] = contour.split_voxels;
}

SurfaceMesh recover(const Isosurface& surface, ContourMesh& contour, FirstSample first,
                    const Parameters& parameters, Report& report) {
  begin_stage(parameters.observer, "labels");
  CertifiedRecovery recovery = timed(report.seconds_labels, [&] {
    return CertifiedRecovery(surface, contour, std::move(first), parameters, report);
  });
  contour.triangles = std::vector<Triangle>();
  SurfaceMesh mesh = recovery.run();
  report.points_recovered = mesh.mesh.points.size();
  return mesh;
}

}  // namespace deliso
