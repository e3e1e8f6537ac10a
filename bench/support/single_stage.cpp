// SPDX-License-Identifier: MIT
#include "support/single_stage.h"

#include "paper/poles.h"

namespace deliso {
namespace {

using paper::RestrictedDelaunay;

// The pole heights of all sites, kept while sites are added.
class Poles : public paper::Observer {
 public:
  void sample_ready(const RestrictedDelaunay& del, const paper::Report&) override { del_ = &del; }
  void begin(std::vector<double> heights) { heights_ = std::move(heights); }
  void site_added(SiteId v) override;
  double mean(const SiteTriangle& v) const {
    return (heights_[v[0]] + heights_[v[1]] + heights_[v[2]]) / 3;
  }

 private:
  const RestrictedDelaunay* del_ = nullptr;
  std::vector<double> heights_;  // by site; empty: Recover goes on
  std::vector<Facet> star_;
};

void Poles::site_added(SiteId v) {
  if (heights_.empty()) return;
  del_->star(v, star_);
  double sum = 0, count = 0;
  for (const Facet f : star_) {
    for (const SiteId q : facet_vertices(del_->del(), f)) {
      if (q == v) continue;
      sum += heights_[q];
      ++count;
    }
  }
  heights_.push_back(count > 0 ? sum / count : 0);
}

}  // namespace

TriMesh single_stage_deliso(const Volume& volume, double isovalue, const paper::Options& options,
                            paper::Report& report) {
  const StepTimer total(report.seconds_total);
  const VoxelTree tree = paper::begin_run(volume, isovalue, options, report);
  paper::Sigma sigma(tree, report.kappa, options.solver);
  Poles poles;
  paper::Options own = options;
  own.observer = &poles;
  paper::Recovery s = paper::init_triangulation(sigma, own, report);
  poles.sample_ready(s.del(), report);
  s.recover();
  poles.begin(compute_poles(s.del().del(), sigma));
  const std::size_t recovered = report.insertions_recover;
  s.approximate_geom(options.epsilon1, [&](const SiteTriangle& v) { return poles.mean(v); });
  s.extract_manifold();
  report.insertions_refine = report.insertions_recover - recovered;
  report.insertions_recover = recovered;
  return finish(build_tri_mesh(s.del(), {}), sigma, options, report);
}

}  // namespace deliso
