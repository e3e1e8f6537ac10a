// SPDX-License-Identifier: MIT
#include "refine/regions.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/sorted_list.h"

namespace deliso {
namespace {

Box3 box_of_facet(const TriMesh& mesh, FaceId f) {
  const Triangle& v = mesh.faces[f].v;
  return box_of(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
}

// The place of an id in an ascending list; that behind the last where it has none.
template <class Id>
std::size_t place_in(const std::vector<Id>& list, Id id) {
  const auto at = std::lower_bound(list.begin(), list.end(), id);
  return at == list.end() || *at != id ? list.size() : static_cast<std::size_t>(at - list.begin());
}

}  // namespace

Cut::Cut(const SurfaceMesh& whole, std::size_t most) {
  const std::vector<Face>& faces = whole.mesh.faces;
  if (faces.size() <= most) return;
  Leaf all;
  for (FaceId f = 0; f < faces.size(); ++f) {
    const Triangle& v = faces[f].v;
    const bool on_boundary =
        std::any_of(v.begin(), v.end(), [&](VertexId q) { return whole.chain.is_boundary(q); });
    (on_boundary ? all.frozen : all.facets).push_back(f);
  }
  nodes_.emplace_back();
  divide(whole, 0, std::move(all), most);
}

void Cut::divide(const SurfaceMesh& whole, std::size_t node, Leaf&& leaf, std::size_t most) {
  if (leaf.facets.size() <= most) {
    nodes_[node] = {-1, 0, leaves_.size()};
    std::sort(leaf.frozen.begin(), leaf.frozen.end());
    leaves_.push_back(std::move(leaf));
    return;
  }
  // Through the median, across the longest side.
  const auto corner = [&](FaceId f) -> const Vec3& {
    return whole.mesh.points[whole.mesh.faces[f].v[0]];
  };
  Box3 box{corner(leaf.facets[0]), corner(leaf.facets[0])};
  for (const FaceId f : leaf.facets) box = united(box, {corner(f), corner(f)});
  const Vec3 size = box.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::vector<double> places;
  places.reserve(leaf.facets.size());
  for (const FaceId f : leaf.facets) places.push_back(corner(f)[axis]);
  const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
  std::nth_element(places.begin(), middle, places.end());
  const double plane = *middle;

  Leaf below{leaf.box, {}, {}}, above = below;
  below.box.hi[axis] = plane;
  above.box.lo[axis] = plane;
  const auto distribute = [&](FaceId f, bool is_frozen) {
    const Box3 reach = box_of_facet(whole.mesh, f);
    const bool is_below = reach.lo[axis] < plane, is_above = reach.hi[axis] >= plane;
    is_frozen |= is_below && is_above;
    if (is_below) (is_frozen ? below.frozen : below.facets).push_back(f);
    if (is_above) (is_frozen ? above.frozen : above.facets).push_back(f);
  };
  for (const FaceId f : leaf.frozen) distribute(f, true);
  for (const FaceId f : leaf.facets) distribute(f, false);
  leaf = {};
  const std::size_t children = nodes_.size();
  nodes_[node] = {axis, plane, children};
  nodes_.resize(children + 2);
  divide(whole, children, std::move(below), most);
  divide(whole, children + 1, std::move(above), most);
}

std::size_t Cut::box_at(const Vec3& p) const {
  std::size_t node = 0;
  while (nodes_[node].axis >= 0) {
    node = nodes_[node].children + (p[nodes_[node].axis] >= nodes_[node].plane);
  }
  return nodes_[node].children;
}

MeshRegion Cut::extract(const SurfaceMesh& whole, std::size_t n) const {
  const Leaf& leaf = leaves_[n];
  MeshRegion region;
  region.region = leaf.box;
  region.region.first_free = FaceId(leaf.frozen.size());
  region.facets = leaf.frozen;
  region.facets.insert(region.facets.end(), leaf.facets.begin(), leaf.facets.end());
  for (const FaceId f : region.facets) {
    const Triangle& v = whole.mesh.faces[f].v;
    region.vertices.insert(region.vertices.end(), v.begin(), v.end());
  }
  sort_out(region.vertices);
  const auto facet_here = [&](FaceId f) {
    if (const std::size_t at = place_in(leaf.frozen, f); at < leaf.frozen.size()) {
      return FaceId(at);
    }
    const std::size_t at = place_in(leaf.facets, f);
    return at < leaf.facets.size() ? FaceId(leaf.frozen.size() + at) : kNoId;
  };
  SurfaceMesh& s = region.surface;
  for (const VertexId v : region.vertices) {
    s.mesh.points.push_back(whole.mesh.points[v]);
    if (!whole.pole_heights.empty()) s.pole_heights.push_back(whole.pole_heights[v]);
  }
  for (const FaceId f : region.facets) {
    Face face = whole.mesh.faces[f];
    for (VertexId& v : face.v) v = VertexId(place_in(region.vertices, v));
    for (FaceId& g : face.n) g = g == kNoId ? kNoId : facet_here(g);
    s.mesh.faces.push_back(face);
    s.duals.push_back(whole.duals[f]);
  }
  return region;
}

std::vector<FaceId> put_back(SurfaceMesh& whole, const MeshRegion& region) {
  const SurfaceMesh& s = region.surface;
  const std::size_t facets = whole.mesh.faces.size(), vertices = whole.mesh.points.size();
  const auto vertex = [&](VertexId v) {
    return v < region.vertices.size() ? region.vertices[v]
                                      : VertexId(vertices + v - region.vertices.size());
  };
  std::vector<FaceId> facet = region.facets;
  while (facet.size() < s.mesh.faces.size()) {
    facet.push_back(FaceId(facets + facet.size() - region.facets.size()));
  }
  whole.mesh.points.resize(vertices + s.mesh.points.size() - region.vertices.size());
  for (VertexId v = 0; v < s.mesh.points.size(); ++v) {
    whole.mesh.points[vertex(v)] = s.mesh.points[v];
  }
  if (!s.pole_heights.empty()) {
    whole.pole_heights.resize(whole.mesh.points.size());
    for (VertexId v = 0; v < s.mesh.points.size(); ++v) {
      whole.pole_heights[vertex(v)] = s.pole_heights[v];
    }
  }
  whole.mesh.faces.resize(facets + s.mesh.faces.size() - region.facets.size());
  whole.duals.resize(whole.mesh.faces.size());
  // Of what stays as it is only the neighbors in the region may be others now.
  for (FaceId f = 0; f < region.region.first_free; ++f) {
    Face& face = whole.mesh.faces[region.facets[f]];
    for (std::size_t i = 0; i < 3; ++i) {
      const FaceId g = s.mesh.faces[f].n[i];
      if (g != kNoId && g >= region.region.first_free) face.n[i] = facet[g];
    }
  }
  for (FaceId f = region.region.first_free; f < s.mesh.faces.size(); ++f) {
    Face face = s.mesh.faces[f];
    if (!is_dead(face)) {
      for (VertexId& v : face.v) v = vertex(v);
      for (FaceId& g : face.n) g = g == kNoId ? kNoId : facet[g];
    }
    whole.mesh.faces[facet[f]] = face;
    whole.duals[facet[f]] = s.duals[f];
  }
  return facet;
}

}  // namespace deliso
