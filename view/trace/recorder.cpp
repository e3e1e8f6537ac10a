// SPDX-License-Identifier: MIT
#include "view/trace/recorder.h"

#include <algorithm>
#include <cmath>

#include "base/sorted_list.h"
#include "base/triangle.h"
#include "delaunay/voronoi.h"
#include "refine/refinement.h"
#include "run/parameters.h"

namespace deliso {

void TraceRecorder::run_begins(const Parameters& parameters, const Report& report) {
  Recording::run_begins(report.searches_coarsen, report.searches_refine, parameters.r_min);
}

void TraceRecorder::contour_ready(const SurfaceMesh& t) {
  target().put_mesh(t.mesh, Routine::contour);
}

void TraceRecorder::coarsening_begins(const SurfaceMesh& t) {
  end_coarsening_event();
  if (!told_.empty()) target().put_mesh(t.mesh, Routine::contour);  // again
  mesh_ = &t;
  removals_per_event_ = 1 + t.mesh.points.size() / kMostRemovals;
  now_.clear();
  told_.clear();
  for (const Face& face : t.mesh.faces) {
    now_.push_back(face.v);
    told_.push_back(number(face.v));
  }
}

Triangle TraceRecorder::number(Triangle t) const {
  for (VertexId& v : t)
    v = v == kNoId || target().is_full() ? VertexId(kNoId) : target().of_mesh()[v];
  return t;
}

void TraceRecorder::coarsened(Operation operation, VertexId v, std::span<const FaceId> facets) {
  if (operation != operation_) {
    end_coarsening_event();
    operation_ = operation;
    const auto begin = [&](Routine routine, std::uint8_t reason) {
      target().asks(trace_code(routine), reason);
    };
    if (operation == Operation::removal)
      begin(Routine::remove_vertices, trace_code(Reason::unneeded));
    if (operation == Operation::move)
      begin(Routine::move_vertices, trace_code(PaperReason::off_the_middle));
    if (operation == Operation::flip)
      begin(Routine::flip_edges, trace_code(PaperReason::wide_angles));
  }
  for (const FaceId f : facets) {
    const Face& face = mesh_->mesh.faces[f];
    now_[f] = is_dead(face) ? Triangle{kNoId, kNoId, kNoId} : face.v;
    touched_.push_back(f);
  }
  if (operation == Operation::move) moved_.emplace_back(v, mesh_->mesh.points[v]);
  if (operation != Operation::removal) return;
  TraceEvent& event = target().event();
  event.place = mesh_->mesh.points[v];
  if (!target().is_full()) event.caller[0] = target().of_mesh()[v];
  if (++removals_ == removals_per_event_) end_coarsening_event();
}

void TraceRecorder::end_coarsening_event() {
  if (operation_ == Operation::count_) return;
  if (!target().is_full()) {
    TraceEvent& event = target().event();
    for (const auto& [v, place] : moved_) target().of_mesh()[v] = target().add_vertex(place);
    sort_unique(touched_);
    for (const FaceId f : touched_) {
      const Triangle now = number(now_[f]);
      if (now == told_[f]) continue;
      if (told_[f][0] != kNoId) event.removed.push_back(told_[f]);
      if (now[0] != kNoId) event.added.push_back(now);
      told_[f] = now;
    }
  }
  record(TraceOutcome::done);
  operation_ = Operation::count_;
  removals_ = 0;
  touched_.clear();
  moved_.clear();
}

void TraceRecorder::number_mesh(const std::vector<Triangle>& facets, VertexId new_vertex,
                                std::vector<Triangle>& out) const {
  out.clear();
  for (Triangle t : facets) {
    for (VertexId& v : t) v = v == new_vertex ? kNoId : target().of_mesh()[v];
    out.push_back(t);
  }
}

void TraceRecorder::mesh_handed_over(const SurfaceMesh& s) {
  end_coarsening_event();
  mesh_ = &s;
  mesh_begins(s.mesh, Routine::coarsen, [&s](FaceId f) {
    const Dual& dual = s.duals[f];
    return dual.on_surface ? std::optional(dual.center) : std::nullopt;
  });
}

void TraceRecorder::tell_question(const Question& question, Operation operation) {
  TraceEvent& event =
      target().asks(trace_code(operation), trace_code(question.reason), question.value);
  for (std::size_t i = 0; i < 3; ++i) {
    const VertexId v = question.corners[i];
    if (v != kNoId) event.caller[i] = target().of_mesh()[v];
  }
  const Dual& dual = question.dual;
  if (dual.on_surface) event.ball = {dual.center, std::sqrt(dual.radius2)};
}

std::optional<Segment> TraceRecorder::culprit(const Replacement& c, Refusal refusal) const {
  const TriMesh& mesh = mesh_->mesh;
  const Proposal& proposal = c.proposal;
  const auto at = [&](VertexId v) {
    return proposal.what != Proposal::Vertex::none && v == proposal.vertex ? proposal.place
                                                                           : mesh.points[v];
  };
  if (refusal == Refusal::no_surface_point && !c.duals.empty()) {
    const Triangle& v = c.in().facets[c.duals.size() - 1];
    const Vec3 p = at(v[0]), q = at(v[1]), r = at(v[2]);
    const FacetLine line = facet_line(p, q, r);
    const double longest = std::sqrt(std::max({distance2(p, q), distance2(q, r), distance2(r, p)}));
    const Vec3 reach = std::min(line.radius, longest) * line.normal;
    return Segment{line.center - reach, line.center + reach};
  }
  if (refusal != Refusal::turned) return std::nullopt;
  // The new facets, then those around the cavity, which keep their places.
  std::vector<Triangle> facets = c.in().facets;
  for (const FaceId f : c.cavity.facets) {
    for (const FaceId g : mesh.faces[f].n) {
      if (g != kNoId && std::ranges::find(c.cavity.facets, g) == c.cavity.facets.end()) {
        facets.push_back(mesh.faces[g].v);
      }
    }
  }
  const auto normal = [&](const Triangle& v) {
    const Vec3 n = area_normal(at(v[0]), at(v[1]), at(v[2]));
    return n / length(n);
  };
  double least = proposal.gates.least_cosine;
  std::optional<Segment> sharpest;
  for (std::size_t f = 0; f < c.in().facets.size(); ++f) {
    for (std::size_t g = f + 1; g < facets.size(); ++g) {
      for (std::size_t side = 0; side < 3; ++side) {
        const VertexId a = facets[f][side], b = facets[f][(side + 1) % 3];
        const Triangle& other = facets[g];
        bool is_across = false;
        for (std::size_t i = 0; i < 3; ++i) {
          is_across = is_across || (other[i] == b && other[(i + 1) % 3] == a);
        }
        if (!is_across) continue;
        const double cosine = dot(normal(facets[f]), normal(other));
        if (cosine >= least) continue;
        least = cosine;
        sharpest = Segment{at(a), at(b)};
      }
    }
  }
  return sharpest;
}

void TraceRecorder::operation_tried(const Question& question, Operation operation,
                                    const Replacement& replacement,
                                    std::optional<Refusal> refusal) {
  if (!target().follows_mesh()) return;
  if (!target().is_full()) {
    tell_question(question, operation);
    TraceEvent& event = target().event();
    const Proposal& proposal = replacement.proposal;
    const std::vector<Triangle>& removed = replacement.cavity.disk.facets;
    const std::vector<Triangle>& added = replacement.in().facets;
    const bool has_vertex = proposal.what != Proposal::Vertex::none;
    if (has_vertex) event.place = proposal.place;
    event.edge = refusal ? culprit(replacement, *refusal) : std::nullopt;
    if (refusal) {
      number_mesh(removed, kNoId, event.star);
      number_mesh(added, has_vertex ? proposal.vertex : kNoId, event.cone);
    } else {
      number_mesh(removed, kNoId, event.removed);
      if (has_vertex) {
        event.vertex = target().add_vertex(proposal.place);
        std::vector<VertexId>& numbers = target().of_mesh();
        numbers.resize(std::max<std::size_t>(numbers.size(), proposal.vertex + 1));
        numbers[proposal.vertex] = event.vertex;
      }
      number_mesh(added, kNoId, event.added);
    }
  }
  if (!refusal) update_worst(replacement.cavity.facets, replacement.created);
  record(refusal ? trace_code(*refusal) : trace_code(TraceOutcome::done));
}

}  // namespace deliso
