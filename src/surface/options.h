// SPDX-License-Identifier: MIT
// What a run can be told: the paper's parameters with its defaults (§3.1, §3.2), and ours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

#include "roots/cubic.h"

namespace deliso {

// A length given as a fraction of b, the smallest side of the box, or in voxels (`0.5vox`, of the
// smallest spacing).
struct RelativeLength {
  double value = 0.001;
  bool in_voxels = false;
};

// How Stage 1 knows that it is done: by the closed-ball conditions on the exact contour, or by the
// paper's tests on Voronoi edges.
enum class RecoverWay : std::uint8_t { certified, paper };

// The two stages, or Marching Cubes for comparison (deliso/marching_cubes.h): all other options
// but `cap` then have no effect.
enum class Method : std::uint8_t { delaunay, marching_cubes };

// Which of a vertex's two poles gives its height: §3.2 says the nearer; the other is for studying
// how the paper's counts came about.
enum class PoleSide : std::uint8_t { nearer, further };

struct Profile;

struct Options {
  Method method = Method::delaunay;
  RecoverWay recover = RecoverWay::certified;
  double fingers = 1;  // certified: no vertex of the contour further from the mesh, in voxels
  int turns = 4;       // certified: of Stage 1 and Stage 2, at most
  // certified: an ApproximateGeom, h/r of facets larger than a voxel; the topology needs none
  double certified_epsilon = std::numeric_limits<double>::infinity();
  double epsilon = 0.2;                   // Stage 1, paper's way: h/r; infinity: no ApproximateGeom
  double epsilon1 = 0.1;                  // Stage 2: h/r
  double epsilon2 = 0.2;                  // Stage 2: r/h_sigma
  double lambda = 2.0;                    // r/l, both stages
  RelativeLength r_min;                   // nothing with r <= r_min is refined
  PoleSide pole_side = PoleSide::nearer;  // paper's way only
  double max_distance = std::numeric_limits<double>::infinity();  // h, world units
  double max_radius = std::numeric_limits<double>::infinity();    // r, world units

  std::uint64_t seed = 1;
  std::size_t samples = 50;  // N0 random ray hits to begin with
  double min_component = 0;  // components whose bounding box is smaller (voxels) are not seeded
  CubicMethod cubic = CubicMethod::isolation;
  int threads = 1;

  bool single_stage = false;  // Table 2's baseline: all refinement on the 3D triangulation
  bool stop_after_recover = false;
  bool cap = false;  // close the mesh on the box (deliso/close_on_box.h)
  std::size_t max_vertices = std::numeric_limits<std::size_t>::max();
  // With max_vertices reached: keep the valid mesh so far (else an InputError is thrown).
  bool keep_partial = false;

  // Called now and then with a stage's name and a share done in [0, 1]; may be empty.
  std::function<void(const char* stage, double share)> progress;
  Profile* profile = nullptr;  // deliso/profile.h: filled when given
};

}  // namespace deliso
