// SPDX-License-Identifier: MIT
// The topology of Sigma in a volume, glued together from the exact oracle's voxels.
#pragma once

#include <bit>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "contour/exact_voxel.h"
#include "mesh/component_kinds.h"

namespace deliso {

// Returns nothing where the oracle is at fault: its axes differ in a voxel, or two voxels see
// different arcs on the face between them.
inline std::optional<ComponentKinds> glue_voxels(const Volume& volume, double kappa) {
  // Elements: grid edges, 3 * sample + axis. Pieces and arcs of the voxels join them.
  UnionFind surface(3 * volume.sample_count()), curves(3 * volume.sample_count());
  std::map<std::pair<int, int>, int> arcs;
  const auto element = [&](Index3 voxel, int e) {
    const auto [low, high] = corners_of_edge(e);
    return static_cast<int>(3 * volume.index(voxel.i + (low & 1), voxel.j + (low >> 1 & 1),
                                             voxel.k + (low >> 2))) +
           e / 4;
  };
  const Index3 voxels = volume.voxels();
  std::vector<std::pair<int, int>> on_box, pieces;
  std::set<int> crossings;
  for (int k = 0; k < voxels.k; ++k) {
    for (int j = 0; j < voxels.j; ++j) {
      for (int i = 0; i < voxels.i; ++i) {
        const Index3 voxel{i, j, k};
        const Corners samples = volume.corners(voxel);
        int inside = 0;
        for (const double v : samples) inside += v >= kappa;
        if (inside == 0 || inside == 8) continue;
        const VoxelTruth truth = ExactVoxel::solve(samples, kappa);
        if (!truth.resolved) return std::nullopt;
        for (const VoxelPiece& piece : truth.pieces) {
          const int first = element(voxel, std::countr_zero(static_cast<unsigned>(piece.edges)));
          for (int e = 0; e < 12; ++e) {
            if ((piece.edges >> e & 1) == 0) continue;
            surface.unite(first, element(voxel, e));
            crossings.insert(element(voxel, e));
          }
          pieces.push_back({first, piece.euler});
        }
        for (int f = 0; f < 6; ++f) {
          const int axis = f / 2;
          const bool box = voxel[axis] == ((f & 1) != 0 ? voxels[axis] - 1 : 0);
          for (int e = 0; e < 12; ++e) {
            const int mate = truth.mate[f][e];
            if (mate < 0) continue;
            const int a = element(voxel, e), b = element(voxel, mate);
            if (a > b) continue;
            arcs[{a, b}] += box ? 2 : 1;
            if (box) on_box.push_back({a, b});
          }
        }
      }
    }
  }
  std::map<int, int> euler;
  for (const int e : crossings) ++euler[surface.root(e)];
  for (const auto& [arc, sides] : arcs) {
    if (sides != 2) return std::nullopt;
    --euler[surface.root(arc.first)];
  }
  for (const auto& [first, piece_euler] : pieces) euler[surface.root(first)] += piece_euler;
  std::map<int, std::set<int>> loops;
  for (const auto& [a, b] : on_box) curves.unite(a, b);
  for (const auto& [a, b] : on_box) loops[surface.root(a)].insert(curves.root(a));
  ComponentKinds kinds;
  for (const auto& [root, e] : euler) kinds.emplace_back(e, loops[root].size());
  std::ranges::sort(kinds);
  return kinds;
}

}  // namespace deliso
