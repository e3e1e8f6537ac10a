// SPDX-License-Identifier: MIT
// Records Stage 1 by labels of T: why a vertex of T becomes a site, the vertices of T in its
// region, and the facets of K that are removed and added.
#include <cmath>

#include "view/trace/recording.h"

namespace deliso {
namespace {

// Three regions meet there.
bool is_dual(const SiteTriangle& labels) {
  return labels[0] != labels[1] && labels[1] != labels[2] && labels[2] != labels[0];
}

}  // namespace

void Recording::labels_begin(const Labels& labels, const Box3& domain) {
  labels_ = &labels;
  label_ = labels.all();
  sites_begin(labels.triangulation(), domain);
  const ContourMesh& contour = labels.contour();
  TraceEvent& event =
      trace_.asks(trace_code(Routine::init_triangulation), trace_code(Reason::beginning));
  for (const ContourTriangle& t : contour.triangles) {
    const SiteTriangle sites{label_[t[0]], label_[t[1]], label_[t[2]]};
    if (is_dual(sites)) event.added.push_back(number(sites));
  }
  event.value = static_cast<double>(event.added.size());
  record(TraceOutcome::done);
  shows_contour_ = contour.triangles.size() <= kMostTriangles;
  if (!shows_contour_) return;
  TraceArrays& arrays = trace_.arrays();
  for (const Vec3& p : contour.points) {
    for (int axis = 0; axis < 3; ++axis) {
      arrays.contour_points.push_back(static_cast<float>(p[axis]));
    }
  }
  for (const ContourTriangle& t : contour.triangles) {
    arrays.contour_triangles.insert(arrays.contour_triangles.end(), t.begin(), t.end());
  }
  for (const SiteId s : label_) {
    arrays.contour_label.push_back(number(s));
  }
}

void Recording::asks_site(Routine routine, std::uint8_t reason, SiteId asker, ContourId v) {
  const double value = v == kNoId ? 0 : std::sqrt(labels_->distance2_to_site(v));
  TraceEvent& event = trace_.asks(trace_code(routine), reason, value);
  if (asker != kNoId) event.caller[0] = number(asker);
}

void Recording::show_labels(SiteId site) {
  const Labels& labels = *labels_;
  number_sites();
  TraceEvent& event = trace_.event();
  event.vertex = number(site);
  const auto is_taken = [&](ContourId v) { return labels.label(v) == site && label_[v] != site; };
  // Every triangle of T with vertices that are taken, at the first of these.
  for (const ContourId v : labels.region(site)) {
    const std::span<const ContourId> ring = labels.ring(v);
    const std::size_t triangles = ring.size() - labels.contour().on_boundary(v);
    for (std::size_t n = 0; n < triangles; ++n) {
      const ContourId u = ring[n], w = ring[n + 1 < ring.size() ? n + 1 : 0];
      if ((u < v && is_taken(u)) || (w < v && is_taken(w))) continue;
      const SiteTriangle before{label_[v], label_[u], label_[w]};
      const SiteTriangle after{site, labels.label(u), labels.label(w)};
      if (is_dual(before)) event.removed.push_back(number(before));
      if (is_dual(after)) event.added.push_back(number(after));
    }
  }
  for (const ContourId v : labels.region(site)) {
    if (shows_contour_) event.relabel.push_back({v, event.vertex});
    label_[v] = site;
  }
}

}  // namespace deliso
