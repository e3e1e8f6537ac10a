// SPDX-License-Identifier: MIT
// What the borders of bodies must be, counted anew from the fields at the samples alone.
//
// The points of the lattice are the samples, the middles of faces and those of voxels. A middle
// belongs to the body of one of its corners, with the largest mean of the fields. Each voxel is cut
// into 24 tetrahedra, from its middle over the middles of its faces to the ends of its edges. The
// points of a body span a full subcomplex S. Its region R is a regular neighborhood of S
// (docs/proof-more.md), and so is R's part of the box's surface one of S', the simplices of S
// there. Hence
//   O1  R has the components of S. Around each there is one surface for each component of the other
//       points, and one outside of the box: the bounded ones lie within the component's own box.
//   O2  The closed surface of R has the Euler number 2 chi(S).
//   O3  Of it the box's faces hold R', which has chi(R') = chi(S'); the two parts share curves,
//       whose Euler number is 0. So the surface that ends on the box has 2 chi(S) - chi(S').
//   O4  A component of R' is a sphere with holes, of Euler number 2 - holes: there are
//       2 components(S') - chi(S') curves.
//   O5  In a simplex the border of R is a cell that meets its edges between R and the rest. So the
//       components of the surface that ends on the box are those of such edges, two of which are
//       neighbors in a triangle.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "base/text.h"
#include "check/check_mesh.h"
#include "check/place_faults.h"
#include "check/quality.h"
#include "mesh/tri_mesh.h"
#include "more/bodies/bodies.h"
#include "more/bodies/label_complex.h"
#include "more/bodies/partition.h"
#include "volume/sampled.h"

namespace deliso::stress {

// Points of the lattice are counted in half steps of the samples: a sample has even places, the
// middle of a face two odd ones, that of a voxel three.
class LabelOracle {
 public:
  explicit LabelOracle(const Partition& partition)
      : dims_(partition.shape().dims() + partition.shape().voxels()), bodies_(partition.size()) {
    for_each_index(dims_, [&](int i, int j, int k) {
      const int odd = odd_axes({i, j, k});
      body_.push_back(odd == 0   ? partition.body_at({i / 2, j / 2, k / 2})
                      : odd == 2 ? body_of_face(partition, {i, j, k})
                                 : kNoId);
    });
    for_each_index(dims_, [&](int i, int j, int k) {
      if (odd_axes({i, j, k}) != 3) return;
      body_[index({i, j, k})] = body_of_voxel(partition, {i, j, k});
    });
    make_simplices();
    count_simplices();
    add_surfaces();
    add_pieces();
  }

  // Returns the counts of a body's surface with its faces on the box, and of that which ends there.
  const TopologyCounts& closed(BodyId body) const { return bodies_[body].closed; }
  const TopologyCounts& open(BodyId body) const { return bodies_[body].open; }

 private:
  struct Body {
    TopologyCounts closed, open;
  };
  using Simplex = std::vector<Index3>;

  std::size_t index(Index3 p) const {
    return static_cast<std::size_t>(p.i) +
           static_cast<std::size_t>(dims_.i) *
               (static_cast<std::size_t>(p.j) +
                static_cast<std::size_t>(dims_.j) * static_cast<std::size_t>(p.k));
  }
  static int odd_axes(Index3 p) { return (p.i & 1) + (p.j & 1) + (p.k & 1); }

  // The samples around a point of the lattice.
  static std::vector<Index3> corners(int i, int j, int k) {
    std::set<std::array<int, 3>> found;
    for (int m = 0; m < 8; ++m) {
      found.insert({(i + (m & 1)) / 2, (j + (m >> 1 & 1)) / 2, (k + (m >> 2)) / 2});
    }
    std::vector<Index3> samples;
    for (const auto& [x, y, z] : found) samples.push_back({x, y, z});
    return samples;
  }
  // Of some bodies, the one with the largest mean at the samples around a point.
  static BodyId with_largest_mean(const Partition& partition, const std::set<BodyId>& bodies,
                                  Index3 p) {
    std::map<BodyId, long double> sums;
    for (const BodyId body : bodies) {
      for (const Index3 s : corners(p.i, p.j, p.k)) sums[body] += partition.value(body, s);
    }
    BodyId best = *bodies.begin();
    for (const auto& [body, sum] : sums) {
      if (sum > sums[best]) best = body;
    }
    return best;
  }
  static BodyId body_of_face(const Partition& partition, Index3 p) {
    const int u = (p.i & 1) != 0 ? 0 : 1, v = (p.k & 1) != 0 ? 2 : 1;  // the odd axes
    std::array<BodyId, 4> around{};
    for (int n = 0; n < 4; ++n) {
      Index3 at = p;
      at[u] += n == 0 || n == 3 ? -1 : 1;
      at[v] += n < 2 ? -1 : 1;
      around[n] = partition.body_at({at.i / 2, at.j / 2, at.k / 2});
    }
    const bool is_even_one = around[0] == around[2], is_odd_one = around[1] == around[3];
    if (is_even_one != is_odd_one) return around[is_even_one ? 0 : 1];
    return with_largest_mean(partition, {around.begin(), around.end()}, p);
  }
  // The points on a voxel's surface without those of a body are in pieces; it keeps others apart if
  // two of them have different bodies.
  BodyId body_of_voxel(const Partition& partition, Index3 p) const {
    std::vector<Index3> around;
    for_each_index({3, 3, 3}, [&](int i, int j, int k) {
      const Index3 at = p + Index3{i - 1, j - 1, k - 1};
      if (odd_axes(at) == 0 || odd_axes(at) == 2) around.push_back(at);
    });
    std::set<BodyId> bodies, apart;
    for (const Index3 at : around) bodies.insert(body_[index(at)]);
    for (const BodyId body : bodies) {
      DisjointSets pieces(around.size());
      for (std::uint32_t a = 0; a < around.size(); ++a) {
        for (std::uint32_t b = 0; b < a; ++b) {
          const Index3 &s = around[a], &t = around[b];
          const int apart_by = std::abs(s.i - t.i) + std::abs(s.j - t.j) + std::abs(s.k - t.k);
          const bool is_edge = odd_axes(s) == odd_axes(t)
                                   ? odd_axes(s) == 0 && apart_by == 2 &&
                                         (s.i == t.i) + (s.j == t.j) + (s.k == t.k) == 2
                                   : apart_by == 2;
          if (is_edge && body_[index(s)] != body && body_[index(t)] != body) pieces.unite(a, b);
        }
      }
      std::map<std::uint32_t, std::set<BodyId>> of_piece;
      for (std::uint32_t a = 0; a < around.size(); ++a) {
        const BodyId here = body_[index(around[a])];
        if (here != body) of_piece[pieces.find(a)].insert(here);
      }
      for (const auto& [piece, of] : of_piece) {
        if (of != of_piece.begin()->second) apart.insert(body);
      }
    }
    return with_largest_mean(partition, apart.empty() ? bodies : apart, p);
  }

  // Of a sample's place, an edge, a face and a voxel: those that are in no part of it.
  void make_simplices() {
    for_each_index(dims_, [&](int i, int j, int k) {
      const Index3 p{i, j, k};
      const int odd = odd_axes(p);
      const auto along = [](int axis, int by) {
        Index3 step{0, 0, 0};
        step[axis] = by;
        return step;
      };
      std::vector<int> axes;
      for (int axis = 0; axis < 3; ++axis) {
        if ((p[axis] & 1) != 0) axes.push_back(axis);
      }
      if (odd != 1) simplices_.push_back({p});
      if (odd == 1) simplices_.push_back({p + along(axes[0], -1), p + along(axes[0], 1)});
      for (const int axis : axes) {
        for (const int side : {-1, 1}) {
          const Index3 from = p + along(axis, side);  // an edge's middle, or a face's
          if (odd == 2) {
            const int other = axes[axis == axes[0] ? 1 : 0];
            const Index3 a = from + along(other, -1), b = from + along(other, 1);
            simplices_.push_back({p, a, b});
            if (axis == axes[0]) simplices_.insert(simplices_.end(), {{p, a}, {p, b}});
          }
          if (odd == 3) add_pyramid(p, from, axis);
        }
      }
      if (odd == 3) {
        for (int m = 0; m < 8; ++m) {
          simplices_.push_back({p, p + Index3{2 * (m & 1) - 1, (m & 2) - 1, (m >> 1 & 2) - 1}});
        }
        for (int axis = 0; axis < 3; ++axis) {
          for (int m = 0; m < 4; ++m) {
            const Index3 edge =
                p + along((axis + 1) % 3, 2 * (m & 1) - 1) + along((axis + 2) % 3, (m & 2) - 1);
            simplices_.push_back({p, edge + along(axis, -1), edge + along(axis, 1)});
          }
        }
      }
    });
  }
  // Those of a voxel's middle with the middle of a face.
  void add_pyramid(Index3 middle, Index3 face, int axis) {
    std::array<Index3, 4> around;
    for (int n = 0; n < 4; ++n) {
      around[n] = face;
      around[n][(axis + 1) % 3] += n == 0 || n == 3 ? -1 : 1;
      around[n][(axis + 2) % 3] += n < 2 ? -1 : 1;
    }
    simplices_.push_back({middle, face});
    for (int n = 0; n < 4; ++n) {
      simplices_.push_back({middle, face, around[n]});
      simplices_.push_back({middle, face, around[n], around[(n + 1) % 4]});
    }
  }

  // O2, O3, and of O4 the Euler number.
  void count_simplices() {
    for (const Simplex& simplex : simplices_) {
      const BodyId body = body_[index(simplex[0])];
      unsigned faces = 63;
      for (const Index3 p : simplex) {
        faces &= outer_faces(p, dims_);
        if (body_[index(p)] != body) faces = 64;
        if (faces == 64) break;
      }
      if (faces == 64) continue;
      const int sign = simplex.size() % 2 != 0 ? 1 : -1;
      bodies_[body].closed.euler += 2 * sign;
      bodies_[body].open.euler += 2 * sign;
      if (faces == 0) continue;
      bodies_[body].open.euler -= sign;
      bodies_[body].open.boundary_loops -= static_cast<std::uint64_t>(sign);
    }
  }

  // O1, and of O4 the components.
  void add_surfaces() {
    DisjointSets inside(body_.size()), on_box(body_.size());
    for (const Simplex& simplex : simplices_) {
      if (simplex.size() != 2) continue;
      const auto a = static_cast<std::uint32_t>(index(simplex[0])),
                 b = static_cast<std::uint32_t>(index(simplex[1]));
      if (body_[a] != body_[b]) continue;
      inside.unite(a, b);
      if ((outer_faces(simplex[0], dims_) & outer_faces(simplex[1], dims_)) != 0)
        on_box.unite(a, b);
    }
    std::map<std::uint32_t, SampleBox> boxes;
    for_each_index(dims_, [&](int i, int j, int k) {
      const Index3 p{i, j, k};
      const auto n = static_cast<std::uint32_t>(index(p));
      if (body_[n] == kNoId) return;
      if (outer_faces(p, dims_) != 0 && on_box.find(n) == n) {
        bodies_[body_[n]].open.boundary_loops += 2;
      }
      const auto [at, is_new] = boxes.try_emplace(inside.find(n), SampleBox{p, p});
      if (!is_new) at->second = united(at->second, {p, p});
    });
    for (const auto& [piece, box] : boxes) {
      bodies_[body_[piece]].closed.components += surfaces_around(inside, piece, box);
    }
  }

  // Returns how many components the points of others have in a component's box, and around it:
  // there, they are one.
  std::uint64_t surfaces_around(DisjointSets& inside, std::uint32_t piece,
                                const SampleBox& box) const {
    SampleBox around = box;
    for (int axis = 0; axis < 3; ++axis) {
      around.begin[axis] = std::max(0, box.begin[axis] - 2);
      around.end[axis] = std::min(dims_[axis] - 1, box.end[axis] + 2);
    }
    const Index3 n = around.dims();
    const auto outside = static_cast<std::uint32_t>(std::size_t(n.i) * n.j * n.k);
    std::vector<std::uint8_t> is_other;
    DisjointSets others(outside + std::size_t{1});
    for_each_index(n, [&](int i, int j, int k) {
      const std::size_t at = index(around.begin + Index3{i, j, k});
      const auto own = static_cast<std::uint32_t>(is_other.size());
      is_other.push_back(body_[at] != kNoId &&
                         inside.find(static_cast<std::uint32_t>(at)) != piece);
      if (is_other[own] && outer_faces({i, j, k}, n) != 0) others.unite(own, outside);
    });
    const auto unite = [&](Index3 a, Index3 b) {
      const auto number = [&](Index3 p) {
        return static_cast<std::uint32_t>(p.i + n.i * (p.j + n.j * p.k));
      };
      for (const Index3 p : {a, b}) {
        if (p.i < 0 || p.j < 0 || p.k < 0 || p.i >= n.i || p.j >= n.j || p.k >= n.k) return;
      }
      if (is_other[number(a)] && is_other[number(b)]) others.unite(number(a), number(b));
    };
    for_each_index(n, [&](int i, int j, int k) {
      const Index3 p{i, j, k}, at = p + around.begin;
      for (int axis = 0; axis < 3; ++axis) {
        Index3 step{0, 0, 0};
        step[axis] = odd_axes(at) == 3 || (odd_axes(at) == 2 && (at[axis] & 1) == 0) ? 1 : 2;
        if (odd_axes(at) == 0 || step[axis] == 1) unite(p, p + step);
      }
      if (odd_axes(at) < 2) return;
      for (int m = 0; m < 8; ++m) {
        Index3 end = p;
        for (int axis = 0; axis < 3; ++axis) {
          if ((at[axis] & 1) != 0) end[axis] += (m >> axis & 1) != 0 ? 1 : -1;
        }
        unite(p, end);
      }
    });
    std::uint64_t count = others.find(outside) == outside;
    for (std::uint32_t p = 0; p < is_other.size(); ++p) count += is_other[p] && others.find(p) == p;
    return count;
  }

  // O5. An edge between two bodies is in the border of each: two nodes.
  void add_pieces() {
    std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> edges;
    std::vector<BodyId> of_node;
    for (const Simplex& simplex : simplices_) {
      if (simplex.size() != 2) continue;
      const std::size_t a = index(simplex[0]), b = index(simplex[1]);
      if (body_[a] == body_[b]) continue;
      edges[std::minmax(a, b)] = static_cast<std::uint32_t>(of_node.size());
      of_node.insert(of_node.end(), {body_[std::min(a, b)], body_[std::max(a, b)]});
    }
    DisjointSets nodes(of_node.size());
    for (const Simplex& simplex : simplices_) {
      if (simplex.size() != 3) continue;
      std::map<BodyId, std::vector<std::uint32_t>> passed;
      for (int n = 0; n < 3; ++n) {
        const std::size_t a = index(simplex[n]), b = index(simplex[(n + 1) % 3]);
        if (body_[a] == body_[b]) continue;
        const std::uint32_t node = edges.at(std::minmax(a, b));
        passed[of_node[node]].push_back(node);
        passed[of_node[node + 1]].push_back(node + 1);
      }
      for (const auto& [body, of] : passed) nodes.unite(of.front(), of.back());
    }
    for (std::uint32_t node = 0; node < of_node.size(); ++node) {
      bodies_[of_node[node]].open.components += nodes.find(node) == node;
    }
  }

  Index3 dims_;
  std::vector<BodyId> body_;  // per point; kNoId: there is none
  std::vector<Simplex> simplices_;
  std::vector<Body> bodies_;
};

// True if each sample belongs to the body with the largest field, and of equal ones to the first.
inline bool has_largest_bodies(const Partition& partition) {
  bool is_largest = true;
  for_each_index(partition.shape().dims(), [&](int i, int j, int k) {
    BodyId largest = 0;
    for (BodyId body = 1; body < partition.size(); ++body) {
      const Index3 s{i, j, k};
      if (partition.value(body, s) > partition.value(largest, s)) largest = body;
    }
    is_largest &= partition.body_at({i, j, k}) == largest;
  });
  return is_largest;
}

// What triangles are, as the checkers count it from their corners.
struct Surface {
  std::string fault;  // empty: a manifold, oriented, which ends on the box only
  TopologyCounts counts;
};

inline Surface surface_of(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                          const Box3& box) {
  const TriMesh mesh = make_tri_mesh(points, triangles);
  std::string fault = check_mesh(mesh);
  if (fault.empty()) fault = check_boundary_on_box(mesh, box);
  if (!fault.empty()) return {fault, {}};
  return {fault, mesh_topology(mesh).counts()};
}

inline std::string text_of(const TopologyCounts& counts) {
  return text(counts.components, " components, Euler number ", counts.euler, ", ",
              counts.boundary_loops, " boundary loops");
}

// Returns the triangles of each body, counter-clockwise seen from outside.
inline std::vector<std::vector<Triangle>> triangles_by_body(std::span<const InterfaceFacet> facets,
                                                            std::size_t bodies) {
  std::vector<std::vector<Triangle>> of(bodies);
  for (const auto& [v, sides] : facets) {
    of[sides[1]].push_back(v);
    if (sides[0] < bodies) of[sides[0]].push_back({v[0], v[2], v[1]});
  }
  return of;
}

// Returns what is wrong with the bodies that facets name, and with facets on the box.
inline std::string facets_fault(const Partition& partition, const std::vector<Vec3>& points,
                                std::span<const InterfaceFacet> facets, bool cap) {
  const Box3 box = partition.shape().box();
  std::set<std::set<VertexId>> different;
  std::set<VertexId> used;
  std::array<double, 6> capped{};
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto& [v, bodies] = facets[f];
    different.insert({v[0], v[1], v[2]});
    used.insert(v.begin(), v.end());
    if (bodies[1] >= partition.size() || bodies[0] >= partition.beyond(6) ||
        bodies[0] == bodies[1] || partition.in_order(bodies[1], bodies[0]) != bodies) {
      return text("facet ", f, " is between the bodies ", bodies[0], " and ", bodies[1]);
    }
    if (!partition.is_beyond(bodies[0])) continue;
    if (!cap) return text("facet ", f, " is on the box");
    if (bodies[1] == partition.background()) return text("facet ", f, " caps the background");
    const auto face = static_cast<int>(bodies[0] - partition.beyond(0));
    for (const VertexId corner : v) {
      if ((box_faces_at(points[corner], box) >> face & 1) == 0) {
        return text("vertex ", corner, " of facet ", f, " is not on face ", face, " of the box");
      }
    }
    const Vec3 normal = cross(points[v[1]] - points[v[0]], points[v[2]] - points[v[0]]);
    const double outwards = face % 2 == 0 ? -normal[face / 2] : normal[face / 2];
    if (!(outwards > 0)) return text("facet ", f, " on the box is seen from inside");
    capped[static_cast<std::size_t>(face)] += outwards / 2;
  }
  if (different.size() != facets.size()) return "a facet twice";
  if (used.size() != points.size()) return "a point without a facet";
  if (!cap || partition.background() != kNoId) return {};
  for (std::size_t face = 0; face < 6; ++face) {
    const Vec3 size = box.size();
    const double area = size.x * size.y * size.z / size[static_cast<int>(face / 2)];
    if (std::abs(capped[face] - area) > 1e-9 * area) {
      return text("the facets on face ", face, " have the area ", capped[face], ", not ", area);
    }
  }
  return {};
}

// The facet that a ray meets first: its number, and whether the ray comes from its front. Not the
// one that the ray leaves. Not known where the ray passes near an edge.
struct Met {
  std::size_t facet;
  bool from_front;
};

inline std::optional<Met> first_met(const std::vector<Vec3>& points,
                                    std::span<const InterfaceFacet> facets, std::size_t leaves,
                                    const Vec3& from, const Vec3& along) {
  constexpr double kNearEdge = 1e-6;
  std::optional<Met> met;
  double nearest = std::numeric_limits<double>::infinity(), unknown = nearest;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (f == leaves) continue;
    const auto& [a, b, c] = facets[f].v;
    const Vec3 ab = points[b] - points[a], ac = points[c] - points[a], to = points[a] - from;
    const Vec3 normal = cross(ab, ac);
    const double facing = dot(normal, along), at = dot(normal, to) / facing;
    const Vec3 turn = cross(to, along);
    const double x = dot(turn, ac) / facing, y = -dot(turn, ab) / facing;
    const double least = std::min({x, y, 1 - x - y});
    if (!(std::fabs(facing) > 0) || !(at > 0) || least < -kNearEdge) continue;
    if (least < kNearEdge) unknown = std::min(unknown, at);
    if (least < kNearEdge || at >= nearest) continue;
    nearest = at;
    met = {f, facing < 0};
  }
  return nearest < unknown ? met : std::nullopt;
}

// Returns facets between which space seems to have two bodies: from some facets, one of each
// component among them, it looks for the next one in front and behind.
inline std::string sides_fault(const std::vector<Vec3>& points,
                               std::span<const InterfaceFacet> facets) {
  constexpr std::size_t kPairs = 100'000;
  DisjointSets joined(points.size());
  for (const InterfaceFacet& facet : facets) {
    joined.unite(facet.v[0], facet.v[1]);
    joined.unite(facet.v[0], facet.v[2]);
  }
  std::set<std::uint32_t> seen;
  const std::size_t step = 1 + facets.size() * facets.size() / kPairs;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const bool is_first = seen.insert(joined.find(facets[f].v[0])).second;
    if (!is_first && f % step != 0) continue;
    const Vec3 &a = points[facets[f].v[0]], &b = points[facets[f].v[1]],
               &c = points[facets[f].v[2]];
    const Vec3 normal = cross(b - a, c - a);
    for (const bool to_front : {true, false}) {
      const auto met =
          first_met(points, facets, f, (a + b + c) / 3, to_front ? normal : -1 * normal);
      if (!met) continue;
      const BodyId here = facets[f].bodies[to_front ? 0 : 1];
      const BodyId there = facets[met->facet].bodies[met->from_front ? 0 : 1];
      if (here != there) {
        return text("between the facets ", f, " and ", met->facet, " lie the bodies ", here,
                    " and ", there);
      }
    }
  }
  return {};
}

// Returns what is wrong with the borders; empty if nothing is.
inline std::string borders_fault(const Partition& partition, const LabelOracle& oracle,
                                 const std::vector<Vec3>& points,
                                 std::span<const InterfaceFacet> facets, bool cap) {
  const Box3 box = partition.shape().box();
  for (const Vec3& p : points) {
    if (!box.contains(p)) return "a point outside of the box";
  }
  if (std::string fault = facets_fault(partition, points, facets, cap); !fault.empty())
    return fault;
  const auto triangles = triangles_by_body(facets, partition.size());
  for (BodyId body = 0; body < partition.size(); ++body) {
    const bool is_closed = cap && body != partition.background();
    const Surface surface = surface_of(points, triangles[body], box);
    if (!surface.fault.empty()) return text("body ", body, ": ", surface.fault);
    const TopologyCounts& expected = is_closed ? oracle.closed(body) : oracle.open(body);
    if (surface.counts != expected) {
      return text("body ", body, ": ", text_of(surface.counts), ", not ", text_of(expected));
    }
    if (is_closed && !triangles[body].empty() &&
        !(enclosed_volume(make_tri_mesh(points, triangles[body])) > 0)) {
      return text("body ", body, " is inside out");
    }
  }
  std::vector<Triangle> all;
  for (const InterfaceFacet& facet : facets) all.push_back(facet.v);
  const PlaceFaults faults = find_place_faults(points, all);
  if (faults.count() == 0) return sides_fault(points, facets);
  return text(faults.crossings, " crossings, ", faults.flat, " flat, ", faults.coincident,
              " coincident");
}

struct Borders {
  std::vector<Vec3> points;
  std::vector<InterfaceFacet> facets;
};

// Returns T_L's facets that a mesh has, with the points that they use.
inline Borders borders_of(const LabelComplex& complex, const Partition& partition, bool cap) {
  Borders borders;
  std::vector<VertexId> number(complex.sheets.points.size(), kNoId);
  for (const auto& of_complex : complex.sheets.facets) {
    InterfaceFacet facet{of_complex.v, of_complex.bodies};
    const bool is_cap = partition.is_beyond(facet.bodies[0]);
    if (is_cap && (!cap || facet.bodies[1] == partition.background())) continue;
    for (VertexId& v : facet.v) {
      if (number[v] == kNoId) {
        number[v] = VertexId(borders.points.size());
        borders.points.push_back(complex.sheets.points[v]);
      }
      v = number[v];
    }
    borders.facets.push_back(facet);
  }
  return borders;
}

// Components and Euler number of the facets between two bodies, with their corners and edges.
using SheetCounts = std::pair<std::size_t, std::int64_t>;

inline std::map<std::array<BodyId, 2>, SheetCounts> sheet_counts(
    const std::vector<Vec3>& points, std::span<const InterfaceFacet> facets) {
  std::map<std::array<BodyId, 2>, std::vector<Triangle>> sheets;
  for (const InterfaceFacet& facet : facets) sheets[facet.bodies].push_back(facet.v);
  std::map<std::array<BodyId, 2>, SheetCounts> counts;
  for (const auto& [bodies, triangles] : sheets) {
    const MeshTopology topology = mesh_topology(make_tri_mesh(points, triangles));
    counts[bodies] = {topology.components.size(), topology.euler()};
  }
  return counts;
}

// Returns what is wrong with a mesh of the borders; empty if nothing is.
inline std::string mesh_fault(const Partition& partition, const LabelOracle& oracle,
                              const InterfaceMesh& mesh, bool cap) {
  if (!has_largest_bodies(partition)) return "a sample is in another body than its fields say";
  if (mesh.exact.size() != partition.size() || mesh.topology.size() != partition.size()) {
    return text("the topology is told of ", mesh.exact.size(), " bodies");
  }
  std::string fault = borders_fault(partition, oracle, mesh.points, mesh.facets, cap);
  if (!fault.empty()) return fault;
  const Borders borders =
      borders_of(label_complex(partition, {{0, 0, 0}, partition.shape().voxels()}), partition, cap);
  const auto expected_sheets = sheet_counts(borders.points, borders.facets);
  auto sheets = sheet_counts(mesh.points, mesh.facets);
  for (const auto& [bodies, expected] : expected_sheets) {
    const SheetCounts& found = sheets[bodies];
    if (found == expected) continue;
    return text("between the bodies ", bodies[0], " and ", bodies[1], ": ", found.first,
                " components, Euler number ", found.second, ", in T_L ", expected.first, " and ",
                expected.second);
  }
  if (sheets.size() != expected_sheets.size()) return "bodies meet that do not in T_L";
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (partition.is_beyond(mesh.facets[f].bodies[0]) != (f >= mesh.inner_facets)) {
      return text("facet ", f, " is among the wrong ones: ", mesh.inner_facets,
                  " are between bodies");
    }
  }
  for (BodyId body = 0; body < partition.size(); ++body) {
    const bool is_closed = cap && body != partition.background();
    const TopologyCounts& expected = is_closed ? oracle.closed(body) : oracle.open(body);
    if (mesh.exact[body] != expected) {
      return text("body ", body, ": as exact are told ", text_of(mesh.exact[body]), ", not ",
                  text_of(expected));
    }
    if (mesh.topology[body] != expected) {
      return text("body ", body, ": of the mesh are told ", text_of(mesh.topology[body]), ", not ",
                  text_of(expected));
    }
    const TriMesh own = mesh.mesh_of(body);
    if (surface_of(own.points, own.triangles(), partition.shape().box()).counts != expected) {
      return text("body ", body, ": mesh_of() has another topology");
    }
  }
  return {};
}

// A facet of T_L by the simplices that hold its points, the least one first.
using SimplexFacet = std::pair<std::array<std::uint64_t, 3>, std::array<BodyId, 2>>;

// Returns what is wrong with T_L; empty if nothing is. `cut`: the voxel along `axis` where it is
// cut into two blocks, which together must have the facets and points of the whole.
inline std::string complex_fault(const Partition& partition, const LabelOracle& oracle, int axis,
                                 int cut) {
  if (!has_largest_bodies(partition)) return "a sample is in another body than its fields say";
  const Index3 voxels = partition.shape().voxels();
  const LabelComplex whole = label_complex(partition, {{0, 0, 0}, voxels});
  const std::vector<Vec3>& points = whole.sheets.points;
  for (const bool cap : {false, true}) {
    const Borders borders = borders_of(whole, partition, cap);
    const std::string fault = borders_fault(partition, oracle, borders.points, borders.facets, cap);
    if (!fault.empty()) return (cap ? "T_L with caps: " : "T_L: ") + fault;
  }
  for (const auto& facet : whole.sheets.facets) {
    const Vec3 &a = points[facet.v[0]], &b = points[facet.v[1]], &c = points[facet.v[2]];
    const Box3 box = box_of(a, b, c);
    const Index3 voxel = partition.shape().voxel_at(box.middle());
    const Box3 around{partition.shape().position(voxel),
                      partition.shape().position(corner_of(voxel, 7))};
    if (!around.contains(box.lo) || !around.contains(box.hi)) return "T_L: a facet in two voxels";
  }
  std::map<std::uint64_t, Vec3> place, place_in_blocks;
  std::set<SimplexFacet> facets, facets_in_blocks;
  const auto add = [](const LabelComplex& complex, auto& places, auto& found) {
    for (std::size_t v = 0; v < complex.place.size(); ++v) {
      const Vec3& p = complex.sheets.points[v];
      if (places.try_emplace(complex.place[v], p).first->second != p) return false;
    }
    for (const auto& facet : complex.sheets.facets) {
      std::array<std::uint64_t, 3> at;
      for (std::size_t i = 0; i < 3; ++i) at[i] = complex.place[facet.v[i]];
      std::rotate(at.begin(), std::ranges::min_element(at), at.end());
      if (!found.insert({at, facet.bodies}).second) return false;
    }
    return true;
  };
  add(whole, place, facets);
  SampleBox low{{0, 0, 0}, voxels}, high = low;
  low.end[axis] = high.begin[axis] = cut;
  if (!add(label_complex(partition, low), place_in_blocks, facets_in_blocks) ||
      !add(label_complex(partition, high), place_in_blocks, facets_in_blocks) ||
      place != place_in_blocks || facets != facets_in_blocks) {
    return text("T_L in two blocks, cut along ", axis, " at ", cut, ", is another one");
  }
  return {};
}

}  // namespace deliso::stress
