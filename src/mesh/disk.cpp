// SPDX-License-Identifier: MIT
#include "mesh/disk.h"

#include <algorithm>

namespace deliso {

// The steps of link(). Inline: every operation links two disks.
inline void Disk::number_corners() {
  corners_.clear();
  ends_.clear();
  for (const Triangle& t : facets) {
    std::array<std::size_t, 3> local;  // place in corners_
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found = std::find(corners_.begin(), corners_.end(), t[i]);
      local[i] = static_cast<std::size_t>(found - corners_.begin());
      if (found == corners_.end()) corners_.push_back(t[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) ends_.push_back({local[(i + 1) % 3], local[(i + 2) % 3]});
  }
}

inline bool Disk::link_edges() {
  across.assign(facets.size(), {kNone, kNone, kNone});
  boundary.clear();
  const std::size_t vertices = corners_.size();
  edge_.assign(vertices * vertices, kNone);
  for (std::uint32_t e = 0; e < ends_.size(); ++e) {
    std::uint32_t& same = edge_[ends_[e].from * vertices + ends_[e].to];
    if (same != kNone) return false;  // two facets run along it in one direction
    same = e;
  }
  for (std::uint32_t e = 0; e < ends_.size(); ++e) {
    const auto [from, to] = ends_[e];
    const std::uint32_t back = edge_[to * vertices + from];
    if (back != kNone) {
      across[e / 3][e % 3] = back / 3;
      continue;
    }
    boundary.push_back({corners_[from], corners_[to], e / 3, static_cast<int>(e % 3)});
  }
  return true;
}

inline bool Disk::is_one_piece() {
  reached_.assign(1, 0);
  is_reached_.assign(facets.size(), 0);
  is_reached_[0] = 1;
  for (std::size_t k = 0; k < reached_.size(); ++k) {
    for (const std::uint32_t g : across[reached_[k]]) {
      if (g == kNone || is_reached_[g]) continue;
      is_reached_[g] = 1;
      reached_.push_back(g);
    }
  }
  return reached_.size() == facets.size();
}

bool Disk::link() {
  number_corners();
  if (!link_edges()) return false;
  // A surface in one piece with b boundaries has an Euler number of at most 2 - b, and the less,
  // the more vertices it meets itself in. So that of a disk, 1, leaves one boundary. A closed piece
  // besides the disk could make up for a handle: the facets must be one piece.
  const bool is_euler_of_disk = 2 * corners_.size() == facets.size() + boundary.size() + 2;
  return boundary.size() >= 3 && is_euler_of_disk && is_one_piece();
}

bool Disk::link_cone(const std::vector<BoundaryEdge>& rim, VertexId apex) {
  if (facets.size() != rim.size()) return false;
  for (std::size_t k = 0; k < rim.size(); ++k) {
    if (facets[k] != Triangle{rim[k].from, rim[k].to, apex}) return false;
  }
  across.assign(rim.size(), {kNone, kNone, kNone});
  boundary.clear();
  corners_.assign(1, apex);
  for (std::uint32_t k = 0; k < rim.size(); ++k) {
    boundary.push_back({rim[k].from, rim[k].to, k, 2});
    corners_.push_back(rim[k].from);
    std::uint32_t next = 0;
    while (rim[next].from != rim[k].to) ++next;
    across[k][0] = next;
    across[next][1] = k;
  }
  return true;
}

}  // namespace deliso
