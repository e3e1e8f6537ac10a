// SPDX-License-Identifier: MIT
#include "view/render/occlusion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "view/render/rasterize.h"

namespace deliso {
namespace {

constexpr int kSide = 512;  // samples of a z-buffer
// Fewer directions for large meshes, whose shadows are small.
constexpr std::size_t kMostDirections = 96, kFewestDirections = 24, kFacetsDrawn = 40'000'000;
constexpr std::size_t kAtOnce = 8;  // z-buffers in memory
// A vertex is seen if it is not further behind the z-buffer than this, in samples, for a facet that
// faces the direction; further for one at an angle, down to the least cosine.
constexpr double kTolerance = 2, kLeastCosine = 0.2;

// The n-th of `count` directions on a spiral that covers the sphere evenly (Swinbank and Purser
// 2006).
View direction(std::size_t n, std::size_t count) {
  const double z = 1 - (2 * static_cast<double>(n) + 1) / static_cast<double>(count);
  const double turns = static_cast<double>(n) / std::numbers::phi;
  return {360 * (turns - std::floor(turns)), std::asin(z) * 180 / std::numbers::pi};
}

struct DepthMap {
  Camera camera;
  std::vector<double> depths;

  bool sees(const Vec3& p, double cosine) const {
    const Camera::Projected q = camera.project(p);
    const auto sample = [](double at) {
      return static_cast<std::size_t>(std::clamp(at, 0.0, kSide - 1.0));
    };
    const double tolerance = kTolerance / (camera.scale * cosine);
    return q.depth + tolerance >= depths[sample(q.y) * kSide + sample(q.x)];
  }
};

}  // namespace

std::vector<SkySeen> find_sky(const Subject& subject, std::span<const Vec3> normals, int threads) {
  const TriMesh& mesh = *subject.mesh;
  struct Sums {
    float seen[2] = {0, 0}, all[2] = {0, 0};
  };
  std::vector<Sums> sums(mesh.points.size());
  const std::size_t count =
      std::clamp(kFacetsDrawn / std::max<std::size_t>(1, mesh.faces.size()) / kAtOnce * kAtOnce,
                 kFewestDirections, kMostDirections);
  for (std::size_t first = 0; first < count; first += kAtOnce) {
    std::vector<DepthMap> maps(kAtOnce);
    for_each_task(threads, kAtOnce, [&](std::size_t n) {
      maps[n].camera = fit_camera({&subject, 1}, direction(first + n, count), {}, {kSide, kSide});
      const ProjectedMesh projected = project(mesh, maps[n].camera, 1, subject.clip);
      maps[n].depths = visible_layer(mesh, projected, 0, kSide).depths;
    });
    for_each_run(threads, sums.size(), 1u << 12, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        for (const DepthMap& map : maps) {
          const double along = dot(normals[v], map.camera.back), cosine = std::abs(along);
          if (cosine < kLeastCosine) continue;
          const int side = along > 0 ? 0 : 1;
          const auto weight = static_cast<float>(cosine);
          sums[v].all[side] += weight;
          if (map.sees(mesh.points[VertexId(v)], cosine)) sums[v].seen[side] += weight;
        }
      }
    });
  }
  std::vector<SkySeen> sky(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const auto share = [&](int side) {
      return sums[v].all[side] > 0 ? sums[v].seen[side] / sums[v].all[side] : 1;
    };
    sky[v] = {share(0), share(1)};
  }
  return sky;
}

}  // namespace deliso
