// SPDX-License-Identifier: MIT
// classify_star against its definition, written out: the link edges equal those of some cyclic or
// open sequence of distinct vertices.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "mesh/meshes.h"
#include "mesh/star.h"

using namespace deliso;
using namespace deliso::test;

namespace {

constexpr VertexId kHub = 100;

// The links over the vertices 0 .. n-1 that are a simple cycle or path, by enumerating all
// sequences of distinct vertices. A link is a set of edges, as bits.
struct Links {
  explicit Links(int n) : vertices(n), star(std::size_t{1} << edge_count(), Star::singular) {
    star[0] = Star::empty;
    std::vector<int> sequence;
    extend(sequence);
  }
  int edge_count() const { return vertices * (vertices - 1) / 2; }
  int edge(int a, int b) const {
    if (a > b) std::swap(a, b);
    return b * (b - 1) / 2 + a;
  }
  void extend(std::vector<int>& sequence) {
    std::size_t path = 0;
    for (std::size_t i = 1; i < sequence.size(); ++i) {
      path |= std::size_t{1} << edge(sequence[i - 1], sequence[i]);
    }
    if (sequence.size() >= 2) star[path] = Star::half_disk;
    if (sequence.size() >= 3) {
      star[path | std::size_t{1} << edge(sequence.back(), sequence.front())] = Star::disk;
    }
    for (int v = 0; v < vertices; ++v) {
      if (std::find(sequence.begin(), sequence.end(), v) != sequence.end()) continue;
      sequence.push_back(v);
      extend(sequence);
      sequence.pop_back();
    }
  }
  int vertices;
  std::vector<Star> star;
};

void shuffle(Triangles& triangles, Random& random) {
  for (std::size_t i = triangles.size(); i > 1; --i) {
    std::swap(triangles[i - 1], triangles[random.below(static_cast<std::uint32_t>(i))]);
  }
  for (Triangle& t : triangles) {
    std::rotate(t.begin(), t.begin() + random.below(3), t.end());
    if (random.below(2)) std::swap(t[0], t[1]);
  }
}

// `n` distinct labels in random order.
std::vector<VertexId> labels(std::size_t n, Random& random) {
  std::set<VertexId> drawn;
  std::vector<VertexId> all;
  while (all.size() < n) {
    const VertexId v = VertexId(random.next());
    if (v != kHub && drawn.insert(v).second) all.push_back(v);
  }
  return all;
}

Triangles path(const std::vector<VertexId>& v) {
  Triangles triangles;
  for (std::size_t i = 1; i < v.size(); ++i) triangles.push_back({kHub, v[i - 1], v[i]});
  return triangles;
}

Triangles cycle(const std::vector<VertexId>& v) {
  Triangles triangles = path(v);
  triangles.push_back({kHub, v.back(), v.front()});
  return triangles;
}

}  // namespace

TEST_CASE("every set of link edges over up to seven vertices is classified by the definition") {
  for (int n = 2; n <= 7; ++n) {
    const Links links(n);
    std::size_t wrong = 0, counts[4] = {};
    Random random(static_cast<std::uint64_t>(n));
    for (std::size_t mask = 0; mask < links.star.size(); ++mask) {
      Triangles triangles;
      for (int b = 1; b < n; ++b) {
        for (int a = 0; a < b; ++a) {
          if (mask >> links.edge(a, b) & 1) {
            triangles.push_back({VertexId(a), VertexId(b), kHub});
          }
        }
      }
      if (n <= 6) shuffle(triangles, random);
      const Star star = classify_star(kHub, triangles);
      wrong += star != links.star[mask];
      ++counts[static_cast<int>(star)];
    }
    CHECK_MESSAGE(wrong == 0, "link vertices: ", n);
    CHECK(counts[static_cast<int>(Star::empty)] == 1);
    CHECK((counts[static_cast<int>(Star::disk)] > 0) == (n >= 3));
    CHECK(counts[static_cast<int>(Star::half_disk)] > 0);
  }
}

TEST_CASE("a triangle listed twice, or with a corner twice, is in no disk") {
  CHECK(classify_star(kHub, Triangles{{kHub, 1, 2}, {kHub, 1, 2}}) == Star::singular);
  CHECK(classify_star(kHub, Triangles{{kHub, 1, 2}, {2, 1, kHub}}) == Star::singular);
  CHECK(classify_star(kHub, Triangles{{kHub, kHub, 1}}) == Star::singular);
  CHECK(classify_star(kHub, Triangles{{kHub, 1, 1}}) == Star::singular);
  CHECK(classify_star(kHub, Triangles{{kHub, kHub, kHub}}) == Star::singular);
}

TEST_CASE("long links, whole and broken in each way, are classified correctly") {
  for (std::uint64_t seed = 1; seed <= 4000; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    // Both sides of the limit of 64 triangles, up to which nothing is allocated.
    const std::size_t n = 4 + random.below(140);
    const std::vector<VertexId> v = labels(n + 3, random);
    const std::vector<VertexId> ring(v.begin(), v.end() - 3);
    const bool closed = random.below(2);
    const Triangles whole = closed ? cycle(ring) : path(ring);
    const auto classify = [&](Triangles triangles) {
      shuffle(triangles, random);
      return classify_star(kHub, triangles);
    };
    const std::size_t at = random.below(static_cast<std::uint32_t>(whole.size()));
    const auto with = [&](const Triangle& t) {
      Triangles more = whole;
      more.push_back(t);
      return more;
    };

    REQUIRE(classify(whole) == (closed ? Star::disk : Star::half_disk));
    Triangles less = whole;
    less.erase(less.begin() + static_cast<std::ptrdiff_t>(at));
    const bool still_one = closed || at == 0 || at + 1 == whole.size();
    REQUIRE(classify(less) == (still_one ? Star::half_disk : Star::singular));
    REQUIRE(classify(with(whole[at])) == Star::singular);                 // an edge twice
    REQUIRE(classify(with({kHub, ring[1], ring[3]})) == Star::singular);  // a chord
    REQUIRE(classify(with({kHub, ring[1], v[n]})) == Star::singular);     // a branch
    REQUIRE(classify(with({kHub, v[n], v[n + 1]})) == Star::singular);    // a second piece
    REQUIRE(classify(with({kHub, kHub, ring[0]})) == Star::singular);     // degenerate
    REQUIRE(classify(with({kHub, ring[2], ring[2]})) == Star::singular);  // degenerate
    if (!closed) REQUIRE(classify(with({kHub, v[n], ring[0]})) == Star::half_disk);
    Triangles two = whole;
    for (const Triangle& t : cycle({v[n], v[n + 1], v[n + 2]})) two.push_back(t);
    REQUIRE(classify(two) == Star::singular);
    // Two of the ring's vertices are merged: a figure of eight.
    Triangles pinched = whole;
    for (Triangle& t : pinched) std::replace(t.begin(), t.end(), ring[n - 1], ring[1]);
    REQUIRE(classify(pinched) == Star::singular);
  }
}
