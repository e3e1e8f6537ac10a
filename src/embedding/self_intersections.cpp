// SPDX-License-Identifier: MIT
#include "embedding/self_intersections.h"

#include <algorithm>
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

constexpr std::size_t kLeavesAtOnce = 256;

class Search {
 public:
  Search(const std::vector<Vec3>& points, std::span<const Triangle> triangles, int threads,
         bool bounded)
      : points_(points),
        triangles_(triangles),
        threads_(threads),
        bounded_(bounded),
        flat_(triangles.size()) {
    for_each_run(threads, triangles.size(), 1u << 14, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        const Triangle& t = triangles[f];
        flat_[f] = collinear(points[t[0]], points[t[1]], points[t[2]]);
      }
    });
  }

  // Pairs within a tree of the triangles `name`, or of all where that is empty.
  void within(const TriangleTree& tree, std::span<const FaceId> name = {}) {
    run(tree.leaf_count(), [&](std::size_t leaf, Work& work) {
      const std::span<const FaceId> mine = tree.leaf(leaf);
      const std::span<const Box3> my_boxes = tree.boxes_of_leaf(leaf);
      Box3 box = my_boxes[0];
      for (const Box3& other : my_boxes) box = united(box, other);
      work.boxes += tree.for_each_leaf_near(box, 0, leaf, [&](std::size_t other, const Box3&) {
        const std::span<const FaceId> theirs = tree.leaf(other);
        const std::span<const Box3> their_boxes = tree.boxes_of_leaf(other);
        for (std::size_t m = 0; m < mine.size(); ++m) {
          for (std::size_t n = other == leaf ? m + 1 : 0; n < theirs.size(); ++n) {
            if (!TriangleTree::meet(my_boxes[m], their_boxes[n])) continue;
            test(named(name, mine[m]), named(name, theirs[n]), work);
          }
        }
        return !exhausted(work);
      });
      if (!exhausted(work)) return;
      for (const FaceId f : mine) work.given_up.push_back(named(name, f));
    });
  }

  // Pairs of one of `triangles` and one of the tree, which are the triangles `name`; but for those
  // that share a vertex with many.
  void between(std::span<const FaceId> triangles, const TriangleTree& tree,
               std::span<const FaceId> name, const std::vector<std::uint32_t>& star) {
    const auto shares_star = [&](const Triangle& s, const Triangle& t) {
      return std::any_of(s.begin(), s.end(),
                         [&](VertexId v) { return star[v] != kNoId && has_corner(t, v); });
    };
    run(triangles.size(), [&](std::size_t n, Work& work) {
      const FaceId f = triangles[n];
      const Triangle& t = triangles_[f];
      const Box3 box = box_of(points_[t[0]], points_[t[1]], points_[t[2]]);
      work.boxes += tree.for_each_leaf_near(box, 0, 0, [&](std::size_t leaf, const Box3&) {
        for (std::size_t k = 0; k < tree.leaf(leaf).size(); ++k) {
          const FaceId g = name[tree.leaf(leaf)[k]];
          if (!TriangleTree::meet(box, tree.boxes_of_leaf(leaf)[k])) continue;
          if (!shares_star(t, triangles_[g])) test(f, g, work);
        }
        return !exhausted(work);
      });
      if (exhausted(work)) work.given_up.push_back(f);
    });
  }

  // Pairs of triangles around a vertex that meet beyond it: their arcs do. An arc lies in the
  // triangle of its ends and of the point where the tangents there meet.
  void around(VertexId center, std::span<const FaceId> triangles) {
    constexpr double kRounding = 1e-14;  // more than that of the directions
    const auto direction = [&](VertexId to) {
      const Vec3 d = points_[to] - points_[center];
      return d / length(d);
    };
    std::vector<Vec3> directions;
    std::vector<Triangle> arcs;
    std::vector<FaceId> name;
    for (const FaceId f : triangles) {
      if (flat_[f]) continue;
      const Triangle& t = triangles_[f];
      const int i = t[0] == center ? 0 : t[1] == center ? 1 : 2;
      const Vec3 b = direction(t[(i + 1) % 3]), c = direction(t[(i + 2) % 3]);
      const auto first = static_cast<VertexId>(directions.size());
      directions.insert(directions.end(), {b, c, (b + c) / std::max(1 + dot(b, c), kRounding)});
      arcs.push_back({first, first + 1, first + 2});
      name.push_back(f);
    }
    within(TriangleTree(directions, arcs, threads_, kRounding), name);
  }

  Crossings take() {
    sort_out(found_.pairs);
    sort_out(found_.given_up);
    return std::move(found_);
  }

 private:
  // What a leaf may take.
  struct Most {
    std::size_t boxes = kMostBoxes, tests = kMostTests, found = kMostFound;
  };
  struct Work {
    std::size_t boxes = 0, tests = 0, found = 0;
    std::vector<std::pair<FaceId, FaceId>> pairs;
    std::vector<FaceId> given_up;
    std::vector<std::size_t> exhausted;
  };

  bool exhausted(const Work& work) const {
    return bounded_ &&
           (work.boxes > most_.boxes || work.tests > most_.tests || work.found > most_.found);
  }

  static FaceId named(std::span<const FaceId> name, FaceId f) { return name.empty() ? f : name[f]; }

  void test(FaceId f, FaceId g, Work& work) const {
    ++work.tests;
    if (flat_[f] || flat_[g] || !triangles_intersect(points_, triangles_[f], triangles_[g])) return;
    ++work.found;
    work.pairs.emplace_back(std::min(f, g), std::max(f, g));
  }

  // Calls look(n, work) for every n below `size`, each with its own share of the work, and once
  // more for those that were exhausted where they may have more.
  template <class Look>
  void run(std::size_t size, const Look& look) {
    std::vector<std::size_t> all(size);
    std::iota(all.begin(), all.end(), 0);
    most_ = {};
    std::vector<Work> works = works_of(all, look);
    std::vector<std::size_t> more;
    for (const Work& work : works) {
      more.insert(more.end(), work.exhausted.begin(), work.exhausted.end());
    }
    if (!more.empty()) {
      most_ = {std::max(kMostBoxes, kBoxesShared / more.size()),
               std::max(kMostTests, kTestsShared / more.size()),
               std::max(kMostFound, kFoundShared / more.size())};
      if (most_.boxes > kMostBoxes || most_.tests > kMostTests || most_.found > kMostFound) {
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
    std::vector<Work> works(runs_of(numbers.size(), kLeavesAtOnce));
    for_each_run(threads_, numbers.size(), kLeavesAtOnce,
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
  bool bounded_;
  Most most_;
  std::vector<std::uint8_t> flat_;
  Crossings found_;
};

// A vertex with many triangles, and of these those that no star before it has.
struct Star {
  VertexId at;
  std::vector<FaceId> around, own;
};

// The same where some vertices have many triangles: `star` numbers these, per vertex.
void search_stars(const std::vector<Vec3>& points, std::span<const Triangle> triangles, int threads,
                  std::vector<Star> stars, const std::vector<std::uint32_t>& star, Search& search) {
  std::vector<FaceId> rest;
  for (FaceId f = 0; f < triangles.size(); ++f) {
    std::uint32_t first = kNoId;
    for (const VertexId v : triangles[f]) {
      if (star[v] == kNoId) continue;
      stars[star[v]].around.push_back(f);
      first = std::min(first, star[v]);
    }
    (first == kNoId ? rest : stars[first].own).push_back(f);
  }
  const auto take = [&](std::span<const FaceId> ids) {
    std::vector<Triangle> taken;
    for (const FaceId f : ids) taken.push_back(triangles[f]);
    return taken;
  };
  const std::vector<Triangle> triangles_of_rest = take(rest);
  const TriangleTree tree_of_rest(points, triangles_of_rest, threads);
  search.within(tree_of_rest, rest);
  for (std::size_t n = 0; n < stars.size(); ++n) {
    const std::vector<FaceId>& own = stars[n].own;
    search.around(stars[n].at, stars[n].around);
    search.between(own, tree_of_rest, rest, star);
    if (own.empty() || n + 1 == stars.size()) continue;
    const std::vector<Triangle> triangles_of_star = take(own);
    const TriangleTree tree(points, triangles_of_star, threads);
    for (std::size_t m = n + 1; m < stars.size(); ++m) {
      search.between(stars[m].own, tree, own, star);
    }
  }
}

Crossings find(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
               const TriangleTree& tree, int threads, bool bounded) {
  std::vector<std::uint32_t> degree(points.size(), 0), star(points.size(), kNoId);
  for (const Triangle& t : triangles) {
    for (const VertexId v : t) ++degree[v];
  }
  std::vector<Star> stars;
  for (VertexId v = 0; v < points.size(); ++v) {
    if (degree[v] <= kManyAround) continue;
    star[v] = static_cast<std::uint32_t>(stars.size());
    stars.push_back({v, {}, {}});
  }
  Search search(points, triangles, threads, bounded);
  if (stars.empty()) {
    search.within(tree);
  } else {
    search_stars(points, triangles, threads, std::move(stars), star, search);
  }
  return search.take();
}

}  // namespace

Crossings find_crossings(const std::vector<Vec3>& points, std::span<const Triangle> triangles,
                         const TriangleTree& tree, int threads) {
  return find(points, triangles, tree, threads, true);
}

std::vector<std::pair<FaceId, FaceId>> self_intersections(const std::vector<Vec3>& points,
                                                          std::span<const Triangle> triangles,
                                                          const TriangleTree& tree) {
  return find(points, triangles, tree, 1, false).pairs;
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
