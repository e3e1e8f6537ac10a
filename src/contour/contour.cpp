// SPDX-License-Identifier: MIT
#include "contour/contour.h"

#include <algorithm>

#include "contour/boundary_chains.h"
#include "contour/contour_stream.h"
#include "contour/piece_mesher.h"
#include "contour/split_voxels.h"

namespace deliso {
namespace {

// Keeps nothing; crossings on the box are numbered so that their segments can be chained.
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

// A sink that meshes, or counts: beside what the walk asks for,
//   expect(crossings): about how many there will be, before the first;
//   replace_boundary(segments): may put others in place of the walk's segments on the box.
template <class Sink>
concept MeshSink = ContourSink<Sink> &&
    requires(Sink& sink, std::vector<BoundarySegment>& segments) {
  sink.expect(std::size_t{});
  sink.replace_boundary(segments);
};

template <MeshSink Sink>
StreamResult stream(const Volume& volume, double kappa, Sink& sink) {
  return volume.visit([&](const auto* samples) {
    ContourStream walk(volume, samples, kappa, sink);
    sink.expect(walk.estimate_crossings());
    walk.run();
    StreamResult result;
    result.summary.active_voxels = walk.active_voxels;
    result.summary.tied_saddles = walk.tied_saddles;
    sink.replace_boundary(walk.boundary);
    auto& components = result.summary.components;
    result.component_of_label = walk.components.finish(components);
    for (auto& segment : walk.boundary) {
      segment.component = result.component_of_label[segment.component];
    }
    result.boundary = chain_segments(std::move(walk.boundary));
    for (const std::uint32_t c : result.boundary.component) ++components[c].boundary_loops;
    return result;
  });
}

void finish(ContourMesh& mesh, StreamResult result) {
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

ContourMesh build_contour(const Volume& volume, double kappa) {
  ContourMesh mesh;
  PieceMesher mesher(mesh, volume);
  finish(mesh, stream(volume, kappa, mesher));
  return mesh;
}

ContourMesh build_contour(const Volume& volume, double kappa, const ContourSplit& split) {
  const ChosenVoxels chosen = choose_split_voxels(volume, kappa, split);
  if (chosen.size() == 0) return build_contour(volume, kappa);
  ContourMesh mesh;
  SplitMesher mesher(mesh, volume, chosen, split);
  finish(mesh, stream(volume, kappa, mesher));
  mesh.split_voxels = chosen.size();
  return mesh;
}

ContourSummary summarize_contour(const Volume& volume, double kappa) {
  CountingSink sink;
  return stream(volume, kappa, sink).summary;
}

double settled_isovalue(const Volume& volume, double kappa) {
  const double effective = effective_isovalue(volume, kappa);
  return summarize_contour(volume, effective).tied_saddles > 0 ? lowered_isovalue(volume, effective)
                                                               : effective;
}

ContourMesh build_settled_contour(const Volume& volume, double& kappa) {
  kappa = effective_isovalue(volume, kappa);
  ContourMesh contour = build_contour(volume, kappa);
  if (contour.summary.tied_saddles == 0) return contour;
  kappa = lowered_isovalue(volume, kappa);
  return build_contour(volume, kappa);
}

}  // namespace deliso
