// SPDX-License-Identifier: MIT
#include "contour/contour.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

#include "contour/boundary_chains.h"
#include "contour/contour_stream.h"
#include "contour/piece_mesher.h"
#include "contour/split_voxels.h"

namespace deliso {
namespace {

// Keeps nothing. Crossings on the box are numbered, so that their segments can be chained.
class CountingSink {
 public:
  void expect(std::size_t) {}
  VertexId crossing(int, Index3, double, double, std::uint8_t box_faces) {
    return box_faces != 0 ? next_++ : kNoId;
  }
  void voxel(const VoxelPieces&) {}
  void replace_boundary(std::vector<BoundarySegment>&) {}

 private:
  VertexId next_ = 0;
};

struct StreamResult {
  ContourSummary summary;
  BoundaryChains boundary;
  std::vector<std::uint32_t> component_of_label;
};

// A ContourSink that meshes or counts. It also has:
//   - expect(crossings) receives an estimate of their number before the first.
//   - replace_boundary(segments) may replace the walk's segments on the box.
template <class Sink>
concept MeshSink = ContourSink<Sink> &&
    requires(Sink& sink, std::vector<BoundarySegment>& segments) {
  sink.expect(std::size_t{});
  sink.replace_boundary(segments);
};

// Walks the volume.
template <MeshSink Sink>
StreamResult stream(const Volume& volume, double kappa, Sink& sink) {
  ContourStream walk(volume, kappa, sink);
  sink.expect(walk.estimate_crossings());
  walk.run();
  WalkResult& found = walk.found();
  sink.replace_boundary(found.boundary);
  StreamResult result;
  result.summary.active_voxels = found.active_voxels;
  auto& components = result.summary.components;
  result.component_of_label = found.components.finish(components);
  for (auto& segment : found.boundary) {
    segment.component = result.component_of_label[segment.component];
  }
  result.boundary = chain_segments(std::move(found.boundary));
  for (const std::uint32_t c : result.boundary.component) ++components[c].boundary_loops;
  return result;
}

// Walks the volume with a sink that fills `mesh`, and completes it.
template <MeshSink Sink>
void fill(ContourMesh& mesh, const Volume& volume, double kappa, Sink sink) {
  StreamResult result = stream(volume, kappa, sink);
  for (auto& component : mesh.component) component = result.component_of_label[component];
  mesh.summary = std::move(result.summary);
  mesh.boundary = std::move(result.boundary);
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

ContourMesh build_contour(const Volume& volume, double kappa) {
  ContourMesh mesh;
  fill(mesh, volume, kappa, PieceMesher(mesh, volume, kappa));
  return mesh;
}

ContourMesh build_contour(const Volume& volume, double kappa, const ContourSplit& split) {
  const ChosenVoxels chosen = choose_split_voxels(volume, kappa, split);
  if (chosen.size() == 0) return build_contour(volume, kappa);
  ContourMesh mesh;
  fill(mesh, volume, kappa, SplitMesher(mesh, volume, kappa, chosen, split));
  mesh.split_voxels = chosen.size();
  return mesh;
}

ContourSummary summarize_contour(const Volume& volume, double kappa) {
  CountingSink sink;
  return stream(volume, kappa, sink).summary;
}

}  // namespace deliso
