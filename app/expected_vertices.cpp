// SPDX-License-Identifier: MIT
#include "app/expected_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "app/command_line.h"

namespace deliso {
namespace {

constexpr std::size_t kSamplesCounted = std::size_t{1} << 22;
constexpr int kSlices = 32;

// Vertices per voxel squared of surface. One number is for Stage 1, and one for what its topology
// and shape leave of it when vertices that are not needed are gone. Three are added for bounds of
// one voxel on h, of 1 on h/r, and of 1 on r over pole height. They grow as the bound shrinks. The
// last is for a mesh whose facets all have a circumradius of one voxel. Fitted to the built-in
// fields, whose densities differ by factors, and to scanned volumes.
constexpr double kRecoverDensity = 0.03, kBaseDensity = 0.007;
constexpr double kDistanceDensity = 0.027, kHeightDensity = 0.005, kPoleDensity = 0.04;
constexpr double kRadiusDensity = 0.67;
// Vertices per voxel of r_min at creases of the interpolant, between voxels. There h/r does not
// fall with r, so refinement goes down to r_min.
constexpr double kCreaseDensity = 0.03;

// Where sheets are a sample thick, the surface bends at every voxel: more of it is out of the
// bound, and topology alone needs more. Fitted to four noisy fields and ten clean ones.
constexpr double kThinRecover = 11.5, kThinBase = 6, kThinDistance = 0.2;

struct CrossingCounts {
  std::array<double, 3> along{};  // grid edges along x, y and z
  double in_pairs = 0;            // along x and y, where the next edge is crossed too
};

// Returns how many of n samples are on the other side of the threshold than `others`.
template <class Sample>
std::size_t count_changes(const Sample* samples, const Sample* others, std::size_t n,
                          Sample threshold) {
  std::size_t changes = 0;
  for (std::size_t i = 0; i < n; ++i) {
    changes += (samples[i] >= threshold) != (others[i] >= threshold);
  }
  return changes;
}

// Returns how many of n samples lie on the other side of the threshold than those before and after.
template <class Sample>
std::size_t count_spikes(const Sample* before, const Sample* samples, const Sample* after,
                         std::size_t n, Sample threshold) {
  std::size_t spikes = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool inside = samples[i] >= threshold;
    spikes += inside != (before[i] >= threshold) && inside != (after[i] >= threshold);
  }
  return spikes;
}

// Counts crossings in every `stride`th slice and between it and the next, times the number of
// slices that it represents.
template <class Sample>
CrossingCounts count_crossings(const Sample* samples, Index3 dims, double kappa, int stride) {
  const std::optional<Sample> threshold = inside_threshold<Sample>(kappa);
  if (!threshold) return {};
  const auto nx = static_cast<std::size_t>(dims.i), ny = static_cast<std::size_t>(dims.j);
  std::array<std::uint64_t, 3> counts{};
  std::uint64_t spikes = 0;
  int slices = 0, pairs = 0;
  for (int k = 0; k < dims.k; k += stride) {
    const Sample* row = samples + nx * ny * static_cast<std::size_t>(k);
    const bool is_last = k + 1 == dims.k;
    ++slices;
    pairs += !is_last;
    for (std::size_t j = 0; j < ny; ++j, row += nx) {
      counts[0] += count_changes(row, row + 1, nx - 1, *threshold);
      if (nx > 2) spikes += count_spikes(row, row + 1, row + 2, nx - 2, *threshold);
      if (j > 0 && j + 1 < ny) spikes += count_spikes(row - nx, row, row + nx, nx, *threshold);
      if (j + 1 < ny) counts[1] += count_changes(row, row + nx, nx, *threshold);
      if (!is_last) counts[2] += count_changes(row, row + nx * ny, nx, *threshold);
    }
  }
  const double in_slice = static_cast<double>(dims.k) / slices;
  const double between = pairs > 0 ? static_cast<double>(dims.k - 1) / pairs : 0;
  return {{static_cast<double>(counts[0]) * in_slice, static_cast<double>(counts[1]) * in_slice,
           static_cast<double>(counts[2]) * between},
          static_cast<double>(spikes) * in_slice};
}

double density(const Options& options, const Volume& volume, double thin) {
  const double voxel = volume.voxel(), bent = thin * std::sqrt(thin);
  if (options.stop_after_recover) return kRecoverDensity + kThinRecover * bent;
  const double base = kBaseDensity + kThinBase * bent;
  const auto length = [&](Criterion c) { return options.limits[c].in(volume) / voxel; };
  const auto squared = [](double x) { return x * x; };
  const double h_over_r = options.limits[Criterion::h_over_r].value;
  const double r_over_pole = options.limits[Criterion::r_over_pole].value;
  // With --vertices and --triangles the number decides.
  const double asked =
      by_count(options)
          ? Options::kNone
          : std::max({kDistanceDensity / length(Criterion::distance) +
                          kThinDistance * bent / squared(length(Criterion::distance)),
                      kHeightDensity / squared(h_over_r), kPoleDensity / squared(r_over_pole),
                      kRadiusDensity / squared(length(Criterion::radius))});
  const double r_min = options.r_min.in(volume) / voxel;
  const double creases = h_over_r < Options::kNone ? kCreaseDensity / r_min : 0;
  // Facets below r_min are not refined.
  return 1 / (1 / (base + asked + creases) + r_min * r_min / kRadiusDensity);
}

}  // namespace

SurfaceEstimate estimate_surface(const Volume& volume, double kappa) {
  const Index3 dims = volume.dims();
  const auto wanted = static_cast<int>(volume.sample_count() / kSamplesCounted);
  // Odd, as some scanners make every second slice alike: ENGINE's fourths are a third too large.
  const int stride = std::max(1, std::min(wanted, dims.k / kSlices)) | 1;
  const auto [crossings, in_pairs] = volume.visit(
      [&](const auto* samples) { return count_crossings(samples, dims, kappa, stride); });
  const Vec3 s = volume.spacing();
  const double voxel = volume.voxel();
  // A piece of surface with the area A and the unit normal n crosses A |n.x| lines along x. The
  // mean of |n.x| + |n.y| + |n.z| over all directions is 3/2.
  const double area =
      crossings[0] * s.y * s.z + crossings[1] * s.z * s.x + crossings[2] * s.x * s.y;
  return {crossings[0] + crossings[1] + crossings[2], area / (1.5 * voxel * voxel),
          in_pairs / std::max(1.0, crossings[0] + crossings[1])};
}

double expected_vertices(const SurfaceEstimate& surface, const Volume& volume,
                         const Options& options) {
  const double vertices = surface.area * density(options, volume, surface.thin);
  const std::size_t asked = std::min(options.target_vertices, options.target_triangles / 2);
  return std::min(vertices, static_cast<double>(asked));
}

}  // namespace deliso
