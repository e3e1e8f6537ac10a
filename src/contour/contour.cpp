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
  ContourId crossing(int, Index3, double, double, std::uint8_t box_faces) override {
    return box_faces != 0 ? next_++ : kNoId;
  }
  void voxel(const VoxelPieces&) override {}

 private:
  ContourId next_ = 0;
};

// Links segments into chains. pre: every vertex starts one segment and ends one; `component` holds
// component numbers.
BoundaryChains chain_segments(std::vector<BoundarySegment> segments) {
  std::sort(segments.begin(), segments.end(),
            [](const auto& s, const auto& t) { return s.from < t.from; });
  const auto starting_at = [&](ContourId v) {
    const auto found = std::lower_bound(segments.begin(), segments.end(), v,
                                        [](const auto& s, ContourId id) { return s.from < id; });
    DELISO_CHECK(found != segments.end() && found->from == v);
    return static_cast<std::size_t>(found - segments.begin());
  };
  BoundaryChains chains;
  std::vector<bool> used(segments.size());
  for (std::size_t start = 0; start < segments.size(); ++start) {
    if (used[start]) continue;
    for (std::size_t s = start; !used[s]; s = starting_at(segments[s].to)) {
      used[s] = true;
      chains.vertices.push_back(segments[s].from);
      chains.face.push_back(segments[s].face);
    }
    BoxFace previous = chains.face.back();
    for (std::size_t n = chains.first.back(); n < chains.face.size(); ++n) {
      chains.on_box_edge.push_back(chains.face[n] != previous);
      previous = chains.face[n];
    }
    chains.first.push_back(static_cast<std::uint32_t>(chains.vertices.size()));
    chains.component.push_back(segments[start].component);
  }
  return chains;
}

// Returns the chains of kept components, with new numbers.
BoundaryChains kept_chains(const BoundaryChains& all,
                           const IdArray<ContourId, ContourId>& new_vertex,
                           const std::vector<std::uint32_t>& new_component) {
  BoundaryChains kept;
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (new_component[all.component[c]] == kNoId) continue;
    for (std::size_t n = all.first[c]; n < all.first[c + 1]; ++n) {
      kept.vertices.push_back(new_vertex[all.vertices[n]]);
      kept.face.push_back(all.face[n]);
      kept.on_box_edge.push_back(all.on_box_edge[n]);
    }
    kept.first.push_back(static_cast<std::uint32_t>(kept.vertices.size()));
    kept.component.push_back(new_component[all.component[c]]);
  }
  return kept;
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

  IdArray<ContourId, ContourId> new_vertex(contour.points.size(), kNoId);
  ContourId next = 0;
  for (ContourId v = 0; v < new_vertex.size(); ++v) {
    if (!kept[contour.component[v]]) continue;
    contour.points[next] = contour.points[v];
    contour.component[next] = new_component[contour.component[v]];
    contour.box_faces[next] = contour.box_faces[v];
    new_vertex[v] = next++;
  }
  contour.points.resize(next);
  contour.component.resize(next);
  contour.box_faces.resize(next);
  std::erase_if(contour.triangles, [&](ContourTriangle& triangle) {
    for (ContourId& v : triangle) v = new_vertex[v];
    return triangle[0] == kNoId;
  });
  contour.crowded.clear();  // numbers of triangles
  contour.boundary = kept_chains(contour.boundary, new_vertex, new_component);
}

ContourMesh build_contour(const Volume& volume, double kappa) {
  ContourMesh mesh;
  PieceMesher mesher(mesh, volume, kappa);
  complete(mesh, walk_contour(volume, kappa, mesher));
  return mesh;
}

void complete(ContourMesh& mesh, WalkResult found) {
  mesh.summary.active_voxels = found.active_voxels;
  auto& components = mesh.summary.components;
  const std::vector<std::uint32_t> component_of_label = found.components.finish(components);
  for (auto& component : mesh.component) component = component_of_label[component];
  for (auto& segment : found.boundary) segment.component = component_of_label[segment.component];
  mesh.boundary = chain_segments(std::move(found.boundary));
  for (const std::uint32_t c : mesh.boundary.component) ++components[c].boundary_loops;
}

ContourSummary summarize_contour(const Volume& volume, double kappa) {
  ContourMesh nothing;
  CountingSink sink;
  complete(nothing, walk_contour(volume, kappa, sink));
  return nothing.summary;
}

}  // namespace deliso
