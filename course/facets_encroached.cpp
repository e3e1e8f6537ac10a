// SPDX-License-Identifier: MIT
// Exercise 12, an hour: which facets does a new point replace?
//
// Stage 2 has no tetrahedra. To insert a point p of the surface it takes away E, the facets whose
// surface balls hold p, and puts the cone from p over E's boundary in their place (§2.2.2, Figure
// 3). E is found by walking: it has `start`, and each facet beside one of E whose ball holds p. A
// facet further away whose ball holds p, too, is not in E if no such walk leads to it.
//
// Set `facets` to E, `start` first, each facet once. `start` is in E whatever its ball. A ball is
// s.duals[f].holds(p). The three facets beside f are s.mesh.faces[f].n; kNoId stands for none.
//
// Hint: a list that grows while you go through it needs no recursion.
void facets_encroached(const SurfaceMesh& s, FaceId start, const Vec3& p,
                       std::vector<FaceId>& facets) {
  throw std::logic_error("exercise 12: your work");
}
