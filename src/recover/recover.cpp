// SPDX-License-Identifier: MIT
#include "recover/recover.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "base/check.h"
#include "base/parallel.h"
#include "base/sorted_list.h"
#include "contour/block_order.h"
#include "contour/bounded_volume.h"
#include "contour/fine_contour.h"
#include "recover/certificate.h"
#include "recover/dual_crossings.h"
#include "recover/protrusions.h"
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

// Where nothing is violated a protrusion is to be inserted.
Reason reason_of(Violation violation) {
  constexpr std::array reasons{Reason::protrusion, Reason::region, Reason::interface,
                               Reason::triple, Reason::boundary};
  return reasons[static_cast<std::size_t>(violation)];
}

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
        contour_vertex_(std::move(first.contour_vertex)),
        site_(contour.points.size(), kNoId),
        graph_(contour, parameters.threads),
        labels_(contour, triangulation_, kept_components(contour, parameters), parameters.threads),
        certificate_(contour, graph_, labels_),
        origins_(component_origins(contour, surface.volume().box())),
        bounded_(bounded_volumes(contour.points, contour.triangles, contour.component, origins_,
                                 parameters.threads)) {
    for (SiteId s = 1; s < contour_vertex_.size(); ++s) {
      if (contour_vertex_[s] != kNoId) site_[contour_vertex_[s]] = s;
    }
    // The last one queued is looked at first, and T is ordered block by block.
    for (auto s = site_.rbegin(); s != site_.rend(); ++s) {
      if (*s != kNoId) queue_site(*s);
    }
    if (follower_) {
      follower_->labels_ready({contour, graph_, labels_, triangulation_, surface.volume().box()});
    }
  }

  SurfaceMesh run();

 private:
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
  IdArray<SiteId, VertexId> contour_vertex_;  // of every site
  IdArray<VertexId, SiteId> site_;            // of every vertex of T; kNoId: it is none
  ContourGraph graph_;
  Labels labels_;
  Certificate certificate_;
  // What T's components bound, and seen from where.
  std::vector<std::optional<Vec3>> origins_;
  std::vector<double> bounded_;

  // Sites to be looked at in the next round, and those of the round at hand.
  std::vector<SiteId> queue_, round_;
  std::vector<Verdict> verdicts_;  // one per site of the round
  IdArray<SiteId, std::uint8_t> queued_;
  // Per site, whether its facets have not been tested for crossings since they changed, and whether
  // it broke the certificate with nothing left to insert when it was last looked at.
  IdArray<SiteId, std::uint8_t> is_new_, is_uncertified_;
  // K's facets at every site, begun there.
  IdArray<SiteId, std::vector<DualFacet>> facets_;

  ConflictZone zone_;
  std::vector<CellId> created_;
  std::vector<SiteId> neighbors_, changed_;
};

SurfaceMesh CertifiedRecovery::run() {
  const StepTimer timer(report_.seconds_recover);
  begin_stage(parameters_.observer, "recover");
  do {
    settle();
  } while (part_crossings() > 0 || turn_out() > 0);
  for (const std::uint8_t is : is_uncertified_) report_[Counter::uncertified_sites] += is;
  if (follower_) follower_->recovery_finished();
  return dual();
}

SurfaceMesh CertifiedRecovery::dual() {
  std::vector<double> poles;
  if (parameters_.asks_for_poles()) poles = compute_poles(triangulation_, surface_, report_);
  SurfaceMesh out;
  std::vector<VertexId> new_id(triangulation_.vertex_capacity(), kNoId);  // by the site's number
  DualFacets k = all_facets();
  out.duals.resize(k.triangles.size());
  std::vector<SearchCounters> searches(runs_of(k.triangles.size(), kFacetsPerTask));
  for_each_run(parameters_.threads, k.triangles.size(), kFacetsPerTask,
               [&](std::size_t run, std::size_t begin, std::size_t end) {
                 SurfacePointFinder finder(surface_);
                 for (FaceId f(begin); f < end; ++f) {
                   const Triangle& v = k.triangles[f];
                   out.duals[f] =
                       finder.dual(k.points[v[0]], k.points[v[1]], k.points[v[2]], searches[run]);
                 }
               });
  for (const SearchCounters& n : searches) report_.searches_recover += n;
  for (const Dual& d : out.duals) report_[Counter::unready_facets] += !d.on_surface;
  for (Triangle& v : k.triangles) {
    for (VertexId& q : v) {
      if (new_id[q] == kNoId) {
        new_id[q] = VertexId(out.mesh.points.size());
        out.mesh.points.push_back(k.points[q]);
        if (!poles.empty()) out.pole_heights.push_back(poles[q]);
      }
      q = new_id[q];
    }
  }
  out.mesh = make_tri_mesh(std::move(out.mesh.points), k.triangles);
  out.chain = chain_.renumbered(new_id);
  return out;
}

void CertifiedRecovery::queue_site(SiteId s) {
  if (s >= queued_.size()) {
    queued_.resize(s + 1, 0);
    is_new_.resize(s + 1, 0);
    is_uncertified_.resize(s + 1, 0);
    facets_.resize(s + 1);
  }
  if (queued_[s] || contour_vertex_[s] == kNoId) return;
  queued_[s] = 1;
  queue_.push_back(s);
}

bool CertifiedRecovery::add_site(VertexId v) {
  const Vec3& p = contour_.points[v];
  triangulation_.find_conflicts(p, triangulation_.incident_cell(labels_.label(v)), zone_);
  if (zone_.duplicate != kNoId) return false;
  if (follower_) follower_->insertion_begins(p, zone_);
  const SiteId s = triangulation_.insert_in_zone(p, zone_, created_);
  if (triangulation_.vertex_capacity() > parameters_.max_vertices) {
    throw InputError("more than --max-vertices " + std::to_string(parameters_.max_vertices) +
                     " vertices needed before the surface is recovered");
  }
  site_[v] = s;
  contour_vertex_.push_back(v);
  DELISO_ASSERT(contour_vertex_.size() == s + 1);
  neighbors_.clear();
  for (const CellId c : created_) {
    for (const SiteId n : triangulation_.vertices(c)) {
      if (n != s && n != Triangulation::kInfinite) neighbors_.push_back(n);
    }
  }
  sort_out(neighbors_);
  changed_.clear();
  labels_.add_site(s, triangulation_, neighbors_, changed_);
  queue_site(s);
  for (const SiteId n : changed_) queue_site(n);
  // Whoever borders on what changed hands sees another neighbour there now.
  for (const VertexId u : labels_.region(s)) {
    for (const VertexId w : graph_.ring(u)) {
      if (labels_.label(w) != s) queue_site(labels_.label(w));
    }
  }
  if (contour_.on_boundary(v)) {
    VertexId before = graph_.chain_previous(v);
    while (site_[before] == kNoId) before = graph_.chain_previous(before);
    chain_.insert_after(site_[before], s, graph_.chain_place(v));
    ++report_[Counter::boundary_splits_recover];
  }
  if (follower_) follower_->site_added(s);
  return true;
}

// Round by round: what all sites of one say is found out first, in threads, since nothing changes
// meanwhile. Then sites are added one by one; where one of these has changed a site, what that one
// said is out of date, and it says it again in the next round.
void CertifiedRecovery::settle() {
  while (!queue_.empty()) {
    const std::size_t size = std::min(queue_.size(), kSitesPerRound);
    round_.assign(queue_.rbegin(), queue_.rbegin() + static_cast<std::ptrdiff_t>(size));
    queue_.resize(queue_.size() - size);
    for (const SiteId s : round_) queued_[s] = 0;
    verdicts_.resize(size);
    certificate_.begin_round();
    for_each_run(
        parameters_.threads, round_.size(), kSitesPerTask, [&](std::size_t n, std::size_t end) {
          Certificate::Scratch scratch;
          ProtrusionSearch protrusions(contour_, labels_, triangulation_, surface_, parameters_);
          for (; n < end; ++n) {
            const SiteId s = round_[n];
            Verdict& verdict = verdicts_[n];
            verdict = certificate_.check(s, contour_vertex_[s], scratch, facets_[s]);
            if (verdict.violation == Violation::none) {
              verdict.insert = protrusions.find(s, facets_[s]);
            }
            is_new_[s] = 1;
            is_uncertified_[s] = 0;
          }
        });
    for (std::size_t n = 0; n < round_.size(); ++n) {
      steps_.step(round_.size() - n + queue_.size());
      const SiteId s = round_[n];
      const Verdict verdict = verdicts_[n];
      if (queued_[s] || verdict.is_fine()) continue;
      if (follower_) follower_->site_asked(reason_of(verdict.violation), s, verdict.insert);
      if (verdict.insert != kNoId && add_site(verdict.insert)) {
        queue_site(s);
      } else if (verdict.violation != Violation::none) {
        is_uncertified_[s] = 1;
      }
    }
  }
}

DualFacets CertifiedRecovery::all_facets() const {
  DualFacets k;
  k.points.resize(facets_.size());
  for (SiteId s = 1; s < facets_.size(); ++s) {
    k.points[s] = triangulation_.point(s);
    for (const DualFacet& facet : facets_[s]) {
      if (facet.sites[1] < s || facet.sites[2] < s) continue;  // told by its smallest site
      k.triangles.push_back(as_mesh_triangle(facet.sites));
      k.witnesses.push_back(facet.witness);
      k.is_new.push_back(is_new_[s]);
    }
  }
  return k;
}

std::size_t CertifiedRecovery::turn_out() {
  const DualFacets k = all_facets();
  std::vector<std::uint32_t> component(k.points.size(), kNoId);
  for (SiteId s = 1; s < contour_vertex_.size(); ++s) {
    if (contour_vertex_[s] != kNoId) component[s] = contour_.component[contour_vertex_[s]];
  }
  const std::vector<double> bounded = bounded_volumes(k.points, k.triangles, component, origins_);
  std::vector<std::uint8_t> is_turned(bounded.size(), 0);
  for (const Triangle& t : k.triangles) {
    const std::uint32_t c = component[t[0]];
    is_turned[c] = origins_[c] && !(bounded[c] * bounded_[c] > 0);
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
  sort_out(between);
  const std::size_t added = add_sites(between, Reason::crossing);
  // Pairs that could not be parted are counted again the next time.
  if (added == between.size()) std::fill(is_new_.begin(), is_new_.end(), 0);
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

SurfaceMesh recover(const Isosurface& surface, const ContourMesh& contour, FirstSample first,
                    const Parameters& parameters, Report& report) {
  begin_stage(parameters.observer, "labels");
  std::optional<StepTimer> timer(report.seconds_labels);
  CertifiedRecovery recovery(surface, contour, std::move(first), parameters, report);
  timer.reset();
  SurfaceMesh mesh = recovery.run();
  report.points_recovered = mesh.mesh.points.size();
  report.insertions_recover =
      report.points_recovered - std::min(report.points_recovered, report.points_initial);
  return mesh;
}

}  // namespace deliso
