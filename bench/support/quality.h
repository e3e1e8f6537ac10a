// SPDX-License-Identifier: MIT
// What `make quality` knows of a run and of its mesh.
//
//   Q1  A mesh is measured by this build's check, whichever program made it: two programs are held
//       against the same yardstick. Only what has "reported" in its meaning is the program's own
//       word.
//   Q2  Lengths are in voxels, of a voxel's shortest side. Points that are measured are those of
//       the check: three edge midpoints and the center of each triangle, and T's vertices.
//   Q3  What is not known is a NaN.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/tri_mesh.h"
#include "run/options.h"
#include "volume/volume.h"

namespace deliso {

enum class Metric : std::uint8_t {
  vertices,
  cpu_seconds,
  time_ratio,
  needles,
  needles_above_r_min,
  min_angle,
  facets_left,
  facets_over,
  points_left,
  points_far,
  mesh_mean,
  mesh_999,
  mesh_max,
  surface_mean,
  surface_999,
  surface_max,
  restricted,
  crossings,
  exact,
  other_faults,
  failed,
  count_
};
inline constexpr std::size_t kMetrics = static_cast<std::size_t>(Metric::count_);

enum class Better : std::uint8_t { less, more };

struct MetricRow {
  std::string_view key;  // in a file of runs
  std::string_view heading;
  int decimals;
  Better better;
  std::string_view meaning;
};

// In the order of Metric.
inline constexpr std::array<MetricRow, kMetrics> kMetricTable{{
    {"vertices", "vertices", 0, Better::less, "vertices of the mesh"},
    {"cpu_seconds", "CPU s", 2, Better::less,
     "CPU time of the program and of the system for it, one thread"},
    {"time_ratio", "time", 2, Better::less, "CPU time over that of --beside, run next to it"},
    {"needles", "r/l > 2", 0, Better::less, "triangles with r/l > 2, of any size"},
    {"needles_above_r_min", "r > r_min", 0, Better::less, "those of them with r > r_min"},
    {"min_angle", "angle", 1, Better::more, "smallest angle in degrees"},
    {"facets_left", "left", 0, Better::less, "reported: facets that Stage 2 left over a limit"},
    {"facets_over", "over", 0, Better::less, "triangles over a limit"},
    {"points_left", "far (rep.)", 0, Better::less, "reported: points of T further than 2 D"},
    {"points_far", "far", 0, Better::less, "vertices of T further than 2 D from the mesh"},
    {"mesh_mean", "M mean", 4, Better::less, "mean distance from the mesh to Sigma"},
    {"mesh_999", "M 99.9 %", 3, Better::less, "99.9 % of the mesh's points are no further"},
    {"mesh_max", "M max", 3, Better::less, "largest distance from the mesh to Sigma"},
    {"surface_mean", "T mean", 4, Better::less, "mean distance from Sigma to the mesh"},
    {"surface_999", "T 99.9 %", 3, Better::less, "99.9 % of T's vertices are no further"},
    {"surface_max", "T max", 3, Better::less, "largest distance from Sigma to the mesh"},
    {"restricted", "restricted %", 3, Better::more, "share of restricted Delaunay facets"},
    {"crossings", "crossings", 0, Better::less, "pairs of triangles that cross"},
    {"exact", "exact", 0, Better::more, "whether the topology is Sigma's"},
    {"other_faults", "faults", 0, Better::less,
     "all other faults of the mesh that the check names"},
    {"failed", "failed", 0, Better::less, "runs without a mesh, or with a status of 2 or more"},
}};

struct Measured {
  std::array<double, kMetrics> values;

  Measured() { values.fill(std::numeric_limits<double>::quiet_NaN()); }
  double& operator[](Metric m) { return values[static_cast<std::size_t>(m)]; }
  double operator[](Metric m) const { return values[static_cast<std::size_t>(m)]; }
};

struct QualityRun {
  std::string build, volume, options;
  std::uint64_t turn = 0;  // of the volume (turned.h)
  Measured measured;
};

// Measures the mesh, in the scaled frame of `volume`, by the criteria of `options`: all but the
// time and what is reported.
Measured measure(const TriMesh& mesh, const Volume& volume, double isovalue, const Options& options,
                 int threads);

// The number at `key` in a program's JSON report; a NaN where there is none.
double reported(std::string_view json, std::string_view key);

// One run a line, parted by tabs, below a header with the names of the columns. The file is opened
// at once and written line by line: what is measured is not lost when the rest is interrupted.
std::string header_of_runs();
std::string line_of(const QualityRun& run);

// The runs of such a file, with columns in any order. `build` becomes the file's name, followed by
// a colon and the build where there are several. Throws InputError naming the line.
std::vector<QualityRun> read_runs(const std::string& path);

}  // namespace deliso
