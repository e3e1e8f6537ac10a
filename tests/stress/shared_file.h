// SPDX-License-Identifier: MIT
// A file of --label all --shared, in ASCII, and its invariants.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/ids.h"
#include "base/text.h"
#include "check/place_faults.h"
#include "mesh/tri_mesh.h"

namespace deliso::stress {

struct SharedFile {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<std::array<int, 2>> sides;  // label_front, label_behind

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

// True if each edge is passed as often in one direction as in the other, and once if `manifold`.
inline bool is_closed(std::span<const Triangle> triangles, bool manifold) {
  std::map<std::array<VertexId, 2>, std::array<int, 2>> passes;
  for (const Triangle& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(t[i], t[(i + 1) % 3]);
      ++passes[{a, b}][a == t[i] ? 0 : 1];
    }
  }
  return std::ranges::all_of(passes, [&](const auto& edge) {
    return edge.second[0] == edge.second[1] && (!manifold || edge.second[0] == 1);
  });
}

// Returns what is wrong with the file; empty if nothing is. `manifold`: edges of a label have two
// triangles.
inline std::string shared_fault(const SharedFile& file, bool manifold) {
  std::set<std::set<VertexId>> facets;
  std::set<int> labels;
  for (std::size_t f = 0; f < file.triangles.size(); ++f) {
    const Triangle& t = file.triangles[f];
    facets.insert({t[0], t[1], t[2]});
    labels.insert(file.sides[f].begin(), file.sides[f].end());
    if (file.sides[f][0] == file.sides[f][1]) return text("triangle ", f, " in one label");
  }
  if (facets.size() != file.triangles.size()) return "a triangle twice";
  for (const int label : labels) {
    if (!is_closed(file.of(label), manifold && label != 0)) return text(label, " is not closed");
  }
  const std::size_t crossings = find_place_faults(file.points, file.triangles).crossings;
  return crossings == 0 ? std::string() : text(crossings, " crossings");
}

}  // namespace deliso::stress
