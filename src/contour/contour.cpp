// SPDX-License-Identifier: MIT
#include "contour/contour.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

#include "contour/contour_stream.h"
#include "contour/piece_mesher.h"

namespace deliso {
namespace {

// Keeps nothing. Crossings on the box are numbered, so that their segments can be chained.
class CountingSink final : public ContourSink {
 public:
  VertexId crossing(int, Index3, double, double, std::uint8_t box_faces) override {
    return box_faces != 0 ? next_++ : kNoId;
  }
  void voxel(const VoxelPieces&) override {}

 private:
  VertexId next_ = 0;
};

// Links segments into closed loops, each from its smallest vertex. pre: every vertex starts one
// segment and ends one.
std::vector<std::vector<BoundarySegment>> linked(std::vector<BoundarySegment> segments) {
  std::sort(segments.begin(), segments.end(),
            [](const auto& s, const auto& t) { return s.from < t.from; });
  const auto starting_at = [&](VertexId v) {
    const auto found = std::lower_bound(segments.begin(), segments.end(), v,
                                        [](const auto& s, VertexId id) { return s.from < id; });
    DELISO_CHECK(found != segments.end() && found->from == v);
    return static_cast<std::size_t>(found - segments.begin());
  };
  std::vector<std::vector<BoundarySegment>> loops;
  std::vector<bool> used(segments.size());
  for (std::size_t start = 0; start < segments.size(); ++start) {
    if (used[start]) continue;
    std::vector<BoundarySegment>& loop = loops.emplace_back();
    for (std::size_t s = start; !used[s]; s = starting_at(segments[s].to)) {
      used[s] = true;
      loop.push_back(segments[s]);
    }
  }
  return loops;
}

// Gives the mesh its components and summary. Returns the loops of its boundary.
std::vector<std::vector<BoundarySegment>> summarize(ContourMesh& mesh, WalkResult found) {
  mesh.summary.active_voxels = found.active_voxels;
  auto& components = mesh.summary.components;
  const std::vector<std::uint32_t> component_of_label = found.components.finish(components);
  for (auto& component : mesh.component) component = component_of_label[component];
  for (auto& segment : found.boundary) segment.component = component_of_label[segment.component];
  auto loops = linked(std::move(found.boundary));
  for (const auto& loop : loops) ++components[loop[0].component].boundary_loops;
  return loops;
}

}  // namespace

std::int64_t ContourSummary::euler() const {
  std::int64_t sum = 0;
  for (const auto& component : components) sum += component.euler;
  return sum;
}

std::uint64_t ContourSummary::boundary_loops() const {
  std::uint64_t sum = 0;
  for (const auto& component : components) sum += component.boundary_loops;
  return sum;
}

std::vector<std::uint8_t> chosen_components(const ContourSummary& summary,
                                            const ComponentChoice& choice) {
  const std::vector<ContourComponent>& components = summary.components;
  std::vector<std::uint8_t> chosen;
  std::ranges::transform(components, std::back_inserter(chosen),
                         [&](const ContourComponent& c) { return c.side() >= choice.min_voxels; });
  if (choice.largest == 0 || choice.largest >= components.size()) return chosen;
  std::vector<std::size_t> by_size(components.size());
  std::iota(by_size.begin(), by_size.end(), 0);
  std::ranges::stable_sort(by_size, std::ranges::greater(),
                           [&](std::size_t c) { return components[c].crossings; });
  for (const std::size_t c : std::span(by_size).subspan(choice.largest)) chosen[c] = 0;
  return chosen;
}

void keep_components(ContourMesh& contour, std::span<const std::uint8_t> kept) {
  if (std::ranges::find(kept, 0) == kept.end()) return;
  std::vector<std::uint32_t> new_component(kept.size(), kNoId);
  std::vector<ContourComponent> components;
  for (std::uint32_t c = 0; c < kept.size(); ++c) {
    if (!kept[c]) continue;
    new_component[c] = static_cast<std::uint32_t>(components.size());
    components.push_back(contour.summary.components[c]);
  }
  contour.summary.components = std::move(components);

  std::vector<VertexId> new_vertex(contour.points.size(), kNoId);
  VertexId next = 0;
  for (VertexId v = 0; v < new_vertex.size(); ++v) {
    if (!kept[contour.component[v]]) continue;
    contour.points[next] = contour.points[v];
    contour.component[next] = new_component[contour.component[v]];
    contour.box_faces[next] = contour.box_faces[v];
    new_vertex[v] = next++;
  }
  contour.points.resize(next);
  contour.component.resize(next);
  contour.box_faces.resize(next);
  std::erase_if(contour.triangles, [&](std::array<VertexId, 3>& triangle) {
    for (VertexId& v : triangle) v = new_vertex[v];
    return triangle[0] == kNoId;
  });
  contour.crowded.clear();  // numbers of triangles
  ContourBoundary all = std::exchange(contour.boundary, {});
  for (std::size_t loop = 0; loop < all.size(); ++loop) {
    const std::uint32_t component = new_component[all.component[loop]];
    if (component == kNoId) continue;
    for (VertexId& v : all.vertices[loop]) v = new_vertex[v];
    contour.boundary.loops.push_back(std::move(all.loops[loop]));
    contour.boundary.vertices.push_back(std::move(all.vertices[loop]));
    contour.boundary.component.push_back(component);
  }
}

ContourMesh build_contour(const Volume& volume, double kappa) {
  ContourMesh mesh;
  PieceMesher mesher(mesh, volume, kappa);
  complete(mesh, walk_contour(volume, kappa, mesher), volume.inner_faces());
  return mesh;
}

void complete(ContourMesh& mesh, WalkResult found, unsigned inner) {
  ContourBoundary& boundary = mesh.boundary;
  for (const std::vector<BoundarySegment>& segments : summarize(mesh, std::move(found))) {
    BoundaryLoop& loop = boundary.loops.emplace_back();
    std::vector<VertexId>& vertices = boundary.vertices.emplace_back();
    boundary.component.push_back(segments[0].component);
    BoxFace previous = segments.back().face;
    for (const auto& [from, to, component, face] : segments) {
      const bool is_fixed = (inner >> face & 1) != 0;
      loop.push_back({mesh.points[from], face, face != previous || is_fixed, is_fixed});
      vertices.push_back(from);
      previous = face;
    }
  }
}

ContourSummary summarize_contour(const Volume& volume, double kappa) {
  ContourMesh nothing;
  CountingSink sink;
  summarize(nothing, walk_contour(volume, kappa, sink));
  return nothing.summary;
}

}  // namespace deliso
