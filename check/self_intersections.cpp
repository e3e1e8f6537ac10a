// SPDX-License-Identifier: MIT
#include "check/self_intersections.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "base/parallel.h"
#include "base/sorted_list.h"
#include "base/text.h"
#include "embedding/triangle_pair.h"
#include "exact/predicates.h"

namespace deliso {
namespace {

constexpr std::size_t kLeavesPerTask = 256;

class Search {
 public:
  Search(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
         const TriangleTree& tree, int threads)
      : points_(points), triangles_(triangles), tree_(tree), threads_(threads) {}

  // Looks at every leaf; once more at leaves that exhausted their work, if their share of the
  // common work is larger.
  Crossings run() {
    std::vector<std::size_t> leaves(tree_.leaf_count());
    std::iota(leaves.begin(), leaves.end(), 0);
    std::vector<Work> works = works_of(leaves);
    leaves.clear();
    for (const Work& work : works) {
      leaves.insert(leaves.end(), work.exhausted.begin(), work.exhausted.end());
    }
    if (!leaves.empty()) {
      limits_ = {std::max(kMaxBoxesPerLeaf, kBoxesShared / leaves.size()),
                 std::max(kMaxTestsPerLeaf, kTestsShared / leaves.size()),
                 std::max(kMaxFoundPerLeaf, kFoundShared / leaves.size())};
      for (Work& work : works) work.given_up.clear();
      std::ranges::move(works_of(leaves), std::back_inserter(works));
    }
    Crossings found;
    for (const Work& work : works) {
      found.pairs.insert(found.pairs.end(), work.pairs.begin(), work.pairs.end());
      found.given_up.insert(found.given_up.end(), work.given_up.begin(), work.given_up.end());
    }
    sort_unique(found.pairs);
    sort_unique(found.given_up);
    return found;
  }

 private:
  // Bounds on the work of a leaf.
  struct Limits {
    std::size_t boxes = kMaxBoxesPerLeaf, tests = kMaxTestsPerLeaf, found = kMaxFoundPerLeaf;
  };
  struct Work {
    std::size_t boxes = 0, tests = 0, found = 0;
    std::vector<std::pair<FaceId, FaceId>> pairs;
    std::vector<FaceId> given_up;
    std::vector<std::size_t> exhausted;
  };

  std::vector<Work> works_of(std::span<const std::size_t> leaves) const {
    std::vector<Work> works(runs_of(leaves.size(), kLeavesPerTask));
    for_each_run(threads_, leaves.size(), kLeavesPerTask,
                 [&](std::size_t run, std::size_t begin, std::size_t end) {
                   for (std::size_t n = begin; n < end; ++n) find_at(leaves[n], works[run]);
                 });
    return works;
  }

  // Finds the pairs of a leaf's triangles among themselves and with those of later leaves.
  void find_at(std::size_t leaf, Work& work) const {
    const std::span<const FaceId> mine = tree_.leaf(leaf);
    const std::span<const Box3> my_boxes = tree_.boxes_of_leaf(leaf);
    Box3 box = my_boxes[0];
    for (const Box3& other : my_boxes) box = united(box, other);
    const auto exhausted = [&] {
      return work.boxes > limits_.boxes || work.tests > limits_.tests || work.found > limits_.found;
    };
    work.boxes = work.tests = work.found = 0;
    tree_.for_each_leaf_at(box, leaf, work.boxes, [&](std::size_t other) {
      const std::span<const FaceId> theirs = tree_.leaf(other);
      const std::span<const Box3> their_boxes = tree_.boxes_of_leaf(other);
      for (std::size_t n = 0; n < theirs.size(); ++n) {
        if (!meet(box, their_boxes[n])) continue;
        for (std::size_t m = 0; m < (other == leaf ? n : mine.size()); ++m) {
          if (meet(my_boxes[m], their_boxes[n])) test(mine[m], theirs[n], work);
        }
      }
      return !exhausted();
    });
    if (!exhausted()) return;
    work.exhausted.push_back(leaf);
    work.given_up.insert(work.given_up.end(), mine.begin(), mine.end());
  }

  void test(FaceId f, FaceId g, Work& work) const {
    ++work.tests;
    if (!triangles_intersect(points_, triangles_[f], triangles_[g])) return;
    if (is_flat(f) || is_flat(g)) return;
    ++work.found;
    work.pairs.emplace_back(std::min(f, g), std::max(f, g));
  }
  bool is_flat(FaceId f) const {
    const Triangle& t = triangles_[f];
    return collinear(points_[t[0]], points_[t[1]], points_[t[2]]);
  }

  const std::vector<Vec3>& points_;
  std::span<const Triangle> triangles_;
  const TriangleTree& tree_;
  int threads_;
  Limits limits_;
};

}  // namespace

Crossings find_crossings(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                         const TriangleTree& tree, int threads) {
  return Search(points, triangles, tree, threads).run();
}

std::vector<std::pair<FaceId, FaceId>> report_self_intersections(const TriMesh& mesh,
                                                                 const CleanMesh& clean,
                                                                 int threads, Faults& faults) {
  const TriangleTree tree(clean.points, clean.triangles, threads);
  Crossings found = find_crossings(clean.points, clean.triangles, tree, threads);
  for (auto& pair : found.pairs) {
    pair = {clean.id[pair.first], clean.id[pair.second]};
    faults.add(
        FaultKind::self_intersections,
        [&] {
          return name_of_triangle(mesh, pair.first) + " meets " +
                 name_of_triangle(mesh, pair.second);
        },
        middle_of(mesh, pair.first));
  }
  if (!found.given_up.empty()) {
    const FaceId f = clean.id[found.given_up[0]];
    faults.add(FaultKind::not_measured,
               text("crossings of ", found.given_up.size(), " triangles, such as ",
                    name_of_triangle(mesh, f), ": too many lie across each other"),
               middle_of(mesh, f));
  }
  return std::move(found.pairs);
}

}  // namespace deliso
