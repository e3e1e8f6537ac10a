// SPDX-License-Identifier: MIT
#include "view/trace/recording.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "run/criteria.h"

namespace deliso {

void Recording::run_begins(const SearchCounters& recover, const SearchCounters& refine,
                           double r_min) {
  recover_ = &recover;
  refine_ = &refine;
  r_min_ = r_min;
}

void Recording::sites_begin(const Triangulation& del, const Box3& domain) {
  del_ = &del;
  domain_ = domain;
  numbers_.emplace_back(kNoId);  // the infinite vertex
  number_sites();
}

void Recording::number_sites() {
  for (auto v = SiteId(numbers_.size()); v < del_->vertex_capacity(); ++v) {
    const Vec3& p = del_->point(v);
    numbers_.push_back(is_auxiliary(p, domain_) ? VertexId(kNoId) : trace_.add_vertex(p));
  }
}

bool Recording::is_told(CellId c) const {
  return std::ranges::none_of(del_->vertices(c), [&](SiteId q) { return number(q) == kNoId; });
}

void Recording::tell_zone(const Vec3& p, const ConflictZone& zone) {
  TraceEvent& event = trace_.event();
  event.place = p;
  for (const CellId c : zone.cells) {
    if (!is_told(c)) continue;
    const auto& v = del_->vertices(c);
    event.zone.push_back({number(v[0]), number(v[1]), number(v[2]), number(v[3])});
  }
}

void Recording::tell_cells() {
  if (trace_.is_full()) return;
  for (CellId c = 0; c < del_->cell_capacity(); ++c) {
    if (!del_->is_live(c) || !is_told(c)) continue;
    for (const SiteId v : del_->vertices(c)) trace_.arrays().tets.push_back(number(v));
  }
}

void Recording::mesh_begins(const TriMesh& mesh, Routine routine, SurfacePoint x) {
  mesh_ = &mesh;
  surface_point_ = std::move(x);
  std::vector<FaceId> all(mesh.faces.size());
  std::iota(all.begin(), all.end(), FaceId(0));
  update_worst({}, all);
  count_searches();  // those so far are Stage 1's
  trace_.put_mesh(mesh, routine);
}

void Recording::update_worst(std::span<const FaceId> gone, std::span<const FaceId> come) {
  for (const FaceId f : gone) distances_.erase(distances_.find(distance_[f]));
  distance_.resize(mesh_->faces.size());
  for (const FaceId f : come) {
    const Triangle& v = mesh_->faces[f].v;
    const IdArray<VertexId, Vec3>& p = mesh_->points;
    const std::optional<Vec3> x = surface_point_(f);
    const FacetShape shape = measure(p[v[0]], p[v[1]], p[v[2]], x.value_or(Vec3{}));
    distance_[f] = shape.r <= r_min_ ? 0 : x ? shape.h : shape.r;
    distances_.insert(distance_[f]);
  }
  if (!distances_.empty()) trace_.set_worst(*distances_.rbegin());
}

void Recording::count_searches() {
  SearchCounters searches = *recover_;
  searches += *refine_;
  trace_.count(searches.searches, searches.computations);
}

void Recording::record(std::uint8_t outcome) {
  count_searches();
  trace_.record(outcome);
}

}  // namespace deliso
