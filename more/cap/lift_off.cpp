// SPDX-License-Identifier: MIT
#include "more/cap/lift_off.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "base/triangle.h"
#include "embedding/triangle_pair.h"
#include "mesh/tri_mesh.h"
#include "refine/refinement.h"

namespace deliso {
namespace {

// Of cones from points next to a face of the box, which are as flat as the face.
constexpr Gates kFlatConeGates = topology_gates(kAnyFold, false);

// The distance off a face starts at the perturbation, or under a cap at the least distance between
// facets. It shrinks by this factor after each refusal. A small enough move keeps an embedded mesh
// embedded.
constexpr double kOffsetFactor = 0x1p-4;
// A share of the largest coordinate, here or in the world: the least distance off a face. A nearer
// vertex may be on the face after conversion to the world and back.
constexpr double kMinOffset = 0x1p-46;

// Returns the distances to try, from the first down to the least.
std::vector<double> distances_off(const Volume& volume, const Parameters& parameters) {
  const double first = std::max(parameters.gap, kPerturbationVoxels * parameters.voxel);
  std::vector<double> off;
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    largest = std::max({largest, volume.box().hi[axis], std::fabs(volume.frame().origin[axis])});
  }
  const double least = kMinOffset * largest;
  for (double d = first; off.empty() || d > least; d *= kOffsetFactor) {
    off.push_back(std::max(d, 2 * least));
  }
  return off;
}

// Places along an edge, as shares of it.
constexpr double kEdgeShares[] = {0.5, 0.25, 0.75, 0.125, 0.875};

// A share of the edge's length. The steepest line from a face may stay in the face; from this far
// inside it does not.
constexpr double kStartDepth = 0x1p-4;

// The attempts for edges and facets in a face of the box. The next one is made only if some are
// left.
//   - as_stage2: a vertex on Sigma, or the other diagonal, as Stage 2 allows them.
//   - on_surface: the same where Sigma nearly lies in the face, and facets have no surface points.
//   - next_to_it: a vertex next to the edge, as far off Sigma as the edge. This changes almost
//   nothing.
enum class Effort : std::uint8_t { as_stage2, on_surface, next_to_it };

class LiftOff {
 public:
  LiftOff(SurfaceMesh& s, const Given& given)
      : s_(s),
        mesh_(s.mesh),
        box_(given.surface.volume().box()),
        off_(distances_off(given.surface.volume(), given.parameters)),
        given_(given) {}

  std::size_t run();

 private:
  unsigned faces_at(VertexId v) const { return box_faces_at(mesh_.points[v], box_); }
  // Returns the faces that p is too near to.
  unsigned faces_near(const Vec3& p) const { return box_faces_at(p, box_, 0.5 * off_.back()); }
  // Returns the faces on which both ends of the edge of f opposite its corner i lie.
  unsigned faces_at_edge(FaceId f, int i) const {
    const Triangle& v = mesh_.faces[f].v;
    return faces_at(v[(i + 1) % 3]) & faces_at(v[(i + 2) % 3]);
  }
  // True if the interior edge of f opposite its corner i lies in a face. For i = 3: if f itself
  // does, having only boundary edges.
  bool lies_in_face(FaceId f, int i) const;
  std::size_t lift_all(Effort effort);
  bool move_off(FaceId f, VertexId v);
  bool lift(FaceId f, int i, Effort effort);

  struct Line {
    Vec3 at, direction;
  };
  // Returns points of Sigma off the box, the nearest one along each line within the limit. Sorted
  // by distance from `middle`.
  std::vector<Vec3> find_off_box(std::span<const Line> lines, const Vec3& middle, double limit);
  Vec3 normal(FaceId f) const {
    const Triangle& v = mesh_.faces[f].v;
    return area_normal(mesh_.points[v[0]], mesh_.points[v[1]], mesh_.points[v[2]]);
  }
  Vec3 middle(FaceId f) const {
    const Triangle& v = mesh_.faces[f].v;
    return (mesh_.points[v[0]] + mesh_.points[v[1]] + mesh_.points[v[2]]) / 3;
  }

  // Made at first use: most meshes have nothing to mend.
  Refinement& replacer() {
    if (!replacer_) replacer_.emplace(s_, given_);
    return *replacer_;
  }

  SurfaceMesh& s_;
  const TriMesh& mesh_;
  const Box3 box_;
  const std::vector<double> off_;  // descending
  const Given& given_;
  std::optional<Refinement> replacer_;
};

std::size_t LiftOff::run() {
  std::size_t left = 0;
  std::vector<std::uint8_t> on_boundary(mesh_.points.size(), 0);
  for (const Face& face : mesh_.faces) {
    for (int i = 0; i < 3; ++i) {
      if (face.n[i] != kNoId) continue;
      on_boundary[face.v[(i + 1) % 3]] = on_boundary[face.v[(i + 2) % 3]] = 1;
    }
  }
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    const Triangle corners = mesh_.faces[f].v;
    for (const VertexId v : corners) {
      if (on_boundary[v] || faces_near(mesh_.points[v]) == 0) continue;
      on_boundary[v] = 1;  // once is enough
      left += !move_off(f, v);
    }
  }
  std::size_t flat = 1;
  for (const Effort effort : {Effort::as_stage2, Effort::on_surface, Effort::next_to_it}) {
    if (flat > 0) flat = lift_all(effort);
  }
  return left + flat;
}

bool LiftOff::lies_in_face(FaceId f, int i) const {
  const Face& face = mesh_.faces[f];
  if (i < 3) return face.n[i] != kNoId && faces_at_edge(f, i) != 0;
  return face.n == std::array<FaceId, 3>{kNoId, kNoId, kNoId} &&
         (faces_at_edge(f, 0) & faces_at(face.v[0])) != 0;
}

// Returns how many edges and facets are left in faces.
std::size_t LiftOff::lift_all(Effort effort) {
  std::size_t left = 0;
  for (FaceId f = 0; f < mesh_.faces.size(); ++f) {
    for (int i = 0; i <= 3; ++i) {
      if (!lies_in_face(f, i)) continue;
      if (lift(f, i, effort)) {
        ++given_.report[Counter::cap_edges_lifted];
        i = -1;  // the facet has changed
      } else {
        ++left;
      }
    }
  }
  return left;
}

bool LiftOff::move_off(FaceId f, VertexId v) {
  const Cavity* cavity = replacer().open(replacer().star(f, v));
  if (!cavity) return false;
  const Vec3 from = mesh_.points[v], inward = inwards(faces_near(from));
  return std::any_of(off_.begin(), off_.end(), [&](double off) {
    return !replacer().make(cavity->move(v, from + off * inward, kTopologyGates));
  });
}

std::vector<Vec3> LiftOff::find_off_box(std::span<const Line> lines, const Vec3& middle,
                                        double limit) {
  std::vector<Vec3> found;
  for (const Line& line : lines) {
    const double size = length(line.direction);
    if (!(size > 0)) continue;
    const auto x = replacer().finder.nearest(line.at, line.direction / size, limit,
                                             given_.report.searches_refine);
    if (x && faces_near(*x) == 0) found.push_back(*x);
  }
  // Stable: points at one distance are common in symmetric fields.
  std::stable_sort(found.begin(), found.end(), [&](const Vec3& p, const Vec3& q) {
    return distance2(p, middle) < distance2(q, middle);
  });
  return found;
}

bool LiftOff::lift(FaceId f, int i, Effort effort) {
  const bool is_edge = i < 3;
  const FaceId g = is_edge ? mesh_.faces[f].n[i] : f;
  const Triangle v = mesh_.faces[f].v;
  const Vec3 a = mesh_.points[v[(i + 1) % 3]], b = mesh_.points[v[(i + 2) % 3]],
             c = mesh_.points[v[i % 3]];
  unsigned faces = faces_at_edge(f, i);
  double limit = distance(a, b);
  std::vector<Vec3> bases;
  if (is_edge) {
    for (const double share : kEdgeShares) bases.push_back(a + share * (b - a));
  } else {
    faces &= faces_at(v[0]);
    limit = std::max({limit, distance(b, c), distance(c, a)});
    bases.push_back(middle(f));
  }
  const Vec3 inward = inwards(faces), out = normal(f) + normal(g);

  const std::array removed{f, g};
  const Cavity* cavity = replacer().open(std::span(removed).first(is_edge ? 2 : 1));
  if (!cavity) return false;
  if (effort == Effort::next_to_it) {
    for (const double off : off_) {
      for (const Vec3& base : bases) {
        if (replacer().make(cavity->cone(base + off * inward, kFlatConeGates))) continue;
        ++given_.report[Counter::cap_lifts_off_surface];
        return true;
      }
    }
    return false;  // unreachable: no case is known
  }
  std::vector<Line> lines{{middle(f), normal(f)}, {middle(g), normal(g)}};
  for (const Vec3& base : bases) {
    lines.push_back({base, out});
    lines.push_back({base, dot(out, inward) < 0 ? -inward : inward});
    for (const Vec3& from : {base, base + kStartDepth * limit * inward}) {
      lines.push_back({from, -given_.surface.gradient(from)});
    }
  }
  const bool as_stage2 = effort == Effort::as_stage2;
  for (const Vec3& p : find_off_box(lines, bases[0], limit)) {
    if (!replacer().make(cavity->cone(p, as_stage2 ? Gates{} : kFlatConeGates))) return true;
  }
  if (!is_edge) return false;
  const Quad q = quad_at(mesh_, f, i);
  return (faces_at(q.a) & faces_at(q.d)) == 0 &&
         !replacer().make(cavity->fill(q.flipped(), as_stage2 ? Gates{} : kTopologyGates));
}

}  // namespace

std::size_t lift_off(SurfaceMesh& s, const Given& given) {
  return LiftOff(s, given).run();
}

}  // namespace deliso
