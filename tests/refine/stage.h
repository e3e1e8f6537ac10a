// SPDX-License-Identifier: MIT
// A mesh of Stage 1 for tests of Stage 2's operations, with random places in it. Tests by brute
// force all that must hold after a change.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "base/triangle.h"
#include "bench/support/coarsened_contour.h"
#include "cases.h"
#include "check/check_mesh.h"
#include "embedding/all_crossings.h"
#include "fields.h"
#include "mesh/component_kinds.h"
#include "refine/refine.h"
#include "refine/refinement.h"
#include "run/options.h"
#include "see.h"

namespace deliso::test {

// Pure noise in a tiny box; in every third one of few values, in every fourth of long voxels.
inline Scene noise_scene(std::uint64_t seed) {
  Random random(seed);
  Index3 dims;
  for (int axis = 0; axis < 3; ++axis) dims[axis] = 3 + static_cast<int>(random.below(3));
  const std::uint32_t levels = seed % 3 == 0 ? 3 + random.below(5) : 1000;
  std::vector<float> samples;
  for (int n = 0; n < dims.i * dims.j * dims.k; ++n) {
    samples.push_back(static_cast<float>(random.below(levels)));
  }
  const Vec3 spacing{1, 1, seed % 4 == 0 ? 2.5 : 1.0};
  Volume volume = Volume::from_samples(dims, spacing, samples);
  const double kappa = geometric_isovalue(volume.type(), 0.5 * levels);
  return Scene(std::move(volume), kappa);
}

// The n-th of a few small volumes of all kinds.
inline constexpr int kScenes = 32;
inline Scene some_scene(int n) {
  constexpr const char* names[] = {"sphere", "torus", "linked_tori", "five_spheres",
                                   "gyroid", "fuel",  "orbital",     "machine"};
  if (n < 8) return builtin_scene(names[n], n % 2 == 0 ? 16 : 20);
  if (n < 12) return wave_scene(static_cast<std::uint64_t>(n), 9, {1, 1, n % 2 == 0 ? 2.0 : 1.0});
  return noise_scene(static_cast<std::uint64_t>(n));
}

// How many closed components have their normals outwards.
inline int turned_out(const TriMesh& mesh) {
  int count = 0;
  std::vector<std::uint8_t> seen(mesh.faces.size(), 0);
  for (FaceId start = 0; start < mesh.faces.size(); ++start) {
    if (seen[start]) continue;
    std::vector<FaceId> component{start};
    seen[start] = 1;
    bool closed = true;
    double volume = 0;
    const Vec3 origin = mesh.points[mesh.faces[start].v[0]];
    for (std::size_t k = 0; k < component.size(); ++k) {
      const Face& face = mesh.faces[component[k]];
      const auto& [a, b, c] = face.v;
      volume += sixfold_volume(origin, mesh.points[a], mesh.points[b], mesh.points[c]);
      for (const FaceId g : face.n) {
        closed &= g != kNoId;
        if (g == kNoId || seen[g]) continue;
        seen[g] = 1;
        component.push_back(g);
      }
    }
    count += closed && volume > 0;
  }
  return count;
}

// Two facets that cross, of all; empty when there are none.
inline std::string crossing_in(const TriMesh& mesh) {
  const auto pairs = all_crossings(mesh);
  return pairs.empty() ? "" : std::to_string(pairs.size()) + " pairs of facets cross";
}

// Per vertex, 1 if some facet uses it.
inline std::vector<std::uint8_t> is_used(const std::vector<Face>& faces, std::size_t vertices) {
  std::vector<std::uint8_t> used(vertices, 0);
  for (const Face& face : faces) {
    if (is_dead(face)) continue;
    for (const VertexId v : face.v) used[v] = 1;
  }
  return used;
}
inline std::size_t used_vertices(const TriMesh& mesh) {
  return static_cast<std::size_t>(std::ranges::count(is_used(mesh.faces, mesh.points.size()), 1));
}

// Corners of the two facets at an edge: the edge from b to c as f runs, a of f, d of g beyond.
struct Corners4 {
  FaceId g;
  VertexId a, b, c, d;
};
inline Corners4 corners_at(const std::vector<Face>& faces, FaceId f, int i) {
  const FaceId g = faces[f].n[i];
  const Triangle& v = faces[f].v;
  return {g, v[i], v[(i + 1) % 3], v[(i + 2) % 3], faces[g].v[neighbor_index(faces[g], f)]};
}

inline std::size_t live_facets(const std::vector<Face>& faces) {
  return static_cast<std::size_t>(std::ranges::count_if(faces, std::not_fn(is_dead)));
}

inline std::vector<VertexId> all_vertices(const TriMesh& mesh) {
  std::vector<VertexId> all;
  for (VertexId v = 0; v < mesh.points.size(); ++v) all.push_back(v);
  return all;
}

// By all facets.
inline double distance2_to_mesh(const Vec3& p, const TriMesh& mesh) {
  double nearest2 = kNotAsked;
  for (const Face& face : mesh.faces) {
    if (is_dead(face)) continue;
    const auto& [a, b, c] = face.v;
    nearest2 = std::min(nearest2,
                        distance2_to_triangle(p, mesh.points[a], mesh.points[b], mesh.points[c]));
  }
  return nearest2;
}

// A change by hand: facets to be removed, and what comes in their place.
struct Change {
  std::vector<FaceId> cavity;
  Gates gates = kInsertionGates;
  std::optional<Vec3> apex = std::nullopt;  // of a cone
  VertexId moved = kNoId;                   // to `apex`
  std::vector<Triangle> facets = {};        // without an apex
};

// Makes it if every gate lets it pass, wanted or not.
inline std::optional<Refusal> make(Refinement& r, const Change& change,
                                   const Refinement::Accept& accept = Refinement::always) {
  const Cavity* cavity = r.open(change.cavity);
  if (!cavity) return Refusal::not_a_disk;
  return r.make(!change.apex            ? cavity->fill(change.facets, change.gates)
                : change.moved == kNoId ? cavity->cone(*change.apex, change.gates)
                                        : cavity->move(change.moved, *change.apex, change.gates),
                accept);
}

// Stage 1 done, and what Stage 2's proposers need.
class Stage {
 public:
  // `refined`: Stage 2 done, too.
  explicit Stage(const Scene& of, const Options& options = {}, bool refined = false)
      : scene(of),
        parameters(resolve(options, of.volume)),
        coarsened(coarsened_contour(of.surface, parameters)),
        curves(of.surface, coarsened.loops),
        surface_mesh(coarsened.mesh),
        mesh(refined ? refined_mesh() : surface_mesh.mesh),
        r(surface_mesh, {of.surface, curves, parameters, report}),
        kinds_(kinds_of(mesh)),
        turned_out_(turned_out(mesh)) {
    report.add(coarsened.report);
    const ValueRange range = value_range(scene.volume);
    tolerance_ = 1e-8 * (range.max - range.min);
    // Refinement may have moved vertices off Sigma where the mesh was too near to itself.
    for (const Vec3& p : mesh.points) tolerance_ = std::max(tolerance_, off_isovalue(p));
  }
  Stage(const Stage&) = delete;

  double off_isovalue(const Vec3& p) const {
    return std::abs(scene.volume.value(p) - scene.surface.kappa());
  }
  // From now on a vertex off Sigma is no fault.
  void allow_off_surface() { tolerance_ = kNotAsked; }
  // The first thing wrong with the mesh as it is now, and how to see it; empty when all is well.
  std::string fault() const {
    SurfaceMesh live = surface_mesh;
    remove_dead(live);
    const std::string fault = fault_of(live);
    if (fault.empty()) {
      if (folder_to_see()) sound_ = mesh;
      return fault;
    }
    return fault + see(case_name(),
                       {{"mesh", live.mesh}, {"contour", contour_mesh(scene.contour, mesh.frame)}},
                       {{"fault", facets_alone(live.mesh, facets_at_fault(live.mesh, {}))},
                        {"cavity", facets_alone(sound_, changed_facets())}});
  }

  // Checks the duals of these facets against the oracle, and their boxes in the spatial hash.
  std::string fault_of(std::span<const FaceId> facets) const {
    SurfacePointFinder finder(scene.surface);
    SearchCounters counters;
    for (const FaceId f : facets) {
      if (is_dead(mesh.faces[f])) return "a new facet is dead";
      const Triangle& v = mesh.faces[f].v;
      const Dual dual =
          finder.dual(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], counters);
      const Dual& said = surface_mesh.duals[f];
      if (dual.on_surface != said.on_surface || dual.center != said.center) return "a wrong dual";
      const BoxGrid& grid = r.facets();
      if (!grid.any(grid.box_of(mesh.points, v),
                    [&](FaceId g, const BoxGrid::Box&) { return g == f; })) {
        return "a facet that the grid does not have";
      }
      if (r.is_delaunay(f) != is_delaunay(f)) {
        return "a vertex in a ball that the grid does not see, or sees where there is none";
      }
    }
    return "";
  }

  // Everything a refusal must leave as it was.
  struct Snapshot {
    std::vector<Vec3> points;
    std::vector<Face> faces;
    std::vector<Dual> duals;
    std::vector<std::pair<VertexId, VertexId>> links;
    bool operator==(const Snapshot& o) const {
      const auto same_dual = [](const Dual& a, const Dual& b) {
        return std::memcmp(&a.center, &b.center, sizeof a.center) == 0 &&
               std::memcmp(&a.radius2, &b.radius2, sizeof a.radius2) == 0 &&
               a.on_surface == b.on_surface;
      };
      const auto same_face = [](const Face& a, const Face& b) { return a.v == b.v && a.n == b.n; };
      return points.size() == o.points.size() && links == o.links &&
             std::memcmp(points.data(), o.points.data(), points.size() * sizeof(Vec3)) == 0 &&
             std::equal(faces.begin(), faces.end(), o.faces.begin(), o.faces.end(), same_face) &&
             std::equal(duals.begin(), duals.end(), o.duals.begin(), o.duals.end(), same_dual);
    }
  };
  Snapshot snapshot() const {
    Snapshot s{mesh.points, mesh.faces, surface_mesh.duals, {}};
    for (VertexId v = 0; v < surface_mesh.chain.vertex_capacity(); ++v) {
      if (!surface_mesh.chain.is_boundary(v)) continue;
      s.links.emplace_back(v, surface_mesh.chain.next(v));
    }
    return s;
  }

  FaceId random_facet(Random& random) const {
    while (true) {
      const FaceId f(random.below(static_cast<std::uint32_t>(mesh.faces.size())));
      if (!is_dead(mesh.faces[f])) return f;
    }
  }
  const Vec3& corner(FaceId f, int i) const { return mesh.points[mesh.faces[f].v[i]]; }
  Vec3 normal(FaceId f) const { return area_normal(corner(f, 0), corner(f, 1), corner(f, 2)); }
  double longest_edge(FaceId f) const {
    return std::sqrt(
        std::max({distance2(corner(f, 0), corner(f, 1)), distance2(corner(f, 1), corner(f, 2)),
                  distance2(corner(f, 2), corner(f, 0))}));
  }
  std::size_t live_facets() const { return test::live_facets(mesh.faces); }

  // A point of Sigma near facet f, as another operation might have found it.
  std::optional<Vec3> point_near(FaceId f, Random& random) {
    const double u = random.uniform(-0.2, 1.2), w = random.uniform(-0.2, 1.2);
    const Vec3 p =
        corner(f, 0) + u * (corner(f, 1) - corner(f, 0)) + w * (corner(f, 2) - corner(f, 0));
    return r.finder.foot(p, normal(f), longest_edge(f), report.searches_refine);
  }

  // Flips the edge of f opposite its corner i if every gate lets it pass, wanted or not.
  bool flip_anyway(FaceId f, int i, std::vector<FaceId>* created = nullptr) {
    const FaceId g = mesh.faces[f].n[i];
    if (g == kNoId) return false;
    const auto [beyond, a, b, c, d] = corners_at(mesh.faces, f, i);
    const std::array<Triangle, 2> flipped{{{a, b, d}, {d, c, a}}};
    const Cavity* cavity = r.open(std::array{f, g});
    if (!cavity || r.make(cavity->fill(flipped, Gates{}))) return false;
    if (created) created->assign(r.created().begin(), r.created().end());
    return true;
  }

  // No vertex of the mesh but its own corners is in its surface ball, by a look at all of them.
  bool is_delaunay(FaceId f) const {
    const Dual& dual = surface_mesh.duals[f];
    if (!dual.on_surface) return false;
    const Triangle& v = mesh.faces[f].v;
    for (const Face& face : mesh.faces) {
      if (is_dead(face)) continue;
      for (const VertexId q : face.v) {
        if (dual.holds(mesh.points[q]) && !has_corner(v, q)) return false;
      }
    }
    return true;
  }

  const Scene& scene;
  Report report;
  Parameters parameters;  // a test may change them
  Block coarsened;
  BoundaryCurves curves;
  SurfaceMesh& surface_mesh;
  const TriMesh& mesh;
  Refinement r;

 private:
  const TriMesh& refined_mesh() {
    refine(surface_mesh, coarsened.samples, {scene.surface, curves, parameters, report});
    return surface_mesh.mesh;
  }

  std::string fault_of(const SurfaceMesh& live) const {
    std::string fault = check_mesh(live.mesh);
    if (fault.empty()) fault = check_boundary_on_box(live.mesh, scene.volume.box());
    if (!fault.empty()) return fault;
    if (kinds_of(live.mesh) != kinds_) return "another topology";
    if (turned_out(live.mesh) != turned_out_) return "a component turned inside out";
    if (live.duals.size() != live.mesh.faces.size()) return "not one dual for each facet";
    fault = fault_of_chain(live);
    if (fault.empty()) fault = fault_of_chain(surface_mesh);
    if (!fault.empty()) return fault;
    for (const Vec3& p : live.mesh.points) {
      if (!(off_isovalue(p) <= tolerance_)) {
        return "a vertex off the surface";
      }
    }
    return crossing_in(live.mesh);
  }

  // The facets of the last sound mesh that are gone, or changed in place.
  std::vector<FaceId> changed_facets() const {
    std::vector<FaceId> changed;
    for (FaceId f = 0; f < sound_.faces.size(); ++f) {
      const Triangle& was = sound_.faces[f].v;
      if (is_dead(sound_.faces[f])) continue;
      const auto moved = [&](VertexId v) { return mesh.points[v] != sound_.points[v]; };
      const bool is_there = f < mesh.faces.size() && mesh.faces[f].v == was;
      if (!is_there || std::ranges::any_of(was, moved)) changed.push_back(f);
    }
    return changed;
  }

  // The chain's edges are the boundary edges, the way the chain runs or against it.
  static std::string fault_of_chain(const SurfaceMesh& s) {
    std::size_t boundary_edges = 0, chain_edges = 0;
    for (const Face& face : s.mesh.faces) {
      if (is_dead(face)) continue;
      for (int i = 0; i < 3; ++i) {
        if (face.n[i] != kNoId) continue;
        ++boundary_edges;
        const VertexId a = face.v[(i + 1) % 3], b = face.v[(i + 2) % 3];
        if (!s.chain.is_edge(a, b) || !s.chain.is_edge(b, a)) {
          return "a boundary edge that is none of the chain";
        }
      }
    }
    for (VertexId v = 0; v < s.chain.vertex_capacity(); ++v) chain_edges += s.chain.is_boundary(v);
    return boundary_edges == chain_edges ? "" : "the chain has other edges than the boundary";
  }

  ComponentKinds kinds_;
  int turned_out_;
  double tolerance_ = 0;
  mutable TriMesh sound_;  // with DELISO_SEE: as fault() last found nothing wrong
};

}  // namespace deliso::test
