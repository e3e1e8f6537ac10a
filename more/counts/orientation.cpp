// SPDX-License-Identifier: MIT
#include "more/counts/orientation.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/triangle.h"

namespace deliso {
namespace {

// Side of the cells that hold vertices of components: about as large as a star.
constexpr double kCellVoxels = 8;

// True if q lies in the tetrahedron or on it.
bool is_in_tetrahedron(const std::array<Vec3, 4>& corners, const Vec3& q) {
  bool positive = false, negative = false;
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<Vec3, 4> p = corners;
    p[i] = q;
    const double volume = sixfold_volume(p[0], p[1], p[2], p[3]);
    positive |= volume > 0;
    negative |= volume < 0;
  }
  return !(positive && negative);
}

}  // namespace

Orientation::Orientation(const Refinement& r)
    : r_(r), vertices_(r.surface.volume().box(), kCellVoxels * r.parameters.voxel) {
  DisjointSets sets(r.mesh.points.size());
  for (const Face& face : r.mesh.faces) {
    if (is_dead(face)) continue;
    sets.unite(face.v[0], face.v[1]);
    sets.unite(face.v[0], face.v[2]);
  }
  component_ = sets.take_numbers();
  components_.resize(component_.empty() ? 0 : 1 + *std::ranges::max_element(component_));
  for (VertexId v = 0; v < component_.size(); ++v) components_[component_[v]].origin = r.point(v);
  for (const Face& face : r.mesh.faces) {
    if (is_dead(face)) continue;
    Component& c = components_[component_[face.v[0]]];
    c.is_closed &= std::ranges::find(face.n, FaceId(kNoId)) == face.n.end();
    c.volume += volume_from(c.origin, face.v);
    c.vertex = face.v[0];
  }
  for (std::uint32_t n = 0; n < components_.size(); ++n) {
    const VertexId v = components_[n].vertex;
    if (v != kNoId) vertices_.add(n, vertices_.box_of(r.point(v)));
  }
  std::vector<std::uint8_t> is_added;
  for (VertexId v = 0; v < r.s.chain.vertex_capacity(); ++v) {
    if (!r.s.chain.is_boundary(v)) continue;
    const std::uint32_t number = r.s.chain.place(v).loop;
    loops_.resize(std::max<std::size_t>(loops_.size(), number + 1));
    is_added.resize(loops_.size(), 0);
    if (!std::exchange(is_added[number], 1)) add_loop(v);
  }
}

double Orientation::volume_from(const Vec3& origin, const Triangle& v) const {
  return sixfold_volume(origin, r_.point(v[0]), r_.point(v[1]), r_.point(v[2]));
}

void Orientation::add_loop(VertexId start) {
  const BoundaryChain& chain = r_.s.chain;
  const Box3 box = r_.surface.volume().box();
  Loop& loop = loops_[chain.place(start).loop];
  const unsigned face = box_faces_at(r_.point(start), box);
  if (!std::has_single_bit(face)) return;
  const int axis = std::countr_zero(face) / 2;
  VertexId v = start;
  do {
    const VertexId next = chain.next(v);
    if (box_faces_at(r_.point(next), box) != face) return;
    loop.area += cross(r_.point(v) - r_.point(start), r_.point(next) - r_.point(start))[axis];
    v = next;
  } while (v != start);
  loop.axis = axis;
}

// The facets at `from`, each with `to`, are tetrahedra that cover what is swept.
bool Orientation::passes_component(const Disk& star, VertexId from, const Vec3& to) const {
  if (components_.size() < 2) return false;
  std::vector<Vec3> points;
  for (const VertexId v : star.vertices()) points.push_back(r_.point(v));
  points.push_back(to);
  return vertices_.any<std::uint32_t>(
      vertices_.box_of(points), [&](std::uint32_t n, const BoxGrid::Box&) {
        if (component_[from] == n) return false;
        return std::ranges::any_of(star.facets, [&](const Triangle& v) {
          return is_in_tetrahedron({r_.point(v[0]), r_.point(v[1]), r_.point(v[2]), to},
                                   r_.point(components_[n].vertex));
        });
      });
}

void Orientation::merged(VertexId from, VertexId to) {
  if (sum_) *sum_ += change_;
  const std::uint32_t n = component_[from];
  if (components_[n].vertex != from) return;
  components_[n].vertex = to;
  vertices_.remove(n);
  vertices_.add(n, vertices_.box_of(r_.point(to)));
}

bool Orientation::reverses(std::span<const FaceId> star, VertexId from, const Vec3& to) {
  const BoundaryChain& chain = r_.s.chain;
  sum_ = nullptr;
  change_ = 0;
  if (chain.is_boundary(from)) {
    Loop& loop = loops_[chain.place(from).loop];
    if (loop.axis < 0) return false;
    const VertexId before = chain.previous(from), next = chain.next(from);
    sum_ = &loop.area;
    change_ = -r_.normal({before, from, next})[loop.axis];
  } else {
    Component& c = components_[component_[from]];
    if (!c.is_closed) return false;
    sum_ = &c.volume;
    for (const FaceId f : star) {
      const Triangle& v = r_.mesh.faces[f].v;
      const auto after = [&](VertexId u) { return u == from ? to : r_.point(u); };
      change_ += sixfold_volume(c.origin, after(v[0]), after(v[1]), after(v[2]));
      change_ -= volume_from(c.origin, v);
    }
  }
  return *sum_ != 0 && !(*sum_ * (*sum_ + change_) > 0);
}

}  // namespace deliso
