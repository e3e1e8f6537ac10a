// SPDX-License-Identifier: MIT
#include "app/facet_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/triangle.h"
#include "check/check_mesh.h"
#include "check/distances.h"
#include "contour/contour.h"
#include "isosurface/isosurface.h"

namespace deliso {
namespace {

// Returns f(a, b, c) for the corners of every facet.
template <class F>
std::vector<double> of_facets(const TriMesh& mesh, F f) {
  std::vector<double> values;
  values.reserve(mesh.faces.size());
  for (const Face& face : mesh.faces) {
    values.push_back(f(mesh.points[face.v[0]], mesh.points[face.v[1]], mesh.points[face.v[2]]));
  }
  return values;
}

double angle_at(const Vec3& p, const Vec3& q, const Vec3& r) {
  return std::atan2(length(cross(q - p, r - p)), dot(q - p, r - p));
}

}  // namespace

FacetComponents facet_components(const TriMesh& mesh) {
  const std::vector<std::uint32_t> component = vertex_components(mesh);
  std::vector<std::size_t> facets;
  for (const Face& face : mesh.faces) {
    const std::uint32_t c = component[face.v[0]];
    if (c >= facets.size()) facets.resize(c + 1, 0);
    ++facets[c];
  }
  std::vector<std::uint32_t> by_size(facets.size()), rank(facets.size());
  std::iota(by_size.begin(), by_size.end(), 0u);
  std::stable_sort(by_size.begin(), by_size.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return facets[a] > facets[b]; });
  for (std::uint32_t n = 0; n < by_size.size(); ++n) rank[by_size[n]] = n;

  FacetComponents result{{}, facets.size()};
  result.of_facet.reserve(mesh.faces.size());
  for (const Face& face : mesh.faces) result.of_facet.push_back(rank[component[face.v[0]]]);
  return result;
}

std::vector<std::uint8_t> facets_of_most_area(const TriMesh& mesh,
                                              const FacetComponents& components) {
  constexpr double kShare = 0.99;
  const std::vector<double> areas =
      of_facets(mesh, [](const Vec3& a, const Vec3& b, const Vec3& c) {
        return 0.5 * length(area_normal(a, b, c));
      });
  std::vector<std::pair<double, std::uint32_t>> largest(components.count);
  for (std::uint32_t c = 0; c < largest.size(); ++c) largest[c].second = c;
  for (std::size_t f = 0; f < areas.size(); ++f) largest[components.of_facet[f]].first -= areas[f];
  std::ranges::sort(largest);
  const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<std::uint8_t> is_kept(components.count, 0);
  double kept = 0;
  for (const auto& [minus_area, c] : largest) {
    if (kept >= kShare * all && kept > 0) break;
    kept -= minus_area;
    is_kept[c] = 1;
  }
  std::vector<std::uint8_t> marks;
  for (const std::uint32_t c : components.of_facet) marks.push_back(is_kept[c]);
  return marks;
}

std::vector<double> smallest_angles(const TriMesh& mesh) {
  return of_facets(mesh, [](const Vec3& a, const Vec3& b, const Vec3& c) {
    const double least = std::min({angle_at(a, b, c), angle_at(b, c, a), angle_at(c, a, b)});
    return least * 180 / std::numbers::pi;
  });
}

std::vector<double> facet_distances(const TriMesh& home, const Volume& volume, double kappa,
                                    int threads) {
  constexpr double kNear = 0.1;  // voxels; further points are searched in more directions
  CleanMesh mesh;
  mesh.points = home.points;
  mesh.triangles = home.triangles();
  mesh.uses = edge_uses(mesh.points.size(), mesh.triangles);
  std::vector<TriangleDistances> measured;
  distances_to_surface(mesh, Isosurface(volume, kappa), kSearchDiagonals * length(volume.spacing()),
                       {kNear * volume.voxel(), 0}, threads, &measured);
  std::vector<double> distances;
  distances.reserve(measured.size());
  for (const TriangleDistances& d : measured) distances.push_back(std::ranges::max(d));
  return distances;
}

std::vector<double> distances_in_voxels(const TriMesh& home, const Volume& volume,
                                        double isovalue) {
  std::vector<double> distances =
      facet_distances(home, volume, geometric_isovalue(volume.type(), isovalue), 1);
  for (double& distance : distances) distance /= volume.voxel();
  return distances;
}

std::vector<double> gradient_sizes(const TriMesh& home, const Volume& volume) {
  return of_facets(home, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    return length(volume.gradient((a + b + c) / 3));
  });
}

}  // namespace deliso
