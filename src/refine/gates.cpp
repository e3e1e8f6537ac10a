// SPDX-License-Identifier: MIT
// The tests G1 to G5 of refine/refinement.h.
#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "base/triangle.h"
#include "refine/refinement.h"

namespace deliso {
namespace {

// A component of more facets beside the cavity is not reversed by one replacement.
constexpr std::size_t kMaxSmallComponent = 32;

// G4, in bounds on the distance: how far a vertex that goes may lie from the new facets. It keeps
// protrusions that Stage 1 and the search for far samples have won: without it 99.9 % of Sigma lies
// within .7 voxel of the mesh on ANEURISM, with it within .25.
constexpr double kMaxLoss = 2;

double cosine(const Vec3& u, const Vec3& v) {
  return dot(u, v) / std::sqrt(length2(u) * length2(v));
}

}  // namespace

std::optional<Refusal> Refinement::test_shape(Change& c) {
  if (!keeps_manifold(c)) return Refusal::not_a_disk;
  normals_.clear();
  for (const Triangle& v : c.in.facets) {
    normals_.push_back(area_normal(point(v[0]), point(v[1]), point(v[2])));
  }
  if ((c.least_cosine > -1 && folds(c)) || reverses(c)) return Refusal::turned;
  return std::nullopt;
}

// G1. Boundary edges of the cavity with a facet across must all be on the new disk's boundary; what
// else is on either lies on the mesh's boundary.
bool Refinement::keeps_manifold(Change& c) {
  Disk& in = c.in;
  if (!in.link()) return false;
  across_.assign(in.boundary.size(), kNoId);
  kept_.assign(in.boundary.size(), 0);
  for (const Disk::BoundaryEdge& old : c.was.boundary) {
    const FaceId g = mesh.faces[c.cavity[old.facet]].n[old.side];
    const auto same = std::ranges::find_if(in.boundary, [&](const Disk::BoundaryEdge& e) {
      return e.from == old.from && e.to == old.to;
    });
    if (same == in.boundary.end()) {
      if (g == kNoId) continue;
      return false;
    }
    const auto k = static_cast<std::size_t>(same - in.boundary.begin());
    across_[k] = g;
    kept_[k] = 1;
    if (g == kNoId) continue;
    // A facet that is there already, seen from behind.
    const Triangle& t = in.facets[same->facet];
    const Triangle& there = mesh.faces[g].v;
    if (has_corner(there, t[0]) && has_corner(there, t[1]) && has_corner(there, t[2])) return false;
  }
  // A new edge, inside the new disk or along the mesh's boundary, between two vertices that are
  // joined elsewhere would have too many facets. With a new vertex at its end there can be none.
  const auto is_taken = [&](VertexId a, VertexId b) {
    const bool has_new = c.what == Change::Vertex::comes && (a == c.vertex || b == c.vertex);
    return !has_new && is_joined_outside(a, b, c);
  };
  for (std::uint32_t f = 0; f < in.facets.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      if (in.across[f][i] == Disk::kNone || in.across[f][i] < f) continue;
      if (is_taken(in.facets[f][(i + 1) % 3], in.facets[f][(i + 2) % 3])) return false;
    }
  }
  for (std::size_t k = 0; k < in.boundary.size(); ++k) {
    if (!kept_[k] && is_taken(in.boundary[k].from, in.boundary[k].to)) return false;
  }
  return true;
}

bool Refinement::is_joined_outside(VertexId a, VertexId b, const Change& c) {
  const auto start =
      std::ranges::find_if(c.cavity, [&](FaceId f) { return has_corner(mesh.faces[f].v, a); });
  DELISO_ASSERT(start != c.cavity.end());
  facets_around(mesh, *start, a, star_);
  return std::ranges::any_of(
      star_, [&](FaceId f) { return !is_out(f) && has_corner(mesh.faces[f].v, b); });
}

// G2.
bool Refinement::folds(const Change& c) {
  double before = 1, after = 1;
  const auto normal_before = [&](FaceId f) {
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId v = mesh.faces[f].v[i];
      p[i] = c.what == Change::Vertex::moves && v == c.vertex ? moved_from_ : point(v);
    }
    return area_normal(p[0], p[1], p[2]);
  };
  for (const FaceId f : c.cavity) {
    for (const FaceId g : mesh.faces[f].n) {
      if (g != kNoId && (g > f || !is_out(g))) {
        before = std::min(before, cosine(normal_before(f), normal_before(g)));
      }
    }
  }
  const Disk& in = c.in;
  for (std::uint32_t f = 0; f < in.facets.size(); ++f) {
    for (const std::uint32_t g : in.across[f]) {
      if (g != Disk::kNone && g > f) after = std::min(after, cosine(normals_[f], normals_[g]));
    }
  }
  for (std::size_t k = 0; k < in.boundary.size(); ++k) {
    if (across_[k] == kNoId) continue;
    after = std::min(after, cosine(normals_[in.boundary[k].facet], normal_before(across_[k])));
  }
  return !(after >= std::min(c.least_cosine, before));
}

// G2, for components of few facets: the sign of the volume that one bounds says which side is
// which. Seen from a point in all faces of the box that it meets, what it leaves open adds nothing.
bool Refinement::reverses(const Change& c) {
  if (parameters.as_published) return false;
  seen_.resize(mesh.faces.size(), 0);
  ++seen_stamp_;
  rest_.clear();
  const Box3 box = surface.volume().box();
  Vec3 origin = point(c.in.facets[0][0]);
  std::array<double, 3> met{};  // -1, 1: the component meets that face of the box
  bool is_between_faces = false;
  const auto meet_box = [&](VertexId a, VertexId b) {
    for (int axis = 0; axis < 3; ++axis) {
      const double at = point(a)[axis];
      if (point(b)[axis] != at || (at != box.lo[axis] && at != box.hi[axis])) continue;
      double& before = met[static_cast<std::size_t>(axis)];
      const double now = at == box.lo[axis] ? -1 : 1;
      is_between_faces |= before == -now;
      before = now;
      origin[axis] = at;
    }
  };
  const auto go_on = [&](FaceId f) {
    if (is_out(f) || seen_[f] == seen_stamp_) return;
    seen_[f] = seen_stamp_;
    rest_.push_back(f);
  };
  for (std::size_t k = 0; k < across_.size(); ++k) {
    if (across_[k] == kNoId) {
      meet_box(c.in.boundary[k].from, c.in.boundary[k].to);
    } else {
      go_on(across_[k]);
    }
  }
  for (std::size_t next = 0; next < rest_.size();) {
    if (rest_.size() > kMaxSmallComponent || is_between_faces) return false;
    if (is_frozen(rest_[next])) return false;  // it may go on where nothing is seen of it
    const Face& face = mesh.faces[rest_[next++]];
    for (int i = 0; i < 3; ++i) {
      if (face.n[i] == kNoId) {
        meet_box(face.v[(i + 1) % 3], face.v[(i + 2) % 3]);
      } else {
        go_on(face.n[i]);
      }
    }
  }
  const auto volume = [&](const Triangle& v, auto&& at) {
    return dot(at(v[0]) - origin, cross(at(v[1]) - origin, at(v[2]) - origin));
  };
  const auto now = [&](VertexId v) { return point(v); };
  const auto was = [&](VertexId v) {
    return c.what == Change::Vertex::moves && v == c.vertex ? moved_from_ : point(v);
  };
  double rest = 0, before = 0, after = 0;
  for (const FaceId f : rest_) rest += volume(mesh.faces[f].v, now);
  for (const Triangle& v : c.was.facets) before += volume(v, was);
  for (const Triangle& v : c.in.facets) after += volume(v, now);
  if (c.topology_only && rest + before == 0) return false;
  return (rest + before > 0) != (rest + after > 0);
}

// G3, and G4 for the vertices that go.
std::optional<Refusal> Refinement::find_duals(Change& c) {
  c.duals.clear();
  std::ptrdiff_t allowed = facets_without_point(c);
  for (std::size_t f = 0; f < c.in.facets.size(); ++f) {
    if (!find_dual(c, f, allowed)) return Refusal::no_surface_point;
  }
  return uncovers(c) ? std::optional(Refusal::uncovers) : std::nullopt;
}

std::ptrdiff_t Refinement::facets_without_point(const Change& c) const {
  return std::ranges::count_if(c.cavity, [&](FaceId f) {
    return !s.duals[f].on_surface && !(s.duals[f].radius2 <= parameters.r_min * parameters.r_min);
  });
}

bool Refinement::find_dual(Change& c, std::size_t f, std::ptrdiff_t& allowed) {
  const Triangle& v = c.in.facets[f];
  c.duals.push_back(finder.dual(point(v[0]), point(v[1]), point(v[2]), report.searches_refine));
  const Dual& dual = c.duals.back();
  if (dual.on_surface || c.topology_only) return true;
  const bool is_small = dual.radius2 <= parameters.r_min * parameters.r_min;
  return (is_small && faces_out(v, normals_[f])) || allowed-- > 0;
}

bool Refinement::faces_out(const Triangle& v, const Vec3& normal) const {
  Vec3 sum;
  for (const VertexId q : v) {
    const Vec3 gradient = surface.gradient(point(q));
    const double steepness = length(gradient);
    if (steepness > 0) sum = sum + gradient / steepness;
  }
  return dot(sum, normal) < 0;
}

bool Refinement::uncovers(const Change& c) const {
  const double limit = kMaxLoss * parameters.refinement[Criterion::distance];
  if (c.topology_only || c.what == Change::Vertex::comes) return false;
  return std::ranges::any_of(c.was.vertices(), [&](VertexId v) {
    if (std::ranges::find(c.in.vertices(), v) != c.in.vertices().end()) return false;
    return std::ranges::all_of(c.in.facets, [&](const Triangle& t) {
      return distance2_to_triangle(point(v), point(t[0]), point(t[1]), point(t[2])) > limit * limit;
    });
  });
}

// G5.
bool Refinement::crosses(const Change& c) {
  if (parameters.as_published) return false;
  if (!crossing_.begin(mesh.points, c.in, normals_, facets_)) return true;
  const bool is_cone = c.what == Change::Vertex::comes && c.in.inner_vertices() == 1;
  return crossing_.crosses_itself(is_cone ? c.vertex : kNoId) ||
         facets_.any(crossing_.box(), [&](FaceId f, const BoxGrid::Box& box) {
           return !is_out(f) && crossing_.crosses(mesh.faces[f].v, box);
         });
}

}  // namespace deliso
