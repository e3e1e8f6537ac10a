// SPDX-License-Identifier: MIT
#include "recover/recover.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/check.h"
#include "base/parallel.h"
#include "base/sorted_list.h"
#include "contour/block_order.h"
#include "contour/bounded_volume.h"
#include "contour/fine_contour.h"
#include "recover/certificate.h"
#include "recover/dual_crossings.h"
#include "recover/protrusions.h"
#include "stage1/build_tri_mesh.h"
#include "stage1/poles.h"
#include "surface/observer.h"
#include "surface/step_timer.h"
#include "surface/surface_point.h"

namespace deliso {
namespace {

// So many facets, or sites of a round, make a task for a thread.
constexpr std::size_t kFacetsPerTask = 64, kSitesPerTask = 16;

// So many sites are looked at together, those queued last: they lie near each other, and what they
// look at is still in the cache. In any other order a large volume takes up to three times as long.
constexpr std::size_t kSitesPerRound = 256;

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
        labels_(contour, triangulation_, first.kept, parameters.threads),
        certificate_(labels_),
        origins_(component_origins(contour, surface.volume().box())),
        wanted_volumes_(bounded_volumes(contour.points, contour.triangles, contour.component,
                                        origins_, parameters.threads)) {
    // The last one queued is looked at first, and T is ordered block by block.
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
    VertexId at = kNoId;     // of T; kNoId: an auxiliary site
    SiteId seen_by = kNoId;  // the last one that counted it among its neighbors
    bool queued = false;
    bool is_new = false;            // its facets were not tested for crossings since they changed
    bool is_uncertified = false;    // it broke the certificate with nothing left to insert
    std::vector<DualFacet> facets;  // K's there, begun at the site
  };

  void queue_site(SiteId s);
  // Makes the vertex v of T a site; false when it coincides with one.
  bool add_site(VertexId v);
  // Adds sites until every one holds the certificate and misses no protrusion.
  void settle();
  // Adds sites where facets of K cross, by exact predicates: homeomorphic to T is not yet embedded.
  std::size_t part_crossings();
  // And to components that are inside out: four sites on a rod may be either way round.
  std::size_t turn_out();
  // kNoId: none.
  std::size_t add_sites(std::span<const VertexId> vertices, Reason reason);
  DualFacets all_facets() const;
  SurfaceMesh dual();

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
  const std::vector<double> wanted_volumes_;        // those that T bounds, for their signs
  std::vector<SiteId> queue_;  // to be looked at
  ConflictZone zone_;
  std::vector<CellId> created_;
  std::vector<SiteId> neighbors_;
};

SurfaceMesh CertifiedRecovery::run() {
  const StepTimer timer(report_.seconds_recover);
  begin_stage(parameters_.observer, "recover");
  do {
    settle();
  } while (part_crossings() > 0 || turn_out() > 0);
  for (const Site& s : sites_) report_[Counter::uncertified_sites] += s.is_uncertified;
  if (follower_) follower_->recovery_finished();
  return dual();
}

SurfaceMesh CertifiedRecovery::dual() {
  const std::vector<double> poles = compute_poles(triangulation_, surface_, parameters_, report_);
  DualFacets k = all_facets();
  std::vector<Dual> duals(k.triangles.size());
  std::vector<SearchCounters> searches(runs_of(k.triangles.size(), kFacetsPerTask));
  for_each_run(parameters_.threads, k.triangles.size(), kFacetsPerTask,
               [&](std::size_t run, std::size_t f, std::size_t end) {
                 SurfacePointFinder finder(surface_);
                 for (; f < end; ++f) {
                   const Triangle& v = k.triangles[f];
                   duals[f] =
                       finder.dual(k.points[v[0]], k.points[v[1]], k.points[v[2]], searches[run]);
                 }
               });
  for (const SearchCounters& n : searches) report_.searches_recover += n;
  for (const Dual& d : duals) report_[Counter::unready_facets] += !d.on_surface;
  return build_tri_mesh(triangulation_, std::move(k.triangles), std::move(duals), chain_, poles);
}

void CertifiedRecovery::queue_site(SiteId s) {
  if (sites_[s].queued || sites_[s].at == kNoId) return;
  sites_[s].queued = true;
  queue_.push_back(s);
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

// Round by round: what all sites of one say is found out first, in threads, since nothing changes
// meanwhile. Then sites are added one by one; where one of these has changed a site, what that one
// said is out of date, and it says it again in the next round.
void CertifiedRecovery::settle() {
  std::vector<SiteId> round;
  std::vector<Verdict> verdicts(kSitesPerRound);
  while (!queue_.empty()) {
    const std::size_t size = std::min(queue_.size(), kSitesPerRound);
    round.assign(queue_.rbegin(), queue_.rbegin() + static_cast<std::ptrdiff_t>(size));
    queue_.resize(queue_.size() - size);
    for (const SiteId s : round) sites_[s].queued = false;
    for_each_run(
        parameters_.threads, round.size(), kSitesPerTask, [&](std::size_t n, std::size_t end) {
          Certificate::Scratch scratch;
          for (; n < end; ++n) {
            const SiteId s = round[n];
            Site& site = sites_[s];
            Verdict& verdict = verdicts[n];
            verdict = certificate_.check(s, site.at, scratch, site.facets);
            if (!verdict.violation) {
              verdict.insert = find_protrusion(s, site.facets, labels_, surface_, parameters_);
            }
            site.is_new = true;
            site.is_uncertified = false;
          }
        });
    for (std::size_t n = 0; n < round.size(); ++n) {
      steps_.step(round.size() - n + queue_.size());
      const SiteId s = round[n];
      const Verdict verdict = verdicts[n];
      if (sites_[s].queued || verdict.is_fine()) continue;
      const Reason reason = verdict.violation.value_or(Reason::protrusion);
      if (follower_) follower_->site_asked(reason, s, verdict.insert);
      if (verdict.insert != kNoId && add_site(verdict.insert)) {
        queue_site(s);
      } else if (verdict.violation) {
        sites_[s].is_uncertified = true;
      }
    }
  }
}

DualFacets CertifiedRecovery::all_facets() const {
  DualFacets k;
  k.points.resize(sites_.size());
  for (SiteId s = 1; s < sites_.size(); ++s) {
    k.points[s] = triangulation_.point(s);
    for (const DualFacet& facet : sites_[s].facets) {
      if (facet.sites[1] < s || facet.sites[2] < s) continue;  // told by its smallest site
      k.triangles.push_back(as_mesh_triangle(facet.sites));
      k.witnesses.push_back(facet.witness);
      k.is_new.push_back(sites_[s].is_new);
    }
  }
  return k;
}

std::size_t CertifiedRecovery::turn_out() {
  const DualFacets k = all_facets();
  std::vector<std::uint32_t> component(k.points.size(), kNoId);
  for (SiteId s = 1; s < sites_.size(); ++s) {
    if (sites_[s].at != kNoId) component[s] = contour_.component[sites_[s].at];
  }
  const std::vector<double> bounded = bounded_volumes(k.points, k.triangles, component, origins_);
  std::vector<std::uint8_t> is_turned(bounded.size(), 0);
  for (const Triangle& t : k.triangles) {
    const std::uint32_t c = component[t[0]];
    is_turned[c] = origins_[c] && !(bounded[c] * wanted_volumes_[c] > 0);
  }
  std::vector<VertexId> furthest(bounded.size(), kNoId);
  for (VertexId v = 0; v < contour_.points.size(); ++v) {
    const std::uint32_t c = contour_.component[v];
    if (is_turned[c]) furthest[c] = labels_.further(furthest[c], v);
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

std::size_t CertifiedRecovery::part_crossings() {
  std::vector<VertexId> between =
      between_crossings(all_facets(), labels_, surface_.volume().box(), parameters_.threads);
  report_[Counter::crossings_handed_over] = between.size();
  sort_unique(between);
  const std::size_t added = add_sites(between, Reason::crossing);
  // Pairs that could not be parted are counted again the next time.
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
  contour = fine_contour(std::move(contour), surface.volume(), surface.kappa(), parameters.threads);
  order_by_blocks(contour, surface.volume(), parameters.threads);
  report[Counter::voxels_cut] = contour.split_voxels;
}

SurfaceMesh recover(const Isosurface& surface, ContourMesh& contour, FirstSample first,
                    const Parameters& parameters, Report& report) {
  begin_stage(parameters.observer, "labels");
  std::optional<StepTimer> timer(report.seconds_labels);
  CertifiedRecovery recovery(surface, contour, std::move(first), parameters, report);
  contour.triangles = std::vector<Triangle>();
  timer.reset();
  SurfaceMesh mesh = recovery.run();
  report.points_recovered = mesh.mesh.points.size();
  return mesh;
}

}  // namespace deliso
