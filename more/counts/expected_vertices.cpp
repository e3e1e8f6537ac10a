// SPDX-License-Identifier: MIT
#include "more/counts/expected_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace deliso {
namespace {

constexpr std::size_t kSamplesCounted = std::size_t{1} << 20;

// Vertices per voxel squared of surface. One number is for Stage 1, and one for what its topology
// and shape leave of it when vertices that are not needed are gone. Two are added for bounds of one
// voxel on h, and of 1 on h/r. They grow as the bound shrinks. The
// last is for a mesh whose facets all have a circumradius of one voxel. Fitted to the built-in
// fields, whose densities differ by factors, and to scanned volumes.
constexpr double kRecoverDensity = 0.03, kBaseDensity = 0.007;
constexpr double kDistanceDensity = 0.027, kHeightDensity = 0.005;
constexpr double kRadiusDensity = 0.67;
// Vertices per voxel of r_min at creases of the interpolant, between voxels. There h/r does not
// fall with r, so refinement goes down to r_min.
constexpr double kCreaseDensity = 0.03;

// Where sheets are a sample thick, the surface bends at every voxel: more of it is out of the
// bound, and topology alone needs more. Fitted to four noisy fields and ten clean ones.
constexpr double kThinRecover = 11.5, kThinBase = 6, kThinDistance = 0.2;

// Seconds of one core of 3 GHz, and bytes. Fitted to ten scans and fields of 1,000 to 800,000
// vertices, of which noise takes twice the time and half as much memory again. FUEL, TOOTH, ENGINE
// and BABY at info's isovalues, with and without a check, took 0.7 to 2.2 times the seconds and
// 0.7 to 1.2 times the bytes (2026-11-26).
constexpr double kVertexSeconds = 22e-6, kCrossingSeconds = 3e-6, kSampleSeconds = 10e-9;
constexpr double kCheckShare = 0.8;    // of the time for the mesh
constexpr double kSerialShare = 0.07;  // of the time: two threads are 1.87 times as fast as one
constexpr double kVertexBytes = 500, kCheckBytes = 800, kProgramBytes = 7e6;
// Vertices for each one that --vertices leaves.
constexpr double kCoarsened = 4;

double density(const Options& options, const Volume& volume, double thin) {
  const double voxel = volume.voxel(), bent = thin * std::sqrt(thin);
  if (options.stop_after_stage1) return kRecoverDensity + kThinRecover * bent;
  const double base = kBaseDensity + kThinBase * bent;
  const auto length = [&](Criterion c) { return options.limits[c].in(volume) / voxel; };
  const auto squared = [](double x) { return x * x; };
  const double h_over_r = options.limits[Criterion::h_over_r].value;
  // With --vertices and --triangles the number decides.
  const double asked =
      options.has_target()
          ? Options::kNone
          : std::max({kDistanceDensity / length(Criterion::distance) +
                          kThinDistance * bent / squared(length(Criterion::distance)),
                      kHeightDensity / squared(h_over_r),
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

double expected_vertices(const SurfaceEstimate& surface, const Volume& volume,
                         const Options& options) {
  const double vertices = surface.area * density(options, volume, surface.thin);
  const std::size_t asked = std::min(options.target_vertices, options.target_triangles / 2);
  return std::min(vertices, static_cast<double>(asked));
}

ExpectedCost expected_cost(const SurfaceEstimate& surface, double vertices, const Volume& volume,
                           const Options& options, bool verified) {
  const auto samples = static_cast<double>(volume.sample_count());
  const double made = vertices * (options.has_target() ? kCoarsened : 1);
  const double seconds =
      made * kVertexSeconds + surface.crossings * kCrossingSeconds + samples * kSampleSeconds;
  const double of_time = kSerialShare + (1 - kSerialShare) / options.threads;
  return {seconds * (verified ? 1 + kCheckShare : 1) * of_time,
          made * kVertexBytes + (verified ? vertices * kCheckBytes : 0) + kProgramBytes +
              samples * static_cast<double>(size_of(volume.type()))};
}

}  // namespace deliso
