// SPDX-License-Identifier: MIT
#include "support/insertion_cost.h"

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
  explicit Repeater(paper::Sigma& sigma) : sigma_(sigma), pairs_(sigma.volume(), sigma.kappa()) {}

  // Counts the searches of S_0, which are on no clock.
  void follow(const paper::RestrictedDelaunay& restricted) {
    restricted_ = &restricted;
    for_each_facet(restricted.del(), [&](Facet f) { facets_.push_back(f); });
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
    const Triangulation& del = restricted_->del();
    facets_.clear();
    for (const CellId c : restricted_->cells_at(v)) {
      for (int i = 0; i < 4; ++i) {
        if (del.vertex(c, i) == v || c < del.neighbor(c, i)) facets_.push_back({c, i});
      }
    }
    {
      const StepTimer searching(searching_);
      for (const Facet f : facets_) {
        if (const auto r = restricted_->voronoi_edge(f)) sigma_.intersect(*r, counters_);
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
  void count_pairs() {
    SearchCounters not_counted;
    for (const Facet f : facets_) {
      if (const auto r = restricted_->voronoi_edge(f))
        pairs_.count(*r, !sigma_.intersect(*r, not_counted).empty());
    }
  }

  paper::Sigma& sigma_;
  const paper::RestrictedDelaunay* restricted_ = nullptr;
  const TriMesh* mesh_ = nullptr;
  Stopwatch watch_;
  std::size_t insertions_ = 0;
  double observed_ = 0, searching_ = 0;  // seconds in here, and of them in searches
  double since_ = -1, inserting_ = 0;    // an insertion's begin, else -1; seconds of all of them
  PairSearches pairs_;
  SearchCounters counters_;
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
  repeater.follow(s.del());
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
