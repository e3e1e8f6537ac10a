// SPDX-License-Identifier: MIT
// The certificate on all labels of all small spheres and disks, against its definition and against
// the theorem: where it holds, the dual has the topology of T.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "recover/labeled.h"

using namespace deliso;
using namespace deliso::test;

namespace {

// Each region with a site, on the boundary if it has a vertex there.
std::string with_sites(std::string letters, const ContourTriangles& triangles) {
  const std::map<ContourId, ContourId> boundary = boundary_of(triangles);
  for (char name = 'a'; name <= 'z'; ++name) {
    std::size_t site = letters.find(name);
    if (site == std::string::npos) continue;
    for (std::size_t v = site; v < letters.size(); ++v) {
      const bool is_better = boundary.contains(ContourId(v)) && !boundary.contains(ContourId(site));
      if (letters[v] == name && is_better) site = v;
    }
    letters[site] = static_cast<char>(std::toupper(name));
  }
  return letters;
}

// What breaks C1 to C4 at a site, counted as recover/certificate.h says it, over all of T; but not
// that the site is on the boundary.
std::set<paper::Reason> conditions_broken(const std::string& letters,
                                          const ContourTriangles& triangles, char site) {
  const char a = static_cast<char>(std::tolower(site));
  using Names = std::set<char>;
  std::set<std::set<ContourId>> edges;
  std::map<Names, int> edges_of, rim_of, triangles_of;  // by the labels of their corners
  const auto names = [&](const auto& corners) {
    Names all;
    for (const ContourId v : corners) all.insert(letters[v]);
    return all;
  };
  for (const ContourTriangle& t : triangles) {
    ++triangles_of[names(t)];
    for (std::size_t i = 0; i < 3; ++i) edges.insert({t[i], t[(i + 1) % 3]});
  }
  std::set<ContourId> on_rim;
  for (const auto& [v, w] : boundary_of(triangles)) {
    ++rim_of[names(std::array{v, w})];
    if (letters[v] == a) on_rim.insert(v);
  }
  std::vector<ContourId> root(letters.size());
  for (ContourId v = 0; v < root.size(); ++v) root[v] = v;
  for (const auto& e : edges) {
    ++edges_of[names(e)];
    if (names(e).size() > 1) continue;
    std::ranges::replace(root, ContourId(root[*e.begin()]), ContourId(root[*e.rbegin()]));
  }
  std::set<ContourId> pieces;
  for (ContourId v = 0; v < root.size(); ++v) {
    if (letters[v] == a) pieces.insert(root[v]);
  }
  std::set<paper::Reason> broken;
  const auto vertices = std::ranges::count(letters, a);
  if (pieces.size() != 1 || vertices - edges_of[{a}] + triangles_of[{a}] != 1) {
    broken.insert(paper::Reason::region);
  }
  const auto boundary_vertices = static_cast<int>(on_rim.size());
  if (boundary_vertices > 0 && boundary_vertices - rim_of[{a}] != 1) {
    broken.insert(paper::Reason::boundary);
  }
  for (const auto& [both, count] : edges_of) {
    if (both.size() != 2 || !both.contains(a)) continue;
    if (count - triangles_of[both] != 1) broken.insert(paper::Reason::interface);
    if (rim_of[both] > 1) broken.insert(paper::Reason::boundary);
  }
  for (const auto& [all, count] : triangles_of) {
    if (all.size() == 3 && all.contains(a) && count > 1) broken.insert(paper::Reason::triple);
  }
  return broken;
}

// All spheres of n vertices: what flips make of one, as sorted triangles that begin with their
// smallest vertex.
std::set<ContourTriangles> spheres(ContourId n) {
  const auto sorted = [](ContourTriangles triangles) {
    for (ContourTriangle& t : triangles)
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(triangles.begin(), triangles.end());
    return triangles;
  };
  ContourTriangles first{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  for (ContourId v = 4; v < n; ++v) {
    const auto [a, b, c] = first.back();
    first.pop_back();
    first.insert(first.end(), {{a, b, v}, {b, c, v}, {c, a, v}});
  }
  std::vector<ContourTriangles> queue{sorted(first)};
  std::set<ContourTriangles> found(queue.begin(), queue.end());
  while (!queue.empty()) {
    const ContourTriangles from = queue.back();
    queue.pop_back();
    std::map<std::pair<ContourId, ContourId>, ContourId> across;
    for (const ContourTriangle& t : from) {
      for (std::size_t i = 0; i < 3; ++i) across[{t[i], t[(i + 1) % 3]}] = t[(i + 2) % 3];
    }
    for (const auto& [edge, c] : across) {
      const auto [a, b] = edge;
      const ContourId d = across.at({b, a});
      if (a > b || across.contains({c, d})) continue;
      ContourTriangles to{{a, d, c}, {d, b, c}};
      for (const ContourTriangle& t : from) {
        if (!has_corner(t, a) || !has_corner(t, b)) to.push_back(t);
      }
      to = sorted(to);
      if (found.insert(to).second) queue.push_back(to);
    }
  }
  return found;
}

// Labels of n vertices: a, ..., a, b, ..., b, c, ... for all ascending numbers of each. Up to the
// order of the vertices there are no others.
void add_labels(std::size_t n, std::size_t least, const std::string& begun,
                std::vector<std::string>& all) {
  if (n == 0) all.push_back(begun);
  const char letter = static_cast<char>(begun.empty() ? 'a' : begun.back() + 1);
  for (std::size_t m = least; m <= n; ++m)
    add_labels(n - m, m, begun + std::string(m, letter), all);
}

}  // namespace

// Theorem 2 of docs/proof.md, and that its pictures are the smallest: there is no annulus of fewer
// than six vertices.
TEST_CASE("all labels of all small spheres and disks: where the certificate holds K is like T") {
  std::map<paper::Reason, std::size_t> smallest;  // that break this alone, with all sites in facets
  std::map<paper::Reason, int> told;
  int certified = 0;
  const auto look_at = [&](const std::string& labels, const ContourTriangles& triangles) {
    const Shape shape = shape_of(with_sites(labels, triangles), triangles);
    CAPTURE(shape.letters);
    Labeled t(shape);
    std::set<paper::Reason> broken;
    for (char site = 'A'; site <= std::toupper(labels.back()); ++site) {
      const std::set<paper::Reason> here = conditions_broken(labels, triangles, site);
      const auto violation = t.check(site).violation;
      const bool is_right = violation ? here.contains(*violation) : here.empty();
      if (!is_right) FAIL_CHECK("another condition is broken at " << site);
      if (violation) ++told[*violation];
      broken.insert(here.begin(), here.end());
    }
    const std::string fault = t.fault_of_dual();
    if (broken.empty() && !fault.empty()) FAIL_CHECK(fault);
    certified += broken.empty();
    if (broken.size() != 1 || fault.empty() || !t.has_facets_at_all_sites()) return;
    const std::size_t before = smallest.insert({*broken.begin(), labels.size()}).first->second;
    smallest[*broken.begin()] = std::min(before, labels.size());
  };
  for (ContourId n = 4; n <= 7; ++n) {
    std::vector<std::string> of_sphere, of_disk;
    add_labels(n, 1, "", of_sphere);
    add_labels(n - 1, 1, "", of_disk);
    for (const ContourTriangles& sphere : spheres(n)) {
      ContourTriangles disk = sphere;
      std::erase_if(disk,
                    [&](const ContourTriangle& t) { return has_corner(t, ContourId(n - 1)); });
      for (const std::string& labels : of_disk) look_at(labels, disk);
      if (n == 7) continue;
      for (const std::string& labels : of_sphere) look_at(labels, sphere);
    }
  }
  CHECK(certified > 30000);
  for (const paper::Reason r : {paper::Reason::region, paper::Reason::interface,
                                paper::Reason::triple, paper::Reason::boundary}) {
    CHECK(told[r] > 100);
  }
  CHECK(smallest == std::map<paper::Reason, std::size_t>{{paper::Reason::interface, 6},
                                                         {paper::Reason::triple, 4},
                                                         {paper::Reason::boundary, 6}});
}
