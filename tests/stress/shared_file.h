// SPDX-License-Identifier: MIT
// A file of --label all --shared, in ASCII, and its invariants.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/box3.h"
#include "base/ids.h"
#include "base/text.h"
#include "check/place_faults.h"
#include "mesh/tri_mesh.h"

namespace deliso::stress {

struct SharedFile {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  // label_front, label_behind. No label is negative: in front, face f of the box is -(f + 1).
  std::vector<std::array<int, 2>> sides;

  // Returns the triangles of a label, counter-clockwise seen from outside.
  std::vector<Triangle> of(int label) const {
    std::vector<Triangle> found;
    for (std::size_t f = 0; f < triangles.size(); ++f) {
      const Triangle& t = triangles[f];
      if (sides[f][1] == label) found.push_back(t);
      if (sides[f][0] == label) found.push_back({t[0], t[2], t[1]});
    }
    return found;
  }
};

inline SharedFile read_shared(const std::string& name) {
  std::ifstream in(name);
  std::size_t points = 0;
  for (std::string line; std::getline(in, line) && line != "end_header";) {
    if (line.starts_with("element vertex ")) points = std::stoul(line.substr(15));
  }
  SharedFile file;
  for (Vec3 p; points > 0 && in >> p.x >> p.y >> p.z; --points) file.points.push_back(p);
  std::uint32_t count = 0, a = 0, b = 0, c = 0;
  for (std::array<int, 2> s{}; in >> count >> a >> b >> c >> s[0] >> s[1];) {
    file.triangles.push_back({VertexId(a), VertexId(b), VertexId(c)});
    file.sides.push_back(s);
  }
  return file;
}

// Returns the first fault of a label's triangles; empty if there is none: an edge has one triangle
// in each direction, or it is in a face of the box if the label may end there.
inline std::string fault_of_edges(const SharedFile& file, int label, const Box3& box,
                                  bool may_end) {
  std::map<std::array<VertexId, 2>, std::array<int, 2>> passes;
  for (const Triangle& t : file.of(label)) {
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(t[i], t[(i + 1) % 3]);
      ++passes[{a, b}][a == t[i] ? 0 : 1];
    }
  }
  for (const auto& [edge, counts] : passes) {
    const auto [forward, backward] = counts;
    if (forward > 1 || backward > 1) return text("label ", label, " is no manifold");
    if (forward == backward) continue;
    const Vec3 &p = file.points[edge[0].number()], &q = file.points[edge[1].number()];
    if (!may_end || !on_one_face(p, q, box)) return text("label ", label, " is not closed");
  }
  return {};
}

// Returns what is wrong with the file; empty if nothing is. `box`: of the volume, in the world.
inline std::string shared_fault(const SharedFile& file, const Box3& box, bool capped) {
  std::set<std::set<VertexId>> facets;
  std::set<int> labels;
  for (std::size_t f = 0; f < file.triangles.size(); ++f) {
    const Triangle& t = file.triangles[f];
    const auto [front, behind] = file.sides[f];
    facets.insert({t[0], t[1], t[2]});
    labels.insert(behind);
    if (front == behind) return text("triangle ", f, " in one label");
    unsigned faces = ~0u;  // in which all of it lies
    for (const VertexId v : t) faces &= box_faces_at(file.points[v.number()], box);
    if (front >= 0) {
      labels.insert(front);
      if (faces != 0) return text("triangle ", f, " between two labels lies on the box");
      continue;
    }
    if (!capped || behind == 0) return text("triangle ", f, " on the box is none of a cap");
    if ((faces >> (-front - 1) & 1) == 0) return text("triangle ", f, " lies in another face");
  }
  if (facets.size() != file.triangles.size()) return "a triangle twice";
  for (const int label : labels) {
    const std::string fault = fault_of_edges(file, label, box, !capped || label == 0);
    if (!fault.empty()) return fault;
  }
  const std::size_t crossings = find_place_faults(file.points, file.triangles).crossings;
  return crossings == 0 ? std::string() : text(crossings, " crossings");
}

}  // namespace deliso::stress
