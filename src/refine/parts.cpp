// SPDX-License-Identifier: MIT
#include "refine/parts.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/sorted_list.h"

namespace deliso {
namespace {

Vec3 low_corner(const std::vector<Vec3>& p, const Triangle& v) {
  return {std::min({p[v[0]].x, p[v[1]].x, p[v[2]].x}), std::min({p[v[0]].y, p[v[1]].y, p[v[2]].y}),
          std::min({p[v[0]].z, p[v[1]].z, p[v[2]].z})};
}

Vec3 high_corner(const std::vector<Vec3>& p, const Triangle& v) {
  return {std::max({p[v[0]].x, p[v[1]].x, p[v[2]].x}), std::max({p[v[0]].y, p[v[1]].y, p[v[2]].y}),
          std::max({p[v[0]].z, p[v[1]].z, p[v[2]].z})};
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
    (on_boundary ? all.fixed : all.facets).push_back(f);
  }
  nodes_.emplace_back();
  divide(whole, 0, std::move(all), most);
}

void Cut::divide(const SurfaceMesh& whole, std::size_t node, Leaf&& leaf, std::size_t most) {
  if (leaf.facets.size() <= most) {
    nodes_[node] = {-1, 0, leaves_.size()};
    std::sort(leaf.fixed.begin(), leaf.fixed.end());
    leaves_.push_back(std::move(leaf));
    return;
  }
  // Through the median, across the longest side.
  const std::vector<Vec3>& p = whole.mesh.points;
  const auto corners = [&](FaceId f) -> const Triangle& { return whole.mesh.faces[f].v; };
  Vec3 lo = p[corners(leaf.facets[0])[0]], hi = lo;
  for (const FaceId f : leaf.facets) {
    const Vec3& q = p[corners(f)[0]];
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], q[axis]);
      hi[axis] = std::max(hi[axis], q[axis]);
    }
  }
  const Vec3 size = hi - lo;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::vector<double> places;
  places.reserve(leaf.facets.size());
  for (const FaceId f : leaf.facets) places.push_back(p[corners(f)[0]][axis]);
  const auto middle = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
  std::nth_element(places.begin(), middle, places.end());
  const double plane = *middle;

  Leaf below{leaf.box, {}, {}}, above = below;
  below.box.hi[axis] = plane;
  above.box.lo[axis] = plane;
  const auto distribute = [&](FaceId f, bool is_fixed) {
    const double low = low_corner(p, corners(f))[axis], high = high_corner(p, corners(f))[axis];
    const bool straddles = low < plane && high >= plane;
    if (low < plane) (is_fixed || straddles ? below.fixed : below.facets).push_back(f);
    if (high >= plane) (is_fixed || straddles ? above.fixed : above.facets).push_back(f);
  };
  for (const FaceId f : leaf.fixed) distribute(f, true);
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

MeshPart Cut::take(const SurfaceMesh& whole, std::size_t n) const {
  const Leaf& leaf = leaves_[n];
  MeshPart part;
  part.part = leaf.box;
  part.part.first = static_cast<FaceId>(leaf.fixed.size());
  part.facets = leaf.fixed;
  part.facets.insert(part.facets.end(), leaf.facets.begin(), leaf.facets.end());
  // Numbers of vertices and facets here, by those in the whole mesh; in its order.
  for (const FaceId f : part.facets) {
    const Triangle& v = whole.mesh.faces[f].v;
    part.vertices.insert(part.vertices.end(), v.begin(), v.end());
  }
  sort_out(part.vertices);
  const auto vertex_here = [&](VertexId v) {
    const auto at = std::lower_bound(part.vertices.begin(), part.vertices.end(), v);
    return static_cast<VertexId>(at - part.vertices.begin());
  };
  const auto facet_here = [&](FaceId f) {
    for (const auto& [begin, end] : {std::pair{std::size_t{0}, leaf.fixed.size()},
                                     std::pair{leaf.fixed.size(), part.facets.size()}}) {
      const auto first = part.facets.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto last = part.facets.begin() + static_cast<std::ptrdiff_t>(end);
      const auto at = std::lower_bound(first, last, f);
      if (at != last && *at == f) return static_cast<FaceId>(at - part.facets.begin());
    }
    return kNoId;
  };
  SurfaceMesh& s = part.surface;
  for (const VertexId v : part.vertices) {
    s.mesh.points.push_back(whole.mesh.points[v]);
    if (!whole.pole_heights.empty()) s.pole_heights.push_back(whole.pole_heights[v]);
  }
  for (const FaceId f : part.facets) {
    Face face = whole.mesh.faces[f];
    for (VertexId& v : face.v) v = vertex_here(v);
    for (FaceId& g : face.n) g = g == kNoId ? kNoId : facet_here(g);
    s.mesh.faces.push_back(face);
    s.duals.push_back(whole.duals[f]);
  }
  return part;
}

void put_back(SurfaceMesh& whole, const MeshPart& part) {
  const SurfaceMesh& s = part.surface;
  const std::size_t facets = whole.mesh.faces.size(), vertices = whole.mesh.points.size();
  const auto vertex = [&](VertexId v) {
    return v < part.vertices.size() ? part.vertices[v]
                                    : static_cast<VertexId>(vertices + v - part.vertices.size());
  };
  const auto facet = [&](FaceId f) { return in_whole(part, f, facets); };
  whole.mesh.points.resize(vertices + s.mesh.points.size() - part.vertices.size());
  for (VertexId v = 0; v < s.mesh.points.size(); ++v) {
    whole.mesh.points[vertex(v)] = s.mesh.points[v];
  }
  if (!s.pole_heights.empty()) {
    whole.pole_heights.resize(whole.mesh.points.size());
    for (VertexId v = 0; v < s.mesh.points.size(); ++v) {
      whole.pole_heights[vertex(v)] = s.pole_heights[v];
    }
  }
  whole.mesh.faces.resize(facets + s.mesh.faces.size() - part.facets.size());
  whole.duals.resize(whole.mesh.faces.size());
  // Of what stays as it is only the neighbours in the part may be others now.
  for (FaceId f = 0; f < part.part.first; ++f) {
    Face& face = whole.mesh.faces[part.facets[f]];
    for (std::size_t i = 0; i < 3; ++i) {
      const FaceId g = s.mesh.faces[f].n[i];
      if (g != kNoId && g >= part.part.first) face.n[i] = facet(g);
    }
  }
  for (FaceId f = part.part.first; f < s.mesh.faces.size(); ++f) {
    Face face = s.mesh.faces[f];
    if (!is_dead(face)) {
      for (VertexId& v : face.v) v = vertex(v);
      for (FaceId& g : face.n) g = g == kNoId ? kNoId : facet(g);
    }
    whole.mesh.faces[facet(f)] = face;
    whole.duals[facet(f)] = s.duals[f];
  }
}

}  // namespace deliso
