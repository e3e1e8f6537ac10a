// SPDX-License-Identifier: MIT
#include "contour/contour.h"

#include <algorithm>

#include "contour/boundary_chains.h"
#include "contour/contour_stream.h"
#include "contour/voxel_point.h"

namespace deliso {
namespace {

// Makes T: positions of crossings, stars over loops, bands over tubes.
class MeshSink {
 public:
  MeshSink(ContourMesh& mesh, Vec3 spacing) : mesh_(mesh), spacing_(spacing) {}

  // Room for T, so that it need not move while it grows: 1.9 vertices per crossing, two triangles
  // per vertex.
  void expect(std::size_t crossings) {
    const std::size_t vertices = 2 * crossings;
    mesh_.points.reserve(vertices);
    mesh_.component.reserve(vertices);
    mesh_.box_faces.reserve(vertices);
    mesh_.triangles.reserve(2 * vertices);
  }

  VertexId crossing(int axis, Index3 sample, double c0, double c1, std::uint8_t box_faces) {
    Vec3 p{static_cast<double>(sample.i), static_cast<double>(sample.j),
           static_cast<double>(sample.k)};
    p[axis] += c0 / (c0 - c1);
    return add_vertex({p.x * spacing_.x, p.y * spacing_.y, p.z * spacing_.z}, box_faces, kNoId);
  }

  // A triangle, or a star around one more point of Sigma.
  void disk(Index3 voxel, const Corners& c, std::span<const VertexId> loop, std::uint32_t label) {
    Vec3 sum;
    for (const VertexId v : loop) {
      mesh_.component[v] = label;
      sum = sum + mesh_.points[v];
    }
    if (loop.size() == 3) {
      mesh_.triangles.push_back({loop[0], loop[1], loop[2]});
      return;
    }
    const Vec3 center = local(voxel, sum / static_cast<double>(loop.size()));
    const VertexId apex = add_inner(voxel, TrilinearPatch(c).surface_point_near(center), label);
    VertexId previous = loop.back();
    for (const VertexId v : loop) {
      mesh_.triangles.push_back({previous, v, apex});
      previous = v;
    }
  }

  // A band between the loops, one forwards and the other backwards, cut along the shortest chords
  // between them. Chords get a point of Sigma in the middle: it follows the neck, and no chord is
  // left that could lie in a face, where the voxel beyond might have the same.
  void tube(Index3 voxel, const Corners& c, std::span<const VertexId> a,
            std::span<const VertexId> b, std::uint32_t label) {
    for (const VertexId v : a) mesh_.component[v] = label;
    for (const VertexId v : b) mesh_.component[v] = label;
    const TrilinearPatch patch(c);
    const std::size_t n = a.size(), m = b.size();
    const auto forwards = [&](std::size_t i) { return a[i % n]; };
    const auto backwards = [&](std::size_t j) { return b[(2 * m - j) % m]; };
    const auto chord2 = [&](std::size_t i, std::size_t j) {
      return distance2(local(voxel, forwards(i)), local(voxel, backwards(j)));
    };
    std::size_t i = 0, j = 0;
    for (std::size_t at = 0; at < n * m; ++at) {
      if (chord2(at / m, at % m) < chord2(i, j)) i = at / m, j = at % m;
    }
    const auto middle = [&] {
      const Vec3 p = 0.5 * (local(voxel, forwards(i)) + local(voxel, backwards(j)));
      return add_inner(voxel, patch.surface_point_near(p), label);
    };
    const std::size_t i_end = i + n, j_end = j + m;
    const VertexId start = middle();
    VertexId ring = start;
    while (i < i_end || j < j_end) {
      const bool along_a = j == j_end || (i < i_end && chord2(i + 1, j) <= chord2(i, j + 1));
      const VertexId p = forwards(i), q = backwards(j);
      ++(along_a ? i : j);
      const VertexId next = i == i_end && j == j_end ? start : middle();
      if (along_a) {
        mesh_.triangles.push_back({p, forwards(i), next});
        mesh_.triangles.push_back({p, next, ring});
        mesh_.triangles.push_back({ring, next, q});
      } else {
        mesh_.triangles.push_back({backwards(j), q, ring});
        mesh_.triangles.push_back({backwards(j), ring, next});
        mesh_.triangles.push_back({ring, p, next});
      }
      ring = next;
    }
  }

 private:
  VertexId add_vertex(const Vec3& p, std::uint8_t box_faces, std::uint32_t label) {
    if (mesh_.points.size() >= kNoId) throw InputError("the contour has 2^32 vertices or more");
    mesh_.points.push_back(p);
    mesh_.box_faces.push_back(box_faces);
    mesh_.component.push_back(label);
    return static_cast<VertexId>(mesh_.points.size() - 1);
  }

  VertexId add_inner(Index3 voxel, const Vec3& u, std::uint32_t label) {
    return add_vertex(
        {(voxel.i + u.x) * spacing_.x, (voxel.j + u.y) * spacing_.y, (voxel.k + u.z) * spacing_.z},
        0, label);
  }

  // Coordinates in the voxel.
  Vec3 local(Index3 voxel, VertexId v) const { return local(voxel, mesh_.points[v]); }
  Vec3 local(Index3 voxel, const Vec3& p) const {
    return {p.x / spacing_.x - voxel.i, p.y / spacing_.y - voxel.j, p.z / spacing_.z - voxel.k};
  }

  ContourMesh& mesh_;
  Vec3 spacing_;
};

// Keeps nothing; crossings on the box are numbered so that their segments can be chained.
class CountingSink {
 public:
  void expect(std::size_t) {}
  VertexId crossing(int, Index3, double, double, std::uint8_t box_faces) {
    return box_faces != 0 ? next_++ : kNoId;
  }
  void disk(Index3, const Corners&, std::span<const VertexId>, std::uint32_t) {}
  void tube(Index3, const Corners&, std::span<const VertexId>, std::span<const VertexId>,
            std::uint32_t) {}

 private:
  VertexId next_ = 0;
};

struct StreamResult {
  ContourSummary summary;
  BoundaryChains boundary;
  std::vector<std::uint32_t> component_of_label;
};

template <class Sink>
StreamResult stream(const Volume& volume, double kappa, Sink& sink) {
  return volume.visit([&](const auto* samples) {
    ContourStream walk(volume, samples, kappa, sink);
    sink.expect(walk.estimate_crossings());
    walk.run();
    StreamResult result;
    result.summary.active_voxels = walk.active_voxels;
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
  MeshSink sink(mesh, volume.spacing());
  StreamResult result = stream(volume, kappa, sink);
  for (auto& component : mesh.component) component = result.component_of_label[component];
  mesh.summary = std::move(result.summary);
  mesh.boundary = std::move(result.boundary);
  return mesh;
}

ContourSummary summarize_contour(const Volume& volume, double kappa) {
  CountingSink sink;
  return stream(volume, kappa, sink).summary;
}

}  // namespace deliso
