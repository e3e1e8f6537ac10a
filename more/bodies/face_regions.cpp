// SPDX-License-Identifier: MIT
#include "more/bodies/face_regions.h"

#include <cstddef>

namespace deliso {

FaceRegions::FaceRegions(const std::array<BodyId, 4>& bodies, int diagonal,
                         const FacePlaces& places)
    : bodies_(bodies), at_(places) {
  std::vector<int> changes;  // the edges between two bodies
  for (int n = 0; n < 4; ++n) {
    if (body(n) != body(n + 1)) changes.push_back(n);
  }
  if (changes.empty()) {
    add_polygon({corner(0), corner(1), corner(2), corner(3)}, 0);
  } else if (changes.size() == 2) {
    // The corners after one edge, up to the other, are to the right of the arc.
    const int first = changes[0], second = changes[1];
    add_arc(edge(first), edge(second), first, second);
    std::vector<int> right, left;
    for (int n = first + 1; n <= second; ++n) right.push_back(corner(n));
    for (int n = second + 1; n <= first + 4; ++n) left.push_back(corner(n));
    right.insert(right.end(), {edge(second), edge(first)});
    left.insert(left.end(), {edge(first), edge(second)});
    add_polygon(right, second);
    add_polygon(left, first);
  } else if (changes.size() == 3) {
    add_star();
  } else if (body(diagonal) == body(diagonal + 2)) {
    diagonal_ = diagonal;
    const int d = diagonal;
    add_polygon({corner(d), edge(d), edge(d + 1), corner(d + 2), edge(d + 2), edge(d + 3)}, d);
    for (const int n : {d + 1, d + 3}) {
      add_arc(edge(n + 3), edge(n), d, n);
      add(corner(n), edge(n), edge(n + 3), n);
    }
  } else {
    diagonal_ = diagonal;
    add_contact(diagonal);
  }
}

void FaceRegions::add_polygon(const std::vector<int>& p, int of) {
  if (p.size() < 5) {
    for (std::size_t n = 2; n < p.size(); ++n) add(p[0], p[n - 1], p[n], of);
    return;
  }
  around_middle_ = p;
  for (std::size_t n = 0; n < p.size(); ++n) add(at_.middle, p[n], p[(n + 1) % p.size()], of);
}

// One point where three bodies meet.
void FaceRegions::add_star() {
  meetings_ = 1;
  const int point = at_.meeting[0];
  for (int n = 0; n < 4; ++n) {
    if (body(n) == body(n + 1)) {
      add(point, corner(n), corner(n + 1), n);
      continue;
    }
    add_arc(point, edge(n), n + 1, n);
    add(point, corner(n), edge(n), n);
    add(point, edge(n), corner(n + 1), n + 1);
  }
}

// The corners d and d + 2 meet along an arc between two points where three bodies meet.
void FaceRegions::add_contact(int d) {
  meetings_ = 2;
  for (const int n : {d, d + 2}) {
    const int own = at_.meeting[n == d ? 0 : 1], other = at_.meeting[n == d ? 1 : 0];
    add_arc(own, edge(n), n + 1, n);
    add_arc(own, edge(n + 1), n + 2, n + 1);
    add(corner(n), edge(n), own, n);
    add(corner(n), own, other, n);
    add(corner(n), other, edge(n + 3), n);
    add(corner(n + 1), edge(n + 1), own, n + 1);
    add(corner(n + 1), own, edge(n), n + 1);
  }
  add_arc(at_.meeting[0], at_.meeting[1], d, d + 2);
}

}  // namespace deliso
