// SPDX-License-Identifier: MIT
#include "lesson/small_surfaces.h"

namespace deliso::lesson {

std::vector<SmallSurface> small_surfaces() {
  return {
      {"C1: a disk",
       "P(a) is an annulus",
       "one facet",
       {{{1.3, 1.15, 2}, {2.7, 1.15, 2}, {2, 2.25, 2}, {2, 3.6, 0}, {0, 0, 0}, {4, 0, 0}},
        "aaaabc",
        {{0, 2, 3}, {2, 1, 3}, {1, 0, 4}, {0, 3, 4}, {3, 1, 5}, {1, 4, 5}}},
       {{{2, 3.2, 0}, {0.4, 0.4, 0}, {3.6, 0.4, 0}}, "abc", {{0, 1, 2}}},
       {},
       "a- ab ac"},
      {"C2: one arc",
       "P(a), P(b) meet in two arcs",
       "three facets at the edge ab",
       {{{0, 0, 0}, {4, 0, 0}, {2, 3.6, 0}, {1.8, 2.3, 0.8}, {1.55, 0.6, 0.8}, {2.35, 1.25, 1}},
        "abcade",
        {{0, 2, 3}, {2, 1, 3}, {1, 0, 4}, {0, 3, 4}, {3, 1, 5}, {1, 4, 5}, {4, 3, 5}}},
       {{{0, 1.9, 0}, {4, 1.9, 0}, {2, 3.6, 0}, {2, 0, 0}, {2, 1.1, 1.4}},
        "abcde",
        {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 3, 4}, {0, 3, 4}}},
       {{0, 1}},
       "ab"},
      {"C3: one triangle",
       "abc: the lowest one, and the outside",
       "the same facet twice",
       {{{2, 3.4, 0}, {2, 1.5, 2.4}, {0.4, 0.4, 0}, {3.6, 0.4, 0}},
        "aabc",
        {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}},
        true},
       {{{2, 3.2, 0}, {0.4, 0.4, 0}, {3.6, 0.4, 0}}, "abc", {{0, 1, 2}}},
       {{0, 1}, {1, 2}, {2, 0}},
       "ab bc ac"},
      {"C4: one arc of the boundary",
       "P(b) meets it in two",
       "two facets with a vertex in common",
       {{{0, 1.5, 0}, {1.2, 3, 0.5}, {1.2, 0, 0.5}, {2.8, 0, 0.5}, {2.8, 3, 0.5}, {4, 1.5, 0}},
        "abcbde",
        {{0, 2, 1}, {1, 2, 3}, {1, 3, 4}, {4, 3, 5}}},
       {{{0, 3, 0.6}, {2, 1.6, 0}, {0, 0.2, 0.6}, {4, 3, 0.6}, {4, 0.2, 0.6}},
        "abcde",
        {{0, 2, 1}, {3, 1, 4}}},
       {{1, 1}},
       "b-"},
  };
}

}  // namespace deliso::lesson
