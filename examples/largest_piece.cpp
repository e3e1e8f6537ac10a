// SPDX-License-Identifier: MIT
// Triangle meshes by themselves, of any program: reads one, says what is wrong with it and what it
// is, and writes its largest component.
// Usage: largest_piece MESH PIECE, each .ply, .off, .obj, .stl or .vtp
#include <algorithm>
#include <cstdint>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "deliso/base/check.h"
#include "deliso/check/check_mesh.h"
#include "deliso/check/quality.h"
#include "deliso/io/mesh/read_mesh.h"
#include "deliso/io/mesh/write_mesh.h"

namespace {

// The triangles whose vertices are of that component. `component` is each vertex's.
deliso::TriMesh piece_of(const deliso::TriMesh& mesh, const std::vector<std::uint32_t>& component,
                         std::uint32_t number) {
  std::vector<deliso::VertexId> new_id(mesh.points.size(), deliso::kNoId);
  std::vector<deliso::Vec3> points;
  for (deliso::VertexId v = 0; v < mesh.points.size(); ++v) {
    if (component[v] != number) continue;
    new_id[v] = deliso::VertexId(points.size());
    points.push_back(mesh.points[v]);
  }
  std::vector<deliso::Triangle> triangles;
  for (const deliso::Face& face : mesh.faces) {
    if (component[face.v[0]] != number) continue;
    triangles.push_back({new_id[face.v[0]], new_id[face.v[1]], new_id[face.v[2]]});
  }
  return deliso::make_tri_mesh(std::move(points), triangles);  // with neighbors linked
}

int keep_largest(const char* input, const char* output) {
  const deliso::TriMesh mesh = deliso::read_mesh(input);
  const std::string fault = deliso::check_mesh(mesh);
  std::cout << "rules: " << (fault.empty() ? "all hold" : fault) << "\n";

  const deliso::MeshTopology topology = deliso::mesh_topology(mesh);
  for (const deliso::ComponentTopology& c : topology.components) {
    std::cout << "component: " << c.faces << " triangles, Euler number " << c.euler()
              << (c.closed() ? ", closed" : ", open") << "\n";
  }
  if (topology.components.empty()) return 1;
  const auto largest =
      std::max_element(topology.components.begin(), topology.components.end(),
                       [](const auto& a, const auto& b) { return a.faces < b.faces; });
  const auto number = static_cast<std::uint32_t>(largest - topology.components.begin());
  const deliso::TriMesh piece = piece_of(mesh, deliso::vertex_components(mesh), number);

  // 2 is what --lambda is by default, and no triangle is too small to be looked at.
  const deliso::MeshQuality quality = deliso::measure_quality(piece, 2, 0);
  std::cout << "largest: area " << quality.area << ", smallest angle " << quality.min_angle
            << " degrees";
  if (largest->closed()) std::cout << ", volume " << deliso::enclosed_volume(piece);
  std::cout << "\n";
  deliso::write_mesh(piece, output);
  return fault.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: largest_piece MESH PIECE\n";
    return 2;
  }
  try {
    return keep_largest(argv[1], argv[2]);
  } catch (const deliso::InputError& error) {
    std::cerr << "largest_piece: " << error.what() << "\n";
    return 2;
  }
}
