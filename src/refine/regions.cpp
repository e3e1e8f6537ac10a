// SPDX-License-Identifier: MIT
#include "refine/regions.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/sorted_list.h"

namespace deliso {

std::vector<MeshRegion> cut_into_regions(const SurfaceMesh& whole, std::size_t most,
                                         std::span<const Vec3> points, double margin,
                                         std::vector<std::uint32_t>& samples) {
  const TriMesh& mesh = whole.mesh;
  const auto corner = [&](FaceId f, std::size_t i) -> const Vec3& {
    return mesh.points[mesh.faces[f].v[i]];
  };
  std::vector<MeshRegion> regions, uncut(1);
  uncut[0].facets.resize(mesh.faces.size());
  std::iota(uncut[0].facets.begin(), uncut[0].facets.end(), FaceId(0));
  uncut[0].samples = std::exchange(samples, {});
  while (!uncut.empty()) {
    MeshRegion all = std::move(uncut.back());
    uncut.pop_back();
    const auto is_frozen = [&](FaceId f) {
      return std::ranges::any_of(mesh.faces[f].v, [&](VertexId v) {
        return whole.chain.is_boundary(v) || !all.box.holds(mesh.points[v]);
      });
    };
    std::vector<FaceId> own = all.facets;
    std::erase_if(own, is_frozen);
    if (own.size() <= most && regions.empty() && uncut.empty()) {
      samples = std::move(all.samples);
      return {};
    }
    if (own.size() <= most) {
      all.box.first_free = FaceId(all.facets.size() - own.size());
      std::stable_partition(all.facets.begin(), all.facets.end(), is_frozen);
      regions.push_back(std::move(all));
      continue;
    }
    // Cuts the longest side at the median.
    Box3 box{corner(own[0], 0), corner(own[0], 0)};
    for (const FaceId f : own) box = united(box, {corner(f, 0), corner(f, 0)});
    const Vec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto middle = own.begin() + static_cast<std::ptrdiff_t>(own.size() / 2);
    std::ranges::nth_element(own, middle, {}, [&](FaceId f) { return corner(f, 0)[axis]; });
    const double plane = corner(*middle, 0)[axis];
    // No plane separates these facets, such as a star around one vertex: they are refined later.
    if (!(box.lo[axis] < plane)) {
      all.box.first_free = FaceId(all.facets.size());
      regions.push_back(std::move(all));
      continue;
    }

    MeshRegion below{all.box, {}, {}, {}, {}};
    MeshRegion above{all.box, {}, {}, {}, {}};
    below.box.hi[axis] = above.box.lo[axis] = plane;
    for (const FaceId f : all.facets) {
      const auto [lo, hi] =
          std::minmax({corner(f, 0)[axis], corner(f, 1)[axis], corner(f, 2)[axis]});
      if (lo < plane) below.facets.push_back(f);
      if (hi >= plane) above.facets.push_back(f);
    }
    for (const std::uint32_t n : all.samples) {
      const double at = points[n][axis];
      const bool is_below = at + margin < plane, is_above = at - margin >= plane;
      (is_below ? below.samples : is_above ? above.samples : samples).push_back(n);
    }
    uncut.push_back(std::move(above));
    uncut.push_back(std::move(below));
  }
  return regions;
}

void extract(const SurfaceMesh& whole, MeshRegion& region) {
  for (const FaceId f : region.facets) {
    std::ranges::copy(whole.mesh.faces[f].v, std::back_inserter(region.vertices));
  }
  sort_unique(region.vertices);
  SurfaceMesh& s = region.surface;
  for (const VertexId v : region.vertices) {
    s.mesh.points.push_back(whole.mesh.points[v]);
    if (!whole.pole_heights.empty()) s.pole_heights.push_back(whole.pole_heights[v]);
  }
  for (const FaceId f : region.facets) {
    Face& face = s.mesh.faces.emplace_back(whole.mesh.faces[f]);
    for (VertexId& v : face.v) {
      v = VertexId(std::ranges::lower_bound(region.vertices, v) - region.vertices.begin());
    }
    s.duals.push_back(whole.duals[f]);
  }
  link_faces(s.mesh);
}

std::vector<FaceId> put_back(SurfaceMesh& whole, const MeshRegion& region) {
  const SurfaceMesh& s = region.surface;
  // New vertices and facets get ids after the last.
  const auto extended = [](auto ids, std::size_t size, std::size_t last) {
    while (ids.size() < size) ids.emplace_back(last++);
    return ids;
  };
  const auto vertex = extended(region.vertices, s.mesh.points.size(), whole.mesh.points.size());
  auto facet = extended(region.facets, s.mesh.faces.size(), whole.mesh.faces.size());
  whole.mesh.points.resize(whole.mesh.points.size() + vertex.size() - region.vertices.size());
  whole.mesh.faces.resize(whole.mesh.faces.size() + facet.size() - region.facets.size());
  whole.duals.resize(whole.mesh.faces.size());
  if (!s.pole_heights.empty()) whole.pole_heights.resize(whole.mesh.points.size());
  for (VertexId v = 0; v < vertex.size(); ++v) {
    whole.mesh.points[vertex[v]] = s.mesh.points[v];
    if (!s.pole_heights.empty()) whole.pole_heights[vertex[v]] = s.pole_heights[v];
  }
  for (FaceId f = region.box.first_free; f < facet.size(); ++f) {
    Face& face = whole.mesh.faces[facet[f]] = s.mesh.faces[f];
    whole.duals[facet[f]] = s.duals[f];
    if (is_dead(face)) continue;
    for (VertexId& v : face.v) v = vertex[v];
  }
  return facet;
}

}  // namespace deliso
