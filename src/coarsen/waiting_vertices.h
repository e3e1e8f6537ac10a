// SPDX-License-Identifier: MIT
// The vertices that wait for a try to remove them, in the order of changes near them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/tri_mesh.h"

namespace deliso {

class WaitingVertices {
 public:
  explicit WaitingVertices(std::size_t vertices)
      : waits_(vertices, 0), refused_(vertices, {kNoId, kNoId, kNoId}) {}

  // Remembers the facet for which v was refused, or forgets it.
  void refuse(VertexId v, const Triangle& facet) { refused_[v] = facet; }
  void forget_refusal(VertexId v) { refused_[v][0] = kNoId; }

  // Lets v wait if it may, as `changed`, v or a neighbor, is new, gone or elsewhere. Not if the
  // facet that v was refused for has its corners still: in one of 300 such tries it was not refused
  // again, and they were a quarter of all that failed.
  void wake(VertexId v, VertexId changed, bool may_wait) {
    Triangle& refused = refused_[v];
    if (refused[0] != kNoId && !has_corner(refused, changed)) return;
    refused[0] = kNoId;
    if (!may_wait || std::exchange(waits_[v], 1) != 0) return;
    waiting_.push_back(v);
  }

  // Passes over the vertices that wait. A vertex whose star changed in a pass is tried in the next
  // one, so removals spread over the mesh. Calls remove(v), and where it returns true
  // for_each_changed(visit), which calls visit(w) for the neighbors that v had and wakes them.
  template <class Remove, class ForEachChanged>
  void pass(Remove&& remove, ForEachChanged&& for_each_changed) {
    // Passes end when one removes less than this share of the vertices.
    constexpr double kLeastShare = 0.01;
    constexpr int kMostPasses = 30;
    IdArray<VertexId, std::int8_t> changed_in(waits_.size(), -1);
    std::size_t left = 0;
    for (std::int8_t pass = 0; pass < kMostPasses; ++pass) {
      const std::vector<VertexId> todo = std::exchange(waiting_, {});
      left = std::max(left, todo.size());
      std::size_t removed = 0;
      for (const VertexId v : todo) {
        if (changed_in[v] == pass) {
          waiting_.push_back(v);
          continue;
        }
        waits_[v] = 0;
        if (!remove(v)) continue;
        ++removed;
        for_each_changed(v, [&](VertexId w) { changed_in[w] = pass; });
      }
      left -= removed;
      if (removed == 0 || static_cast<double>(removed) < kLeastShare * static_cast<double>(left)) {
        return;
      }
    }
  }

 private:
  IdArray<VertexId, std::uint8_t> waits_;  // the vertex is in waiting_
  std::vector<VertexId> waiting_;
  IdArray<VertexId, Triangle> refused_;  // the facet that was refused last; kNoId: none
};

}  // namespace deliso
