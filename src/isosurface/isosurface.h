// SPDX-License-Identifier: MIT
// The oracle: the only thing the stages may ask about Sigma = g^-1(kappa), with g the trilinear
// interpolant (paper §2.2.3 and §4). Three questions: every point of Sigma on a segment, the point
// of Sigma on a line nearest to a given point of it, and the gradient there. It counts what it does
// (Table 4's CPI): the counters are the caller's, so that each stage has its own.
//
// A hit is a passage between inside (g >= kappa) and outside. A line that touches Sigma without
// passing has no hit there, or two at (nearly) equal t: never one. So the number of hits on a
// segment is odd exactly when its ends lie on different sides (V1 and V2 of voxel_ray.h). Each hit
// lies in the box, with |g - kappa| <= 1e-9 times the range of its voxel's samples.
//
// Lines of no length, or not finite, or that touch the box in a point have no hits.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/segment.h"
#include "kdtree/voxel_tree.h"
#include "roots/cubic.h"
#include "volume/volume.h"

namespace deliso {

// A computation is one voxel-ray intersection: the cubic formed in one voxel that has samples on
// both sides of kappa, once per voxel and search. What min and max pass over costs none.
struct SearchCounters {
  std::uint64_t searches = 0;
  std::uint64_t searches_with_hit = 0;
  std::uint64_t computations = 0;           // voxel-ray intersections solved
  std::uint64_t computations_with_hit = 0;  // those of searches that found something (CPI*)

  SearchCounters& operator+=(const SearchCounters& o) {
    searches += o.searches;
    searches_with_hit += o.searches_with_hit;
    computations += o.computations;
    computations_with_hit += o.computations_with_hit;
    return *this;
  }
};

struct Hit {
  double t;  // the segment's or line's parameter
  Vec3 point;
};

class Isosurface {
 public:
  // Keeps references: volume and tree must outlive it. kappa: effective_isovalue().
  Isosurface(const Volume& volume, const VoxelTree& tree, double kappa,
             CubicMethod method = CubicMethod::isolation);

  const Volume& volume() const { return volume_; }
  double kappa() const { return kappa_; }

  // Intersect(f, kappa, r) of Figure 12: all points of Sigma on r, in increasing t in [0, 1], one
  // on a face shared by two voxels only once. Replaces the contents of `hits`.
  void intersect(const Segment& r, std::vector<Hit>& hits, SearchCounters& counters) const;

  // The point of Sigma on the line center + t * direction with |t| <= limit that is nearest to
  // center (Stage 2; direction is a unit vector, so t is a signed distance). At equal |t| the
  // positive one. Nothing when the line misses Sigma within the limit.
  std::optional<Hit> nearest(const Vec3& center, const Vec3& direction, double limit,
                             SearchCounters& counters) const;

  // Gradient of g at p; points to f >= kappa, so outward normals run against it.
  Vec3 gradient(const Vec3& p) const { return volume_.gradient(p); }

 private:
  const Volume& volume_;
  const VoxelTree& tree_;
  double kappa_;
  CubicMethod method_;
  bool empty_;            // no voxel is active
  double threshold_ = 0;  // inside_threshold of the sample type
};

}  // namespace deliso
