// SPDX-License-Identifier: MIT
#include "check/self_intersections.h"

#include <algorithm>
#include <array>
#include <deque>
#include <iterator>
#include <numeric>
#include <tuple>

#include "base/parallel.h"
#include "base/sorted_list.h"
#include "delaunay/predicates.h"
#include "embedding/triangle_pair.h"
#include "mesh/first_at_place.h"

namespace deliso {
namespace {

constexpr std::size_t kLeavesPerTask = 256;
constexpr double kArcRounding = 1e-14;  // more than the rounding of an arc's directions

// A tree of triangles with their ids in the mesh; `ids` is empty if they are the tree's own.
struct NamedTree {
  const TriangleTree* tree;
  std::span<const FaceId> ids;
  FaceId id(FaceId f) const { return ids.empty() ? f : ids[f]; }
};

// Some triangles of the mesh, all at `center` unless that is kNoId, and a tree of them or of their
// arcs. Never moved, since the tree refers to it.
struct Group {
  Group(VertexId at, std::vector<FaceId> these, const std::vector<Vec3>& points,
        std::vector<Triangle> in_place, int threads, double slack = 0)
      : center(at),
        ids(std::move(these)),
        corners(std::move(in_place)),
        tree(points, corners, threads, slack) {}
  NamedTree named() const { return {&tree, ids}; }

  VertexId center;
  std::vector<FaceId> ids;
  std::vector<Triangle> corners;
  TriangleTree tree;
};

class Search {
 public:
  Search(const std::vector<Vec3>& points, std::span<const Triangle> triangles, int threads)
      : points_(points), triangles_(triangles), threads_(threads), flat_(triangles.size()) {
    for_each_run(threads, triangles.size(), 1u << 14, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const Triangle& t = triangles[f];
        flat_[f] = collinear(points[t[0]], points[t[1]], points[t[2]]);
      }
    });
  }

  // Finds pairs within each of some trees.
  void find_within(std::span<const NamedTree> trees) {
    std::vector<std::pair<const NamedTree*, std::size_t>> leaves;
    for (const NamedTree& named : trees) {
      for (std::size_t n = 0; n < named.tree->leaf_count(); ++n) leaves.emplace_back(&named, n);
    }
    run(leaves.size(), [&](std::size_t n, Work& work) {
      find_within_leaf(*leaves[n].first, leaves[n].second, work);
    });
  }

  // Finds pairs of triangles of different groups, except pairs that share a center. The last group
  // may have no center.
  void find_between(const std::deque<Group>& groups, const std::vector<bool>& is_center) {
    // A tree of the groups, each as a triangle with the group's box.
    std::vector<Vec3> ends;
    std::vector<Triangle> boxes;
    std::vector<std::pair<FaceId, FaceId>> items;  // a group, and a triangle of it
    for (FaceId k = 0; k < groups.size(); ++k) {
      const Box3& box = groups[k].tree.box();
      ends.insert(ends.end(), {box.lo, box.hi});
      boxes.push_back({VertexId(2 * k), VertexId(2 * k + 1), VertexId(2 * k + 1)});
      if (k + 1 == groups.size()) break;
      for (const FaceId f : groups[k].ids) items.emplace_back(k, f);
    }
    const TriangleTree places(ends, boxes, threads_);
    run(items.size(), [&](std::size_t n, Work& work) {
      const FaceId mine = items[n].first, f = items[n].second;
      const Triangle& t = triangles_[f];
      const Box3 box = box_of(points_[t[0]], points_[t[1]], points_[t[2]]);
      places.for_each_leaf_near(box, 0, 0, work.boxes, [&](std::size_t leaf, const Box3&) {
        for (const FaceId k : places.leaf(leaf)) {
          if (k <= mine || has_corner(t, groups[k].center)) continue;
          find_between(f, box, groups[k], is_center, work);
        }
        return !exhausted(work);
      });
      if (exhausted(work)) work.given_up.push_back(f);
    });
  }

  bool is_flat(FaceId f) const { return flat_[f]; }

  Crossings take_crossings() {
    sort_unique(found_.pairs);
    sort_unique(found_.given_up);
    return std::move(found_);
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

  bool exhausted(const Work& work) const {
    return work.boxes > limits_.boxes || work.tests > limits_.tests || work.found > limits_.found;
  }

  void find_within_leaf(const NamedTree& named, std::size_t leaf, Work& work) const {
    const TriangleTree& tree = *named.tree;
    const std::span<const FaceId> mine = tree.leaf(leaf);
    const std::span<const Box3> my_boxes = tree.boxes_of_leaf(leaf);
    Box3 box = my_boxes[0];
    for (const Box3& other : my_boxes) box = united(box, other);
    tree.for_each_leaf_near(box, 0, leaf, work.boxes, [&](std::size_t other, const Box3&) {
      const std::span<const FaceId> theirs = tree.leaf(other);
      const std::span<const Box3> their_boxes = tree.boxes_of_leaf(other);
      for (std::size_t m = 0; m < mine.size(); ++m) {
        for (std::size_t n = other == leaf ? m + 1 : 0; n < theirs.size(); ++n) {
          if (!meet(my_boxes[m], their_boxes[n])) continue;
          test(named.id(mine[m]), named.id(theirs[n]), work);
        }
      }
      return !exhausted(work);
    });
    if (!exhausted(work)) return;
    for (const FaceId f : mine) work.given_up.push_back(named.id(f));
  }

  // Finds pairs of the triangle f, which has this box, and those of a group.
  void find_between(FaceId f, const Box3& box, const Group& group,
                    const std::vector<bool>& is_center, Work& work) const {
    const auto share_center = [&](const Triangle& s, const Triangle& t) {
      return std::any_of(s.begin(), s.end(),
                         [&](VertexId v) { return is_center[v] && has_corner(t, v); });
    };
    group.tree.for_each_leaf_near(box, 0, 0, work.boxes, [&](std::size_t leaf, const Box3&) {
      const std::span<const FaceId> theirs = group.tree.leaf(leaf);
      const std::span<const Box3> their_boxes = group.tree.boxes_of_leaf(leaf);
      for (std::size_t n = 0; n < theirs.size(); ++n) {
        const FaceId g = group.ids[theirs[n]];
        if (!meet(box, their_boxes[n])) continue;
        if (!share_center(triangles_[f], triangles_[g])) test(f, g, work);
      }
      return !exhausted(work);
    });
  }

  void test(FaceId f, FaceId g, Work& work) const {
    ++work.tests;
    if (flat_[f] || flat_[g] || !triangles_intersect(points_, triangles_[f], triangles_[g])) return;
    ++work.found;
    work.pairs.emplace_back(std::min(f, g), std::max(f, g));
  }

  // Calls look(n, work) for every n below `size`, each with the work of one leaf. Calls it once
  // more for leaves that exhausted it, if their share of the common work is larger.
  template <class Look>
  void run(std::size_t size, const Look& look) {
    std::vector<std::size_t> all(size);
    std::iota(all.begin(), all.end(), 0);
    limits_ = {};
    std::vector<Work> works = works_of(all, look);
    std::vector<std::size_t> more;
    for (const Work& work : works) {
      more.insert(more.end(), work.exhausted.begin(), work.exhausted.end());
    }
    if (!more.empty()) {
      limits_ = {std::max(kMaxBoxesPerLeaf, kBoxesShared / more.size()),
                 std::max(kMaxTestsPerLeaf, kTestsShared / more.size()),
                 std::max(kMaxFoundPerLeaf, kFoundShared / more.size())};
      if (limits_.boxes > kMaxBoxesPerLeaf || limits_.tests > kMaxTestsPerLeaf ||
          limits_.found > kMaxFoundPerLeaf) {
        for (Work& work : works) work.given_up.clear();
        std::vector<Work> again = works_of(more, look);
        std::move(again.begin(), again.end(), std::back_inserter(works));
      }
    }
    for (const Work& work : works) {
      found_.pairs.insert(found_.pairs.end(), work.pairs.begin(), work.pairs.end());
      found_.given_up.insert(found_.given_up.end(), work.given_up.begin(), work.given_up.end());
    }
  }

  template <class Look>
  std::vector<Work> works_of(std::span<const std::size_t> numbers, const Look& look) const {
    std::vector<Work> works(runs_of(numbers.size(), kLeavesPerTask));
    for_each_run(threads_, numbers.size(), kLeavesPerTask,
                 [&](std::size_t run, std::size_t begin, std::size_t end) {
                   Work& work = works[run];
                   for (std::size_t n = begin; n < end; ++n) {
                     work.boxes = work.tests = work.found = 0;
                     look(numbers[n], work);
                     if (exhausted(work)) work.exhausted.push_back(numbers[n]);
                   }
                 });
    return works;
  }

  const std::vector<Vec3>& points_;
  std::span<const Triangle> triangles_;
  int threads_;
  Limits limits_;
  std::vector<std::uint8_t> flat_;
  Crossings found_;
};

// Returns the arcs in which a vertex sees the triangles around it. An arc is represented by a
// triangle that holds it: its ends, and the point where the tangents there meet.
std::vector<Triangle> arcs_around(VertexId center, const std::vector<Vec3>& points,
                                  std::span<const Triangle> triangles,
                                  std::vector<Vec3>& directions) {
  const auto direction = [&](VertexId to) {
    const Vec3 d = points[to] - points[center];
    return d / length(d);
  };
  std::vector<Triangle> arcs;
  arcs.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    const int i = t[0] == center ? 0 : t[1] == center ? 1 : 2;
    const Vec3 b = direction(t[(i + 1) % 3]), c = direction(t[(i + 2) % 3]);
    const auto first = VertexId(directions.size());
    directions.insert(directions.end(), {b, c, (b + c) / std::max(1 + dot(b, c), kArcRounding)});
    arcs.push_back({first, VertexId(first + 1), VertexId(first + 2)});
  }
  return arcs;
}

// Finds pairs if some vertices, the centers, have many triangles; the first has the most. A group
// holds the triangles at a center and at none before it; the last group holds those at no center.
void search_stars(const std::vector<Vec3>& points, std::span<const Triangle> triangles, int threads,
                  std::span<const VertexId> centers, Search& search) {
  std::vector<bool> is_center(points.size(), false);
  std::vector<std::uint32_t> number(points.size(), kNoId);
  for (std::uint32_t n = 0; n < centers.size(); ++n) {
    is_center[centers[n]] = true;
    number[centers[n]] = n;
  }
  std::vector<std::vector<FaceId>> around(centers.size()), own(centers.size() + 1);
  for (FaceId f = 0; f < triangles.size(); ++f) {
    std::size_t first = centers.size();
    for (const VertexId v : triangles[f]) {
      if (!is_center[v]) continue;
      if (!search.is_flat(f)) around[number[v]].push_back(f);
      first = std::min<std::size_t>(first, number[v]);
    }
    own[first].push_back(f);
  }
  const auto corners_of = [&](std::span<const FaceId> ids) {
    std::vector<Triangle> corners;
    for (const FaceId f : ids) corners.push_back(triangles[f]);
    return corners;
  };
  std::vector<Vec3> directions;
  std::deque<Group> stars, groups;
  std::vector<NamedTree> trees;
  for (std::size_t n = 0; n < centers.size(); ++n) {
    std::vector<Triangle> arcs = arcs_around(centers[n], points, corners_of(around[n]), directions);
    stars.emplace_back(centers[n], std::move(around[n]), directions, std::move(arcs), threads,
                       kArcRounding);
    trees.push_back(stars.back().named());
  }
  for (std::size_t n = 0; n < own.size(); ++n) {
    if (own[n].empty()) continue;
    std::vector<Triangle> corners = corners_of(own[n]);
    groups.emplace_back(n < centers.size() ? centers[n] : kNoId, std::move(own[n]), points,
                        std::move(corners), threads);
  }
  if (groups.back().center == kNoId) trees.push_back(groups.back().named());
  search.find_within(trees);
  search.find_between(groups, is_center);
}

}  // namespace

Crossings find_crossings(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                         const TriangleTree& tree, int threads) {
  std::vector<std::uint32_t> degree(points.size(), 0);
  for (const Triangle& t : triangles) {
    for (const VertexId v : t) ++degree[v];
  }
  std::vector<VertexId> centers;
  for (VertexId v = 0; v < points.size(); ++v) {
    if (degree[v] > kMaxBoxStar) centers.push_back(v);
  }
  // Largest stars first. Then few triangles of another star are at a center, where all triangles of
  // its own star meet.
  std::stable_sort(centers.begin(), centers.end(),
                   [&](VertexId a, VertexId b) { return degree[a] > degree[b]; });
  Search search(points, triangles, threads);
  if (centers.empty()) {
    search.find_within(std::array{NamedTree{&tree, {}}});
  } else {
    search_stars(points, triangles, threads, centers, search);
  }
  return search.take_crossings();
}

std::size_t count_crossings(std::span<const Vec3> points, std::span<const Face> faces,
                            int threads) {
  std::vector<VertexId> merged = first_at_place(points);
  std::vector<Triangle> triangles;
  triangles.reserve(faces.size());
  for (const Face& face : faces) {
    const Triangle t{merged[face.v[0]], merged[face.v[1]], merged[face.v[2]]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles.push_back(t);
  }
  const std::vector<Vec3> places(points.begin(), points.end());
  const Crossings found =
      find_crossings(places, triangles, TriangleTree(places, triangles, threads), threads);
  return found.pairs.size() + found.given_up.size();
}

}  // namespace deliso
