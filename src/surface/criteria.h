// SPDX-License-Identifier: MIT
// When a facet is to be refined: the conditions of paper §3.1 (ApproximateGeom) and §3.2
// (RefineGeom), and bounds on distance and size, as pure functions of measured numbers. All lengths
// in the scaled frame. A criterion is a row of kCriterionTable; what users read of it is the
// program's (app/criterion_words.h).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "base/triangle.h"

namespace deliso {

inline constexpr double kNotAsked = std::numeric_limits<double>::infinity();

// What a facet sigma with surface point x = V_sigma cap Sigma measures.
struct FacetShape {
  double r;                 // circumradius
  double h;                 // distance from the circumcenter to x
  double l;                 // shortest edge
  double pole = kNotAsked;  // pole height h_sigma; infinite: not known
};

inline FacetShape measure(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x) {
  const Vec3 center = circumcenter(a, b, c);
  return {distance(center, a), distance(center, x), std::sqrt(shortest_edge2(a, b, c))};
}

enum class Criterion : std::uint8_t { distance, r_over_l, h_over_r, r_over_pole, radius, count_ };
inline constexpr std::size_t kCriteria = static_cast<std::size_t>(Criterion::count_);

// The floor of a criterion: a facet with a circumradius at or below it is not refined for the
// criterion. It is r_min, or for shape Criteria::shape_floor.
enum class Floor : std::uint8_t { r_min, shape };

struct CriterionRow {
  std::string_view name;  // of its option, less the hyphens, and in notes in files
  bool is_length;         // else a plain number
  double usual;           // the limit of the program's user who gives none; a length in voxels
  double least;           // with a smaller limit refinement would not end
  Floor floor;
  // What is measured as a share of its limit: the facet is bad when it is over 1.
  double (*share)(const FacetShape& s, double limit);
};

// In the order of Criterion.
inline constexpr std::array<CriterionRow, kCriteria> kCriterionTable{{
    {"max-distance", true, 0.1, 0, Floor::r_min,
     [](const FacetShape& s, double limit) { return s.h / limit; }},
    {"lambda", false, 2, 1, Floor::shape,
     [](const FacetShape& s, double limit) { return s.r / (s.l * limit); }},
    {"eps1", false, kNotAsked, 0, Floor::r_min,
     [](const FacetShape& s, double limit) { return s.h / (s.r * limit); }},
    {"eps2", false, kNotAsked, 0, Floor::r_min,
     [](const FacetShape& s, double limit) { return s.r / (s.pole * limit); }},
    {"max-radius", true, kNotAsked, 0, Floor::r_min,
     [](const FacetShape& s, double limit) { return s.r / limit; }},
}};

constexpr const CriterionRow& row_of(Criterion c) {
  return kCriterionTable[static_cast<std::size_t>(c)];
}

template <class T>
struct PerCriterion {
  std::array<T, kCriteria> values{};

  constexpr T& operator[](Criterion c) { return values[static_cast<std::size_t>(c)]; }
  constexpr const T& operator[](Criterion c) const { return values[static_cast<std::size_t>(c)]; }
  friend bool operator==(const PerCriterion&, const PerCriterion&) = default;
};

// Limits on what a facet measures. By default only r/l is limited; all others are kNotAsked.
struct Criteria {
  PerCriterion<double> limits = [] {
    PerCriterion<double> none;
    none.values.fill(kNotAsked);
    none[Criterion::r_over_l] = row_of(Criterion::r_over_l).usual;
    return none;
  }();
  double r_min = 0;        // nothing smaller is refined, but for shape
  double shape_floor = 0;  // nothing smaller is refined for shape

  double& operator[](Criterion c) { return limits[c]; }
  double operator[](Criterion c) const { return limits[c]; }
  bool asks(Criterion c) const { return limits[c] < kNotAsked; }
  friend bool operator==(const Criteria&, const Criteria&) = default;
};

// What the facet measures as a share of the limit of criterion n; 0 where it is too small to be
// asked.
inline double share_of_limit(std::size_t n, const FacetShape& s, const Criteria& k) {
  const CriterionRow& row = kCriterionTable[n];
  const bool is_small = s.r <= (row.floor == Floor::shape ? k.shape_floor : k.r_min);
  return is_small ? 0 : row.share(s, k.limits.values[n]);
}

// How far the worst criterion is passed: a facet is bad when it is over 1.
inline double violation(const FacetShape& s, const Criteria& k) {
  double worst = 0;
  const auto consider = [&](double share) { worst = worst < share ? share : worst; };
  // Unrolled: this is the innermost question of Stage 2.
  [&]<std::size_t... n>(std::index_sequence<n...>) {
    (consider(share_of_limit(n, s, k)), ...);
  }
  (std::make_index_sequence<kCriteria>());
  return worst;
}

// Which one that is.
inline Criterion worst_criterion(const FacetShape& s, const Criteria& k) {
  std::size_t worst = 0;
  for (std::size_t n = 1; n < kCriteria; ++n) {
    if (share_of_limit(worst, s, k) < share_of_limit(n, s, k)) worst = n;
  }
  return static_cast<Criterion>(worst);
}

}  // namespace deliso
