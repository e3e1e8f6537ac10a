// SPDX-License-Identifier: MIT
// The oracle: here the stages learn where Sigma = g^-1(kappa) lies, with g the trilinear
// interpolant (paper §2.2.3 and §4). It answers three questions: every point of Sigma on a segment,
// the point of Sigma on a line nearest to a given point of the line, and the gradient there. Most
// segments are shorter than a few voxels, so it walks from voxel to voxel; long ones are quicker
// through the kd-tree (paper/intersect.h). It counts its work (Table 4's CPI) in the caller's
// counters, so that each stage has its own.
//
// A hit is a passage between inside (g >= kappa) and outside. A line that touches Sigma without
// passing has no hit there, or two at (nearly) equal t, never one. So the number of hits on a
// segment is odd exactly when its ends lie on different sides (V1 and V2 of voxel_ray.h). Each hit
// lies in the box, with |g - kappa| <= 1e-9 times the range of its voxel's samples.
//
// A line has no hit if it has no length, is not finite, or touches the box only in a point.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/segment.h"
#include "isosurface/lattice_line.h"
#include "roots/cubic.h"
#include "volume/volume.h"

namespace deliso {

// A computation is one voxel-ray intersection: the cubic formed in one active voxel, once per voxel
// and search. Others cost none.
struct SearchCounters {
  std::uint64_t searches = 0;
  std::uint64_t searches_with_hit = 0;
  std::uint64_t computations = 0;           // voxel-ray intersections solved
  std::uint64_t computations_with_hit = 0;  // those of searches with a hit (CPI*)

  void count_search(std::uint64_t solved, bool has_hit) {
    ++searches;
    computations += solved;
    if (!has_hit) return;
    ++searches_with_hit;
    computations_with_hit += solved;
  }

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
  bool leaves;  // the line passes to outside there: Sigma faces along it
};

class Isosurface {
 public:
  // Keeps a reference to the volume. pre: kappa is geometric_isovalue().
  Isosurface(const Volume& volume, double kappa, CubicMethod method = CubicMethod::isolation);

  const Volume& volume() const { return volume_; }
  const VoxelUnits& units() const { return units_; }
  double kappa() const { return kappa_; }

  // Finds all points of Sigma on r, in increasing t in [0, 1]: Intersect(f, kappa, r) of Figure 12.
  // A point on a face shared by two voxels is found once. Replaces the contents of `hits`.
  void intersect(const Segment& r, std::vector<Hit>& hits, SearchCounters& counters) const;

  // Returns the point of Sigma nearest to center on the line center + t * direction, |t| <= limit.
  // Returns nothing if the line misses Sigma within the limit. Direction is a unit vector, so t is
  // a signed distance; of two hits at equal |t| the positive one is returned. For Stage 2.
  std::optional<Hit> nearest(const Vec3& center, const Vec3& direction, double limit,
                             SearchCounters& counters) const;

  // Returns the gradient of g at p. It points to f >= kappa, so outward normals run against it.
  Vec3 gradient(const Vec3& p) const { return volume_.gradient(p); }

 private:
  const Volume& volume_;
  VoxelUnits units_;
  double kappa_;
  CubicMethod method_;
  bool empty_ = true;     // no voxel, or no sample can be inside
  double threshold_ = 0;  // inside_threshold of the sample type
};

}  // namespace deliso
