// SPDX-License-Identifier: MIT
#include "view/trace/recorder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "refine/refinement.h"
#include "surface/criteria.h"

namespace deliso {

void TraceRecorder::number_mesh(const std::vector<Triangle>& facets, VertexId new_vertex,
                                std::vector<Triangle>& out) const {
  out.clear();
  for (Triangle t : facets) {
    for (VertexId& v : t) v = v == new_vertex ? kNoId : trace_.of_mesh()[v];
    out.push_back(t);
  }
}

void TraceRecorder::update_worst(const std::vector<FaceId>& gone, const std::vector<FaceId>& come) {
  for (const FaceId f : gone) distances_.erase(distances_.find(distance_[f]));
  distance_.resize(mesh_->mesh.faces.size());
  for (const FaceId f : come) {
    const Triangle& v = mesh_->mesh.faces[f].v;
    const Dual& dual = mesh_->duals[f];
    const IdArray<VertexId, Vec3>& p = mesh_->mesh.points;
    const FacetShape shape = measure(p[v[0]], p[v[1]], p[v[2]], dual.center);
    const bool is_small = shape.r <= report_.r_min;
    distance_[f] = is_small ? 0 : dual.on_surface ? shape.h : shape.r;
    distances_.insert(distance_[f]);
  }
  if (!distances_.empty()) trace_.set_worst(*distances_.rbegin());
}

void TraceRecorder::mesh_handed_over(const SurfaceMesh& s) {
  mesh_ = &s;
  std::vector<FaceId> all(s.mesh.faces.size());
  std::iota(all.begin(), all.end(), FaceId(0));
  update_worst({}, all);
  trace_.switch_to(s.mesh);
}

void TraceRecorder::facet_asked(const SurfaceMesh& s, FaceId f, Reason reason, double value) {
  if (!trace_.follows_mesh() || trace_.is_full()) return;
  TraceEvent& event = trace_.asks(trace_code(Routine::count_), trace_code(reason), value);
  for (std::size_t i = 0; i < 3; ++i) event.caller[i] = trace_.of_mesh()[s.mesh.faces[f].v[i]];
  const Dual& dual = s.duals[f];
  if (dual.on_surface) event.ball = {dual.center, std::sqrt(dual.radius2)};
}

void TraceRecorder::operation_tried(Operation operation, const Proposal& proposal,
                                    std::optional<Refusal> refusal) {
  if (!trace_.follows_mesh()) return;
  TraceEvent& event = trace_.event();
  if (!trace_.is_full()) {
    const bool has_vertex = proposal.what != Proposal::Vertex::none;
    if (has_vertex) event.place = proposal.place;
    if (refusal) {
      number_mesh(proposal.was.facets, kNoId, event.star);
      number_mesh(proposal.in.facets, has_vertex ? proposal.vertex : kNoId, event.cone);
    } else {
      number_mesh(proposal.was.facets, kNoId, event.removed);
      if (has_vertex) {
        event.vertex = trace_.add_vertex(proposal.place);
        std::vector<VertexId>& numbers = trace_.of_mesh();
        numbers.resize(std::max<std::size_t>(numbers.size(), proposal.vertex + 1));
        numbers[proposal.vertex] = event.vertex;
      }
      number_mesh(proposal.in.facets, kNoId, event.added);
    }
  }
  if (!refusal) update_worst(proposal.cavity, proposal.created);
  event.routine = trace_code(operation);
  trace_.count(report_.searches_recover.searches + report_.searches_refine.searches,
               report_.searches_recover.computations + report_.searches_refine.computations);
  trace_.record(refusal ? trace_code(*refusal) : trace_code(TraceOutcome::done));
}

}  // namespace deliso
