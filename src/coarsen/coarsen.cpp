// SPDX-License-Identifier: MIT
#include "coarsen/coarsen.h"

#include <algorithm>
#include <utility>

#include "base/stopwatch.h"
#include "coarsen/coarsener.h"
#include "coarsen/embedding.h"
#include "run/observer.h"
#include "surface/surface_point.h"

namespace deliso {
namespace {

// Components of fewer vertices stay as they are: they might be reversed, or passed by another.
constexpr std::uint32_t kSmallComponent = 24;

// The bound on the distance where the criteria have none, in voxels.
constexpr double kUsualBoundVoxels = 0.1;

// Attempts. Each keeps the vertices in the voxels of the facets at fault in the one before, and of
// its faulty components; the last keeps all.
constexpr int kMostAttempts = 6;

// Returns per voxel whether one of the facets meets it. Empty if there are none.
std::vector<std::uint8_t> voxels_at(std::span<const FaceId> facets, const TriMesh& mesh,
                                    const Volume& volume) {
  constexpr double kMarginVoxels = 0.1;
  const Vec3 margin = kMarginVoxels * volume.least_spacing();
  const auto number = [&](Index3 at) { return voxel_number(volume.dims(), at); };
  std::vector<std::uint8_t> is_marked(facets.empty() ? 0 : number({0, 0, volume.voxels().k}));
  for (const FaceId f : facets) {
    const Triangle& t = mesh.faces[f].v;
    const Box3 box = box_of(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    const Index3 lo = volume.voxel_at(box.lo - margin), hi = volume.voxel_at(box.hi + margin);
    for_each_place(lo, hi, [&](Index3 at) { is_marked[number(at)] = 1; });
  }
  return is_marked;
}

// Marks the vertices of small components that do not go on beyond the free box.
std::vector<std::uint8_t> small_ones(const MeshComponents& components) {
  std::vector<std::uint8_t> kept;
  for (const std::uint32_t c : components.of) {
    kept.push_back(!components.is_frozen[c] && components.size[c] < kSmallComponent);
  }
  return kept;
}

// Coarsens until the mesh has no faults. Returns per facet whether it changed.
std::vector<std::uint8_t> attempts(SurfaceMesh& s, const Given& given, double distance,
                                   const CoarsenScope& scope) {
  const Volume& volume = given.surface.volume();
  const TriMesh before = s.mesh;
  const BoundaryChain chain = s.chain;
  MeshComponents components(before, chain, scope.free_box.first_free, volume.box());
  std::vector<std::uint8_t> kept = small_ones(components);
  for (int attempt = 1; attempt < kMostAttempts; ++attempt) {
    std::vector<std::uint8_t> changed = Coarsener(s, given, distance, scope, kept).run();
    const EmbeddingFaults faults =
        embedding_faults(s, components, changed, scope.free_box, volume.box());
    if (faults.none()) return changed;
    ++given.report[Counter::coarsened_again];
    const std::vector<std::uint8_t> faulty_voxels = voxels_at(faults.facets, s.mesh, volume);
    std::vector<std::uint8_t> is_faulty(components.count(), 0);
    for (const std::uint32_t c : faults.components) is_faulty[c] = 1;
    s.mesh = before;
    s.chain = chain;
    if (attempt == 1) {
      std::ranges::fill(changed, 0);
      components.leave_out(
          embedding_faults(s, components, changed, scope.free_box, volume.box()).components);
    }
    for (VertexId v = 0; v < kept.size(); ++v) {
      kept[v.number()] |= is_faulty[components.of[v]];
      if (faulty_voxels.empty()) continue;
      const Index3 voxel = volume.voxel_at(before.points[v]);
      kept[v.number()] |= faulty_voxels[voxel_number(volume.dims(), voxel)];
    }
  }
  return std::vector<std::uint8_t>(s.mesh.faces.size(), 0);  // unreachable: no such mesh is known
}

// Sets the duals of live facets; `changed`: of these, or all if it is empty.
void set_duals(SurfaceMesh& s, std::span<const std::uint8_t> changed, const Given& given) {
  Report& report = given.report;
  s.duals.resize(s.mesh.faces.size());
  SurfacePointFinder finder(given.surface);
  for (FaceId f = 0; f < s.mesh.faces.size(); ++f) {
    if (is_dead(s.mesh.faces[f]) || (!changed.empty() && changed[f.number()] == 0)) continue;
    const auto& [a, b, c] = s.mesh.faces[f].v;
    s.duals[f] =
        finder.dual(s.mesh.points[a], s.mesh.points[b], s.mesh.points[c], report.searches_coarsen);
    report[Counter::unready_facets] += !s.duals[f].on_surface;
  }
}

}  // namespace

double coarsening_bound(const Parameters& p) {
  return p.refinement.asks(Criterion::distance) ? p.refinement[Criterion::distance]
                                                : kUsualBoundVoxels * p.voxel;
}

std::vector<std::uint8_t> coarsen(SurfaceMesh& s, const Given& given, double distance,
                                  const CoarsenScope& scope) {
  std::vector<std::uint8_t> changed = attempts(s, given, distance, scope);
  set_duals(s, changed, given);
  return changed;
}

void coarsen(SurfaceMesh& s, const Given& given) {
  const StepTimer timer(given.report.seconds_coarsen);
  begin_stage(given.parameters.observer, "coarsen");
  CoarsenScope scope{FreeBox::within(given.surface.volume()), {}};
  for (VertexId v = 0; v < s.mesh.points.size(); ++v) scope.first.push_back(v);
  s.duals.clear();
  attempts(s, given, coarsening_bound(given.parameters), scope);
  remove_dead(s);
  set_duals(s, {}, given);
  given.report.vertices_coarsened = s.mesh.points.size();
}

}  // namespace deliso
