// SPDX-License-Identifier: MIT
#include "more/solids/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/predicates.h"

namespace deliso {

// With volume V, areas A of two facets and the length l of their edge: sin = 3 V l / (2 A A').
double shape(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  if (orient3d(a, b, c, d) <= 0) return -1;
  const Vec3 ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b, cd = d - c;
  const double volume = dot(cross(ab, ac), ad);  // six times
  // Twice the areas, squared, of the facets opposite to a, b, c and d.
  const double of_a = length2(cross(bc, bd)), of_b = length2(cross(ac, ad));
  const double of_c = length2(cross(ab, ad)), of_d = length2(cross(ab, ac));
  const double largest_quotient =
      std::max({of_c * of_d / length2(ab), of_b * of_d / length2(ac), of_b * of_c / length2(ad),
                of_a * of_d / length2(bc), of_a * of_c / length2(bd), of_a * of_b / length2(cd)});
  return largest_quotient > 0 ? std::max(0., volume / std::sqrt(largest_quotient)) : 0;
}

}  // namespace deliso
