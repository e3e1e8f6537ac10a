// SPDX-License-Identifier: MIT
#include "surface/hole.h"

#include <limits>

namespace deliso {

bool Hole::fill(const Ring& ring, const FacetTest& test) {
  ring_ = &ring;
  test_ = &test;
  size_ = 0;
  is_covered_ = false;
  worst2_ = -1;
  const int last = ring.size - 1;
  const int top = fill(0, last);
  if (top == kFailed) return false;
  // The edge from the last neighbor to the first: the star's own, or a new one on the boundary.
  facets_[top].across[1] = ~last;
  if (is_covered_) return true;
  double distance2 = std::numeric_limits<double>::infinity();
  for (int n = 0; n < size_; ++n) {
    const auto& [a, b, c] = facets_[n].corner;
    distance2 = std::min(
        distance2, distance2_to_triangle(ring.center, ring.point[a], ring.point[b], ring.point[c]));
  }
  return distance2 <= test.bound * test.bound;
}

double Hole::worst_of_star() const {
  double worst2 = 0;
  for (int k = 0; k < ring_->facets; ++k) {
    worst2 = std::max(worst2,
                      radius_ratio2(ring_->center, ring_->point[k], ring_->point[ring_->after(k)]));
  }
  return worst2;
}

bool Hole::is_over(int i, int k, int j) const {
  const Ring& r = *ring_;
  return r.x[i] * r.y[k] - r.y[i] * r.x[k] >= 0 && r.x[k] * r.y[j] - r.y[k] * r.x[j] >= 0 &&
         r.x[j] * r.y[i] - r.y[j] * r.x[i] >= 0;
}

bool Hole::is_near(const FacetTest::Facet& facet) const {
  const Ring& r = *ring_;
  const double height = dot(facet.normal, r.center - facet.from);
  const double cosine = dot(facet.normal, r.normal);
  return height * height * r.normal2 <= test_->bound * test_->bound * cosine * cosine;
}

int Hole::fill(int i, int j) {
  if (j - i == 1) return ~i;
  const Ring& r = *ring_;
  int third = -1;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  double cotangent = kNone;
  for (int k = i + 1; k < j; ++k) {
    const double ux = r.x[i] - r.x[k], uy = r.y[i] - r.y[k];
    const double wx = r.x[j] - r.x[k], wy = r.y[j] - r.y[k];
    const double area = wx * uy - wy * ux;
    const double at_k = area > 0 ? (ux * wx + uy * wy) / area : kNone;
    third = at_k < cotangent ? k : third;  // two choices without branches
    cotangent = std::min(cotangent, at_k);
  }
  tried_ = {i, third < 0 ? i : third, j};
  if (third < 0) return kFailed;
  const FacetTest::Facet facet(r.point[i], r.point[third], r.point[j]);
  const bool covers = is_over(i, third, j);
  if (covers && !is_near(facet)) return kFailed;
  const FacetTest::Shape shape = facet.shape();
  if (!shape.is_within(test_->ratio2)) {
    if (worst2_ < 0) worst2_ = worst_of_star();
    if (!shape.is_within(worst2_)) return kFailed;
  }
  if (!test_->has_surface_near(facet, shape.r2)) return kFailed;
  is_covered_ |= covers;
  const int own = size_++;
  facets_[own].corner = tried_;
  const int left = fill(i, third);
  if (left == kFailed) return kFailed;
  const int right = fill(third, j);
  if (right == kFailed) return kFailed;
  facets_[own].across = {right, 0, left};
  if (left >= 0) facets_[left].across[1] = own;
  if (right >= 0) facets_[right].across[1] = own;
  return own;
}

void replace_star(TriMesh& mesh, IdArray<VertexId, FaceId>& facet, const Ring& ring,
                  const Hole& hole) {
  IdArray<FaceId, Face>& faces = mesh.faces;
  std::array<FaceId, Ring::kMost> inside;  // the new facets at the ring's edges
  for (int n = 0; n < hole.size(); ++n) {
    const Hole::Facet& filling = hole.facet(n);
    Face& face = faces[ring.star[n]];
    for (std::size_t s = 0; s < 3; ++s) {
      face.v[s] = ring.vertex[filling.corner[s]];
      facet[face.v[s]] = ring.star[n];
      const int across = filling.across[s];
      face.n[s] = across >= 0 ? ring.star[across] : ring.outer[~across];
      if (across < 0) inside[~across] = ring.star[n];
    }
  }
  for (int k = 0; k < ring.facets; ++k) {
    if (ring.outer[k] == kNoId) continue;
    Face& outside = faces[ring.outer[k]];
    outside.n[kNextCorner[corner_index(outside, ring.vertex[k])]] = inside[k];
  }
  for (int k = hole.size(); k < ring.facets; ++k) {
    faces[ring.star[k]] = {{kNoId, kNoId, kNoId}, {kNoId, kNoId, kNoId}};
  }
}

}  // namespace deliso
