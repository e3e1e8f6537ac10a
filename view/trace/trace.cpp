// SPDX-License-Identifier: MIT
#include "view/trace/trace.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

namespace deliso {
namespace {

constexpr Vec3 kNowhere{TraceEvent::kNone, TraceEvent::kNone, TraceEvent::kNone};

void append(std::vector<float>& out, const Vec3& p) {
  for (int axis = 0; axis < 3; ++axis) out.push_back(static_cast<float>(p[axis]));
}

template <class Number, std::size_t N>
void append(TraceList<std::uint32_t>& list, const std::vector<std::array<Number, N>>& items) {
  for (const auto& item : items) list.values.insert(list.values.end(), item.begin(), item.end());
  list.begin.push_back(static_cast<std::uint32_t>(list.values.size() / N));
}

std::uint32_t clamped(std::uint64_t n) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(n, kNoId));
}

Triangle rotated(const Triangle& t) {
  const std::size_t first =
      static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
  return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
}

std::vector<Triangle> sorted_triangles(std::span<const std::uint32_t> values) {
  std::vector<Triangle> out;
  for (std::size_t k = 0; k < values.size(); k += 3) {
    out.push_back(rotated({VertexId(values[k]), VertexId(values[k + 1]), VertexId(values[k + 2])}));
  }
  std::sort(out.begin(), out.end());
  return out;
}

bool is_before(const Vec3& p, const Vec3& q) {
  return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
}

}  // namespace

Trace::Trace(std::size_t limit, bool with_times) : limit_(limit), with_times_(with_times) {
  if (with_times_) last_ = Clock::now();
}

VertexId Trace::add_vertex(const Vec3& p) {
  if (is_full()) return kNoId;
  points_.push_back(p);
  append(arrays_.points, p);
  return VertexId(points_.size() - 1);
}

TraceEvent& Trace::asks(std::uint8_t routine, std::uint8_t reason, double value) {
  event_ = {};
  event_.routine = routine;
  event_.reason = reason;
  event_.value = value;
  return event_;
}

void Trace::count(std::uint64_t searches, std::uint64_t computations) {
  searches_ = searches;
  computations_ = computations;
}

std::uint32_t Trace::micros_since_last() {
  if (!with_times_) return 0;
  const Clock::time_point now = Clock::now();
  const auto micros = std::chrono::duration_cast<std::chrono::microseconds>(now - last_);
  last_ += micros;  // what is less than one is the next event's
  return clamped(static_cast<std::uint64_t>(micros.count()));
}

void Trace::record(std::uint8_t outcome) {
  if (events_seen_++ < limit_) append_event(outcome);
  TraceEvent& e = event_;
  e.vertex = kNoId;
  e.place = kNowhere;
  e.removed.clear();
  e.added.clear();
  e.zone.clear();
  e.star.clear();
  e.cone.clear();
  e.relabel.clear();
}

void Trace::append_event(std::uint8_t outcome) {
  const TraceEvent& e = event_;
  TraceArrays& a = arrays_;
  a.routine.push_back(e.routine);
  a.outcome.push_back(outcome);
  a.reason.push_back(e.reason);
  a.value.push_back(static_cast<float>(e.value));
  append(a.place, e.place);
  append(a.edge, e.edge ? e.edge->a : kNowhere);
  append(a.edge, e.edge ? e.edge->b : kNowhere);
  append(a.ball, e.ball ? e.ball->first : kNowhere);
  a.ball.push_back(static_cast<float>(e.ball ? e.ball->second : TraceEvent::kNone));
  a.vertex.push_back(e.vertex);
  a.caller.insert(a.caller.end(), e.caller.begin(), e.caller.end());
  a.micros.push_back(micros_since_last());
  a.searches.push_back(clamped(searches_));
  a.computations.push_back(clamped(computations_));
  a.worst.push_back(static_cast<float>(worst_));
  append(a.removed, e.removed);
  append(a.added, e.added);
  append(a.zone, e.zone);
  append(a.star, e.star);
  append(a.cone, e.cone);
  append(a.relabel, e.relabel);
  for (const Vec3& hit : e.hits) append(a.hits.values, hit);
  a.hits.begin.push_back(static_cast<std::uint32_t>(a.hits.values.size() / 3));
}

void Trace::put_mesh(const TriMesh& mesh, Routine routine) {
  follows_mesh_ = true;
  if (is_full()) {
    ++events_seen_;
    return;
  }
  std::vector<VertexId> by_place(points_.size());
  std::iota(by_place.begin(), by_place.end(), VertexId(0));
  std::sort(by_place.begin(), by_place.end(), [&](VertexId a, VertexId b) {
    return points_[a] == points_[b] ? a < b : is_before(points_[a], points_[b]);
  });
  TraceEvent& e = asks(trace_code(routine), trace_code(Reason::beginning),
                       static_cast<double>(mesh.faces.size()));
  e.removed = complex();
  of_mesh_.clear();
  for (const Vec3& p : mesh.points) {
    const auto at =
        std::lower_bound(by_place.begin(), by_place.end(), p,
                         [&](VertexId v, const Vec3& q) { return is_before(points_[v], q); });
    of_mesh_.push_back(at != by_place.end() && points_[*at] == p ? *at : kNoId);
  }
  for (VertexId v = 0; v < of_mesh_.size(); ++v) {
    if (of_mesh_[v] == kNoId) of_mesh_[v] = add_vertex(mesh.points[v]);
  }
  for (const Face& face : mesh.faces) {
    e.added.push_back({of_mesh_[face.v[0]], of_mesh_[face.v[1]], of_mesh_[face.v[2]]});
  }
  record(TraceOutcome::done);
}

std::vector<Triangle> Trace::complex() const {
  const std::vector<Triangle> added = sorted_triangles(arrays_.added.values);
  const std::vector<Triangle> removed = sorted_triangles(arrays_.removed.values);
  std::vector<Triangle> left;
  std::set_difference(added.begin(), added.end(), removed.begin(), removed.end(),
                      std::back_inserter(left));
  return left;
}

}  // namespace deliso
