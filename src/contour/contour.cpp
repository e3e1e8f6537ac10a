// SPDX-License-Identifier: MIT
#include "contour/contour.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "contour/boundary_chains.h"
#include "contour/contour_stream.h"
#include "contour/piece_mesher.h"
#include "contour/slabs.h"
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
  std::size_t vertices() const { return next_; }

 private:
  VertexId next_ = 0;
};

struct StreamResult {
  ContourSummary summary;
  BoundaryChains boundary;
  std::vector<std::uint32_t> component_of_label;
  std::vector<SlabNumbers> numbers;
};

// A ContourSink that meshes or counts. It also has:
//   - expect(crossings) receives an estimate of their number before the first.
//   - replace_boundary(segments) may replace the walk's segments on the box.
//   - vertices() returns how many ids the sink has given.
template <class Sink>
concept MeshSink = ContourSink<Sink> &&
    requires(Sink& sink, std::vector<BoundarySegment>& segments) {
  sink.expect(std::size_t{});
  sink.replace_boundary(segments);
  { sink.vertices() } -> std::same_as<std::size_t>;
};

// Walks all slabs, each with a sink of its own.
template <MeshSink Sink>
StreamResult stream(const Volume& volume, double kappa, const std::vector<Slab>& slabs,
                    std::vector<Sink>& sinks, int threads) {
  std::vector<SlabWalk> walks(slabs.size());
  std::vector<std::size_t> vertices(slabs.size());
  for_each_task(threads, slabs.size(), [&](std::size_t n) {
    ContourStream walk(volume, kappa, sinks[n], slabs[n]);
    sinks[n].expect(walk.estimate_crossings());
    walk.run();
    walks[n] = std::move(walk.found());
    sinks[n].replace_boundary(walks[n].boundary);
    vertices[n] = sinks[n].vertices();
  });
  StreamResult result;
  result.numbers = weld(walks, vertices);
  SlabWalk& all = walks[0];
  result.summary.active_voxels = all.active_voxels;
  auto& components = result.summary.components;
  result.component_of_label = all.components.finish(components);
  for (auto& segment : all.boundary) {
    segment.component = result.component_of_label[segment.component];
  }
  result.boundary = chain_segments(std::move(all.boundary));
  for (const std::uint32_t c : result.boundary.component) ++components[c].boundary_loops;
  return result;
}

// Returns the mesh that the sinks make, one for each slab; make_sink(mesh) returns a sink that
// fills `mesh`.
template <class MakeSink>
ContourMesh mesh_slabs(const Volume& volume, double kappa, const std::vector<Slab>& slabs,
                       int threads, MakeSink&& make_sink) {
  std::vector<ContourMesh> parts(slabs.size());
  std::vector<decltype(make_sink(parts[0]))> sinks;
  sinks.reserve(parts.size());
  for (ContourMesh& part : parts) sinks.push_back(make_sink(part));
  StreamResult result = stream(volume, kappa, slabs, sinks, threads);
  ContourMesh mesh = weld(std::move(parts), result.numbers, threads);
  for (auto& component : mesh.component) component = result.component_of_label[component];
  mesh.summary = std::move(result.summary);
  mesh.boundary = std::move(result.boundary);
  return mesh;
}

std::vector<Slab> slabs_of(const Volume& volume, int threads) {
  return cut_into_slabs(volume.dims(), threads, [](int) { return true; });
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

ContourMesh build_contour(const Volume& volume, double kappa, int threads) {
  return mesh_slabs(volume, kappa, slabs_of(volume, threads), threads,
                    [&](ContourMesh& part) { return PieceMesher(part, volume); });
}

ContourMesh build_contour(const Volume& volume, double kappa, const ContourSplit& split,
                          int threads) {
  const ChosenVoxels chosen = choose_split_voxels(volume, kappa, split, threads);
  if (chosen.size() == 0) return build_contour(volume, kappa, threads);
  // The crossings on a split voxel's face are numbered once, so no split voxel may touch the layer
  // in which slabs meet.
  const std::vector<Slab> slabs = cut_into_slabs(volume.dims(), threads, [&](int k) {
    return !chosen.any_in_layer(k - 1) && !chosen.any_in_layer(k - 2);
  });
  ContourMesh mesh = mesh_slabs(volume, kappa, slabs, threads, [&](ContourMesh& part) {
    return SplitMesher(part, volume, chosen, split);
  });
  mesh.split_voxels = chosen.size();
  return mesh;
}

ContourSummary summarize_contour(const Volume& volume, double kappa, int threads) {
  const std::vector<Slab> slabs = slabs_of(volume, threads);
  std::vector<CountingSink> sinks(slabs.size());
  return stream(volume, kappa, slabs, sinks, threads).summary;
}

}  // namespace deliso
