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
