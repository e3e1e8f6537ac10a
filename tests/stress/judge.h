// SPDX-License-Identifier: MIT
// Meshes a volume, checks the mesh in every way there is, and says what was found.
#pragma once

#include <cstdint>
#include <string>

#include "check/check_mesh.h"
#include "check/verify.h"
#include "deliso/mesh_isosurface.h"
#include "mesh/component_kinds.h"

namespace deliso::stress {

// POD, so that it can go through a pipe. The first fault is said in words.
struct Verdict {
  char fault[200] = "";
  bool invalid = false;             // no oriented manifold that ends on the box only
  bool topology_exact = false;      // the same kinds of components, as many of each
  bool disputed = false;            // exact, but verify() finds components that differ
  std::uint32_t coincident = 0;     // vertices where another one is
  std::uint32_t intersections = 0;  // pairs of triangles
  std::uint32_t off_surface = 0;    // vertices
  std::uint64_t triangles = 0;
  double seconds = 0, seconds_mesh = 0;
};

inline std::string first_of(const Faults& faults, std::initializer_list<FaultKind> kinds) {
  for (const FaultKind kind : kinds) {
    if (faults.count(kind) > 0) {
      return std::string(name_of(kind)) + ": " + faults.first(kind).front().what;
    }
  }
  return {};
}

// Only the two slow checkers and the contour are trusted, each with its own counts. Sets `faults`.
inline Verdict judge(const Volume& volume, const TriMesh& mesh, const Options& options,
                     const Report& report, Faults& faults) {
  using enum FaultKind;
  Verdict verdict;
  VerifyOptions how;
  how.components = options.components;
  const Verification v = verify(mesh, volume, report.kappa_effective, how);
  faults = v.faults;
  std::string fault = check_mesh(mesh);
  if (fault.empty()) fault = check_boundary_on_box(mesh, volume.box());
  verdict.invalid = !fault.empty();

  const ComponentKinds exact = kinds_of(summarize_contour(volume, report.kappa_effective));
  verdict.topology_exact = kinds_of(mesh) == exact;
  if (fault.empty() && !verdict.topology_exact) fault = "another topology";
  const std::string differs = first_of(
      v.faults, {missing_components, extra_components, different_components, turned_components});
  verdict.disputed = verdict.topology_exact && !differs.empty();
  if (fault.empty()) {
    fault = first_of(v.faults, {duplicate_vertices, degenerate_triangles, non_manifold_vertices});
  }
  if (fault.empty()) fault = differs;
  if (fault.empty()) fault = first_of(v.faults, {vertices_off_surface, self_intersections});
  fault.copy(verdict.fault, sizeof verdict.fault - 1);
  verdict.coincident = static_cast<std::uint32_t>(v.faults.count(duplicate_vertices));
  verdict.intersections = static_cast<std::uint32_t>(v.faults.count(self_intersections));
  verdict.off_surface = static_cast<std::uint32_t>(v.faults.count(vertices_off_surface));
  verdict.triangles = mesh.faces.size();
  return verdict;
}
inline Verdict judge(const Volume& volume, const TriMesh& mesh, const Options& options,
                     const Report& report) {
  Faults faults;
  return judge(volume, mesh, options, report, faults);
}

}  // namespace deliso::stress
