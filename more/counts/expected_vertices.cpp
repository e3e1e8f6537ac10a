// SPDX-License-Identifier: MIT
#include "more/counts/expected_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "coarsen/coarsen.h"

namespace deliso {
namespace {

constexpr std::size_t kSamplesCounted = std::size_t{1} << 20;

// Vertices per voxel squared of surface. The first number is what topology and shape need. Two are
// added for bounds of one voxel on h, and of 1 on h/r. They grow as the bound shrinks. The last is
// for a mesh whose facets all have a circumradius of one voxel. Fitted to the built-in fields,
// whose densities differ by factors, and to scanned volumes.
constexpr double kBaseDensity = 0.007, kDistanceDensity = 0.027, kHeightDensity = 0.005;
constexpr double kRadiusDensity = 0.67;
// Vertices per voxel of r_min at creases of the interpolant, between voxels. There h/r does not
// fall with r, so refinement goes down to r_min.
constexpr double kCreaseDensity = 0.03;

// Where sheets are a sample thick, the surface bends at every voxel: more of it is out of the
// bound, and topology alone needs more. Fitted to four noisy fields and ten clean ones.
constexpr double kThinBase = 6, kThinDistance = 0.2;

double density(const Options& options, const Grid& volume, double thin) {
  const double voxel = volume.voxel(), bent = thin * std::sqrt(thin);
  const double base = kBaseDensity + kThinBase * bent;
  const auto length = [&](Criterion c) { return options.limits[c].in(volume) / voxel; };
  const auto squared = [](double x) { return x * x; };
  const auto for_distance = [&](double d) {
    return kDistanceDensity / d + kThinDistance * bent / squared(d);
  };
  // The coarsened contour keeps to the distance alone.
  if (options.stop_after_stage1) {
    return base + for_distance(coarsening_bound(resolve(options, volume)) / voxel);
  }
  const double h_over_r = options.limits[Criterion::h_over_r].value;
  // With --vertices and --triangles the number decides.
  const double asked =
      options.has_target()
          ? Options::kNone
          : std::max({for_distance(length(Criterion::distance)), kHeightDensity / squared(h_over_r),
                      kRadiusDensity / squared(length(Criterion::radius))});
  const double r_min = options.r_min.in(volume) / voxel;
  const double creases = h_over_r < Options::kNone ? kCreaseDensity / r_min : 0;
  // Facets below r_min are not refined.
  return 1 / (1 / (base + asked + creases) + r_min * r_min / kRadiusDensity);
}

}  // namespace

SurfaceEstimate estimate_surface(const Volume& volume, double kappa) {
  const Index3 dims = volume.dims();
  // Odd, as some scanners make every second slice alike.
  const auto step = static_cast<int>(volume.sample_count() / kSamplesCounted) | 1;
  std::array<std::uint64_t, 3> looked_at{}, crossed{};
  std::uint64_t in_pairs = 0;
  volume.visit([&]<class Sample>(const Sample* sample) {
    const std::optional<Sample> threshold = inside_threshold<Sample>(kappa);
    if (!threshold) return;
    const std::ptrdiff_t next[] = {1, dims.i, std::ptrdiff_t{dims.i} * dims.j};
    Index3 at;
    int skipped = 0;  // samples before the next that is looked at
    for (at.k = 0; at.k < dims.k; ++at.k) {
      for (at.j = 0; at.j < dims.j; ++at.j, skipped = at.i - dims.i, sample += dims.i) {
        for (at.i = skipped; at.i < dims.i; at.i += step) {
          const Sample* here = sample + at.i;
          for (int axis = 0; axis < 3; ++axis) {
            if (at[axis] + 1 == dims[axis]) continue;
            const auto changes = [&](std::ptrdiff_t to) {
              return (*here >= *threshold) != (here[to] >= *threshold);
            };
            ++looked_at[axis];
            if (!changes(next[axis])) continue;
            ++crossed[axis];
            in_pairs += axis < 2 && at[axis] > 0 && changes(-next[axis]);
          }
        }
      }
    }
  });
  SurfaceEstimate surface;
  const double voxel = volume.voxel();
  for (int axis = 0; axis < 3; ++axis) {
    const double all = static_cast<double>(volume.sample_count()) / dims[axis] * (dims[axis] - 1);
    const double crossings = looked_at[axis] > 0 ? static_cast<double>(crossed[axis]) *
                                                       (all / static_cast<double>(looked_at[axis]))
                                                 : 0;
    surface.crossings += crossings;
    // A piece of surface with the area A and the unit normal n crosses A |n.x| lines along x. The
    // mean of |n.x| + |n.y| + |n.z| over all directions is 3/2.
    const Vec3& s = volume.spacing();
    surface.area += crossings * s.x * s.y * s.z / s[axis] / (1.5 * voxel * voxel);
  }
  surface.thin =
      static_cast<double>(in_pairs) / std::max(1.0, static_cast<double>(crossed[0] + crossed[1]));
  return surface;
}

double expected_vertices(const SurfaceEstimate& surface, const Grid& volume,
                         const Options& options) {
  double vertices = surface.area * density(options, volume, surface.thin);
  // T has a vertex at each crossing, and few more. Stage 1 removes some and adds none.
  if (options.stop_after_stage1) vertices = std::min(vertices, surface.crossings);
  const std::size_t asked = std::min(options.target_vertices, options.target_triangles / 2);
  return std::min(vertices, static_cast<double>(asked));
}

}  // namespace deliso
