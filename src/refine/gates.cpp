// SPDX-License-Identifier: MIT
// The gates G1 to G3 and G5 of refine/replace_disk.h; G4 is the proposer's.
#include <algorithm>
#include <cmath>

#include "base/check.h"
#include "delaunay/predicates.h"
#include "embedding/triangle_pair.h"
#include "refine/replace_disk.h"

namespace deliso {
namespace {

// What a component has at most, beside the disk, that a change might turn inside out.
constexpr std::size_t kFewFacets = 32;

// Of the size of what is compared.
constexpr double kMargin = 1e-10;

double cosine(const Vec3& u, const Vec3& v) {
  return dot(u, v) / std::sqrt(length2(u) * length2(v));
}

}  // namespace

std::optional<Refusal> DiskReplacer::look_at(Change& change) {
  if (!keeps_manifold(change)) return Refusal::not_a_disk;
  normals_.clear();
  for (const Triangle& v : change.in.facets) {
    normals_.push_back(area_normal(point(v[0]), point(v[1]), point(v[2])));
  }
  if ((change.least_cosine > -1 && turns(change)) || turns_inside_out(change)) {
    return Refusal::turned;
  }
  if (!find_duals(change)) return Refusal::no_surface_point;
  return std::nullopt;
}

// G1. The old disk's rim edges with a facet beyond are all on the new one's rim; what else is on
// either is boundary.
bool DiskReplacer::keeps_manifold(Change& change) {
  Patch& in = change.in;
  if (!in.link()) return false;
  beyond_.assign(in.rim.size(), kNoId);
  kept_.assign(in.rim.size(), 0);
  for (const Patch::RimEdge& old : change.was.rim) {
    const FaceId g = mesh_.faces[change.out[old.facet]].n[old.side];
    const auto same = std::find_if(in.rim.begin(), in.rim.end(), [&](const Patch::RimEdge& e) {
      return e.from == old.from && e.to == old.to;
    });
    if (same == in.rim.end()) {
      if (g == kNoId) continue;
      return false;
    }
    const auto k = static_cast<std::size_t>(same - in.rim.begin());
    beyond_[k] = g;
    kept_[k] = 1;
    if (g == kNoId) continue;
    // A facet that is there already, seen from behind.
    const Triangle& t = in.facets[same->facet];
    const Triangle& there = mesh_.faces[g].v;
    if (has_corner(there, t[0]) && has_corner(there, t[1]) && has_corner(there, t[2])) return false;
  }
  // A new edge, inside the new disk or along the boundary, between two vertices that are joined
  // elsewhere would have too many facets. With a new vertex at its end there can be none.
  const auto is_taken = [&](VertexId a, VertexId b) {
    const bool has_new =
        change.what == Change::Vertex::comes && (a == change.vertex || b == change.vertex);
    return !has_new && is_joined_outside(a, b, change);
  };
  for (std::uint32_t f = 0; f < in.facets.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      if (in.beyond[f][i] == Patch::kRim || in.beyond[f][i] < f) continue;
      if (is_taken(in.facets[f][(i + 1) % 3], in.facets[f][(i + 2) % 3])) return false;
    }
  }
  for (std::size_t k = 0; k < in.rim.size(); ++k) {
    if (!kept_[k] && is_taken(in.rim[k].from, in.rim[k].to)) return false;
  }
  return true;
}

bool DiskReplacer::is_joined_outside(VertexId a, VertexId b, const Change& change) {
  const auto start = std::find_if(change.out.begin(), change.out.end(),
                                  [&](FaceId f) { return has_corner(mesh_.faces[f].v, a); });
  DELISO_ASSERT(start != change.out.end());
  facets_around(mesh_, *start, a, star_);
  return std::any_of(star_.begin(), star_.end(),
                     [&](FaceId f) { return !is_out(f) && has_corner(mesh_.faces[f].v, b); });
}

// G2.
bool DiskReplacer::turns(const Change& change) {
  double before = 1, after = 1;
  const auto normal_of = [&](FaceId f) {
    const Triangle& v = mesh_.faces[f].v;
    return area_normal(point(v[0]), point(v[1]), point(v[2]));
  };
  const auto normal_before = [&](FaceId f) {
    if (change.what != Change::Vertex::moves) return normal_of(f);
    Triangle v = mesh_.faces[f].v;
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = v[i] == change.vertex ? moved_from_ : point(v[i]);
    return area_normal(p[0], p[1], p[2]);
  };
  for (const FaceId f : change.out) {
    for (const FaceId g : mesh_.faces[f].n) {
      if (g != kNoId && (g > f || !is_out(g))) {
        before = std::min(before, cosine(normal_before(f), normal_before(g)));
      }
    }
  }
  const Patch& in = change.in;
  for (std::uint32_t f = 0; f < in.facets.size(); ++f) {
    for (const std::uint32_t g : in.beyond[f]) {
      if (g != Patch::kRim && g > f) after = std::min(after, cosine(normals_[f], normals_[g]));
    }
  }
  for (std::size_t k = 0; k < in.rim.size(); ++k) {
    if (beyond_[k] == kNoId) continue;
    after = std::min(after, cosine(normals_[in.rim[k].facet], normal_of(beyond_[k])));
  }
  return !(after >= std::min(change.least_cosine, before));
}

// G2, for components of few facets: the sign of the volume that one bounds says which side is
// which. Seen from a point in all faces of the box that it meets, what it leaves open adds nothing.
bool DiskReplacer::turns_inside_out(const Change& change) {
  if (parameters_.as_published) return false;
  seen_.resize(mesh_.faces.size(), 0);
  ++seen_stamp_;
  rest_.clear();
  const Box3 box = surface_.volume().box();
  Vec3 origin = point(change.in.facets[0][0]);
  std::array<double, 3> met{};  // -1, 1: the component meets that face
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
  const auto reach = [&](FaceId f) {
    if (is_out(f) || seen_[f] == seen_stamp_) return;
    seen_[f] = seen_stamp_;
    rest_.push_back(f);
  };
  for (std::size_t k = 0; k < beyond_.size(); ++k) {
    if (beyond_[k] == kNoId) {
      meet_box(change.in.rim[k].from, change.in.rim[k].to);
    } else {
      reach(beyond_[k]);
    }
  }
  for (std::size_t done = 0; done < rest_.size();) {
    if (rest_.size() > kFewFacets || is_between_faces) return false;
    if (is_fixed(rest_[done])) return false;  // it may go on where nothing is seen of it
    const Face& face = mesh_.faces[rest_[done++]];
    for (int i = 0; i < 3; ++i) {
      if (face.n[i] == kNoId) {
        meet_box(face.v[(i + 1) % 3], face.v[(i + 2) % 3]);
      } else {
        reach(face.n[i]);
      }
    }
  }
  const auto volume = [&](const Triangle& v, auto&& at) {
    return dot(at(v[0]) - origin, cross(at(v[1]) - origin, at(v[2]) - origin));
  };
  const auto now = [&](VertexId v) { return point(v); };
  const auto was = [&](VertexId v) {
    return change.what == Change::Vertex::moves && v == change.vertex ? moved_from_ : point(v);
  };
  double rest = 0, before = 0, after = 0;
  for (const FaceId f : rest_) rest += volume(mesh_.faces[f].v, now);
  for (const Triangle& v : change.was.facets) before += volume(v, was);
  for (const Triangle& v : change.in.facets) after += volume(v, now);
  if (change.leaves_box && rest + before == 0) return false;
  return (rest + before > 0) != (rest + after > 0);
}

// G3.
bool DiskReplacer::find_duals(Change& change) {
  change.duals.clear();
  const auto is_large = [&](const Dual& dual) {
    return !(dual.radius2 <= parameters_.r_min * parameters_.r_min);
  };
  auto allowed = std::count_if(change.out.begin(), change.out.end(), [&](FaceId f) {
    return !s_.duals[f].on_surface && is_large(s_.duals[f]);
  });
  for (std::size_t f = 0; f < change.in.facets.size(); ++f) {
    const Triangle& v = change.in.facets[f];
    change.duals.push_back(finder_.dual(point(v[0]), point(v[1]), point(v[2]), searches()));
    const Dual& dual = change.duals.back();
    if (dual.on_surface) continue;
    if (change.leaves_box) continue;
    if ((is_large(dual) || !faces_out(v, normals_[f])) && allowed-- == 0) return false;
  }
  return true;
}

bool DiskReplacer::faces_out(const Triangle& v, const Vec3& normal) const {
  Vec3 sum;
  for (const VertexId q : v) {
    const Vec3 gradient = surface_.gradient(point(q));
    const double steepness = length(gradient);
    if (steepness > 0) sum = sum + gradient / steepness;
  }
  return dot(sum, normal) < 0;
}

// G5.
bool DiskReplacer::crosses(const Change& change) {
  if (parameters_.as_published) return false;
  const std::vector<Triangle>& in = change.in.facets;
  boxes_.clear();
  for (const Triangle& t : in) {
    if (collinear(point(t[0]), point(t[1]), point(t[2]))) return true;
    boxes_.push_back(facets_.box_of(mesh_.points, t));
  }
  if (!is_fan(change)) {
    for (std::size_t f = 0; f < in.size(); ++f) {
      for (std::size_t g = f + 1; g < in.size(); ++g) {
        if (BoxGrid::meet(boxes_[f], boxes_[g]) && meet(change, f, in[g])) return true;
      }
    }
  }
  BoxGrid::Box all = boxes_[0];
  for (const BoxGrid::Box& box : boxes_) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      all.lo[axis] = std::min(all.lo[axis], box.lo[axis]);
      all.hi[axis] = std::max(all.hi[axis], box.hi[axis]);
    }
  }
  raise_walls(change);
  return facets_.any(all, [&](FaceId g, const BoxGrid::Box& box) {
    if (is_out(g)) return false;
    const Triangle& there = mesh_.faces[g].v;
    if ((behind(there[0]) & behind(there[1]) & behind(there[2])) != 0) return false;
    for (std::size_t f = 0; f < in.size(); ++f) {
      if (BoxGrid::meet(boxes_[f], box) && meet(change, f, there)) return true;
    }
    return false;
  });
}

// The facets are all those at one inner vertex, and seen along the mean of their normals, by more
// than rounding, each runs around that vertex the same way, and all of them together once: then
// they lie side by side there, and do not cross.
bool DiskReplacer::is_fan(const Change& change) const {
  const std::vector<Triangle>& in = change.in.facets;
  if (change.what != Change::Vertex::comes || change.in.inner_vertices() != 1) return false;
  const Vec3& center = change.place;
  Vec3 along;
  double longest2 = 0;
  for (std::size_t f = 0; f < in.size(); ++f) {
    if (in[f][2] != change.vertex) return false;
    along = along + normals_[f];
    longest2 = std::max(longest2, distance2(point(in[f][0]), center));
  }
  const double margin =
      kMargin * longest2 * (std::fabs(along.x) + std::fabs(along.y) + std::fabs(along.z));
  const VertexId first = in[0][0];
  const Vec3 across = cross(along, point(first) - center);
  int rounds = 0;
  for (std::size_t f = 0; f < in.size(); ++f) {
    if (!(dot(normals_[f], along) > margin)) return false;
    const double from = in[f][0] == first ? 0 : dot(across, point(in[f][0]) - center);
    const double to = in[f][1] == first ? 0 : dot(across, point(in[f][1]) - center);
    if (in[f][0] != first && !(std::fabs(from) > margin)) return false;
    rounds += from < 0 && to >= 0;
  }
  return rounds == 1;
}

// The planes that stand upright on facets of the new disk, through its rim, and have all of it
// before them.
void DiskReplacer::raise_walls(const Change& change) {
  walls_.clear();
  ++wall_stamp_;
  behind_.resize(mesh_.points.size());
  for (const Patch::RimEdge& edge : change.in.rim) {
    const Side side = upright(change.in.facets[edge.facet], normals_[edge.facet], edge.side);
    const std::span<const VertexId> vertices = change.in.vertices();
    if (walls_.size() < kMostWalls &&
        std::all_of(vertices.begin(), vertices.end(), [&](VertexId v) {
          return v == side.from || v == side.to || is_off(side, v, -1);
        })) {
      walls_.push_back(side);
    }
  }
}

// Bit n: v lies behind wall n, or at its foot. Where all corners of a facet do, the wall parts it
// from the disk.
std::uint32_t DiskReplacer::behind(VertexId v) {
  Behind& known = behind_[v];
  if (known.stamp == wall_stamp_) return known.walls;
  known = {wall_stamp_, 0};
  for (std::size_t n = 0; n < walls_.size(); ++n) {
    const Side& wall = walls_[n];
    const bool is_behind = v == wall.from || v == wall.to || is_off(wall, v, 1);
    known.walls |= static_cast<std::uint32_t>(is_behind) << n;
  }
  return known.walls;
}

DiskReplacer::Side DiskReplacer::upright(const Triangle& t, const Vec3& normal, int i) const {
  const VertexId from = t[(i + 1) % 3], to = t[(i + 2) % 3];
  const Vec3& origin = point(from);
  const Vec3 outwards = cross(point(to) - origin, normal);
  return {from, to, origin, outwards,
          kMargin * (std::fabs(outwards.x) + std::fabs(outwards.y) + std::fabs(outwards.z))};
}

bool DiskReplacer::is_off(const Side& side, VertexId v, double sign) const {
  const Vec3 w = point(v) - side.origin;
  const double reach = std::fabs(w.x) + std::fabs(w.y) + std::fabs(w.z);
  return sign * dot(side.outwards, w) > side.margin * reach;
}

bool DiskReplacer::is_beyond(const Side& side, const Triangle& t) const {
  return std::all_of(t.begin(), t.end(), [&](VertexId v) {
    return v == side.from || v == side.to || is_off(side, v, 1);
  });
}

// A plane through a side of one triangle that has the triangle's third corner, `inside`, on one
// side and the other triangle on the other parts the two but for what they share. By a margin that
// rounding stays far below; planes that do it exactly are a little way off.
inline bool DiskReplacer::parts(const Side& side, VertexId inside, const Triangle& other) const {
  return is_beyond(side, other) && is_off(side, inside, -1);
}

bool DiskReplacer::meet(const Change& change, std::size_t f, const Triangle& t) const {
  const Triangle& s = change.in.facets[f];
  // The side that an insertion's cone has on the rim first.
  for (const int i : {2, 0, 1}) {
    if (parts(upright(s, normals_[f], i), s[static_cast<std::size_t>(i)], t)) return false;
  }
  const Vec3 &a = point(t[0]), &b = point(t[1]), &c = point(t[2]);
  const Vec3 normal = area_normal(a, b, c);
  for (int i = 0; i < 3; ++i) {
    if (parts(upright(t, normal, i), t[static_cast<std::size_t>(i)], s)) return false;
  }
  return !collinear(a, b, c) && triangles_intersect(mesh_.points, s, t);
}

}  // namespace deliso
