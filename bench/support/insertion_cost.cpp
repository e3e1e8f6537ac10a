// SPDX-License-Identifier: MIT
#include "support/insertion_cost.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/stopwatch.h"
#include "delaunay/voronoi.h"
#include "paper/deliso.h"
#include "paper/observer.h"
#include "paper/poles.h"
#include "paper/refine.h"
#include "support/pair_searches.h"

namespace deliso {
namespace {

// Repeats the searches of RestrictedDelaunay::insert and of Refine's cones.
class Repeater : public paper::Observer {
 public:
  explicit Repeater(paper::Sigma& sigma)
      : sigma_(sigma), box_(sigma.volume().box()), pairs_(sigma.volume(), sigma.kappa()) {}

  // Counts the searches of S_0, which are on no clock.
  void follow(const Triangulation& del) {
    del_ = &del;
    for_each_facet(del, [&](Facet f) {
      if (!has_infinite_vertex(del, f)) facets_.push_back(f);
    });
    count_pairs();
  }
  const SearchCounters& by_pairs() const { return pairs_.counters(); }
  void mesh_ready(const paper::SurfaceMesh& t) override {
    mesh_ = &t.mesh;
    begin();
  }
  // Begins a stage. Its insertions are counted from here on.
  void begin() {
    insertions_ = 0;
    observed_ = searching_ = inserting_ = 0;
    counters_ = {};
    watch_ = {};
  }
  InsertionCost cost() const {
    const auto n = static_cast<double>(insertions_);
    const double as_without = watch_.seconds() - observed_;
    return {static_cast<double>(counters_.searches) / n, searching_ / n,
            (as_without - searching_) / n, inserting_ / n};
  }

  void asks(paper::Reason, Facet, SiteId, double, const Vec3&) override {
    since_ = watch_.seconds();
  }
  // Nobody asks for a point beside a vertex without facets.
  void insertion_begins(const Vec3&, const ConflictZone&) override {
    if (since_ < 0) since_ = watch_.seconds();
  }
  void site_added(SiteId v) override {
    inserting_ += watch_.seconds() - std::exchange(since_, -1);
    const StepTimer observed(observed_);
    ++insertions_;
    new_cells_.assign(1, del_->incident_cell(v));
    facets_.clear();
    for (std::size_t n = 0; n < new_cells_.size(); ++n) {
      const CellId c = new_cells_[n];
      for (int i = 0; i < 4; ++i) {
        const CellId d = del_->neighbor(c, i);
        const bool is_inner = del_->vertex(c, i) != v;
        if (is_inner && std::ranges::find(new_cells_, d) == new_cells_.end()) {
          new_cells_.push_back(d);
        }
        if ((!is_inner || c < d) && !has_infinite_vertex(*del_, {c, i})) facets_.push_back({c, i});
      }
    }
    {
      const StepTimer searching(searching_);
      for (const Facet f : facets_) {
        if (const auto r = edge_of(f)) sigma_.intersect(*r, counters_);
      }
    }
    count_pairs();
  }
  void cone_added(VertexId /*v*/, std::span<const FaceId> cone) override {
    const StepTimer observed(observed_);
    ++insertions_;
    const StepTimer searching(searching_);
    for (const FaceId f : cone) {
      const Triangle& v = mesh_->faces[f].v;
      const FacetLine line =
          facet_line(mesh_->points[v[0]], mesh_->points[v[1]], mesh_->points[v[2]]);
      sigma_.nearest(line.center, line.normal, line.radius, counters_);
    }
  }

 private:
  std::optional<Segment> edge_of(Facet f) const {
    const FacetDual edge = facet_dual(*del_, f);
    const Range t = clip(edge.center, edge.normal, {edge.t_lo, edge.t_hi}, box_);
    if (!(t.lo < t.hi)) return {};
    return Segment{edge.at(t.lo), edge.at(t.hi)};
  }
  void count_pairs() {
    SearchCounters not_counted;
    for (const Facet f : facets_) {
      if (const auto r = edge_of(f)) pairs_.count(*r, !sigma_.intersect(*r, not_counted).empty());
    }
  }

  paper::Sigma& sigma_;
  Box3 box_;
  const Triangulation* del_ = nullptr;
  const TriMesh* mesh_ = nullptr;
  Stopwatch watch_;
  std::size_t insertions_ = 0;
  double observed_ = 0, searching_ = 0;  // seconds in here, and of them in searches
  double since_ = -1, inserting_ = 0;    // an insertion's begin, else -1; seconds of all of them
  PairSearches pairs_;
  SearchCounters counters_;
  std::vector<CellId> new_cells_;
  std::vector<Facet> facets_;
};

}  // namespace

InsertionCosts measure_insertions(const OpenedDataset& opened, paper::Options options) {
  paper::Report report;
  report.kappa = geometric_isovalue(opened.volume.type(), opened.isovalue);
  report.r_min = options.r_min * opened.volume.box().smallest_side();
  const VoxelTree tree(opened.volume);
  paper::Sigma sigma(tree, report.kappa, options.solver);
  // Its searches must not disturb the hits that the run reads.
  paper::Sigma another(tree, report.kappa, options.solver);
  Repeater repeater(another);
  options.observer = &repeater;

  InsertionCosts costs;
  paper::Recovery s = paper::init_triangulation(sigma, options, report);
  repeater.follow(s.del().del());
  repeater.begin();
  s.recover();
  costs.recover = repeater.cost();
  costs.by_pairs = repeater.by_pairs();
  const std::vector<double> poles = paper::compute_poles(s.del().del(), sigma);
  paper::SurfaceMesh t = paper::build_tri_mesh(s.del(), poles);
  repeater.mesh_ready(t);
  paper::refine_geom(t, sigma, options, report);
  costs.refine = repeater.cost();
  return costs;
}

}  // namespace deliso
