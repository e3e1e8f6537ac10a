// SPDX-License-Identifier: MIT
// The criteria that a facet must meet: h/r and r/l of paper §3.2 (RefineGeom), and bounds on
// distance and size. They are pure functions of measured numbers. Lengths are in the scaled frame.
// A criterion is a row of kCriterionTable; app/criterion_words.h describes it to users.
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

enum class Criterion : std::uint8_t { distance, r_over_l, h_over_r, radius, count_ };
inline constexpr std::size_t kCriteria = static_cast<std::size_t>(Criterion::count_);

// The floor of a criterion: facets with a circumradius at or below it are not refined for the
// criterion. It is Criteria::r_min or Criteria::shape_floor.
enum class Floor : std::uint8_t { r_min, shape };

struct CriterionRow {
  std::string_view name;  // of its option, without the hyphens, and in notes in files
  bool is_length;         // otherwise a ratio
  double usual;           // default limit; lengths in voxels
  double least;           // with a smaller limit refinement would not end
  Floor floor;
  // Returns the measure over its limit; the facet is bad above 1.
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

// The limits of a facet's measures. At first only r/l has a limit; the others are kNotAsked.
// run/options.h has the limits that a run has by default.
struct Criteria {
  PerCriterion<double> limits = [] {
    PerCriterion<double> none;
    none.values.fill(kNotAsked);
    none[Criterion::r_over_l] = row_of(Criterion::r_over_l).usual;
    return none;
  }();
  double r_min = 0;          // up to it a facet can violate criteria of shape only
  double shape_floor = 0;    // smaller ones are not refined for shape either
  double free_vertices = 0;  // how far vertices may be off Sigma

  double& operator[](Criterion c) { return limits[c]; }
  double operator[](Criterion c) const { return limits[c]; }
  bool asks(Criterion c) const { return limits[c] < kNotAsked; }
  friend bool operator==(const Criteria&, const Criteria&) = default;
};

// Returns the facet's measure over the limit of criterion n; 0 at or below the criterion's floor.
inline double share_of_limit(std::size_t n, const FacetShape& s, const Criteria& k) {
  const CriterionRow& row = kCriterionTable[n];
  const bool is_small = s.r <= (row.floor == Floor::shape ? k.shape_floor : k.r_min);
  return is_small ? 0 : row.share(s, k.limits.values[n]);
}

// Returns how far the facet violates its worst criterion: the largest of its measures over their
// limits. It is bad above 1.
inline double violation(const FacetShape& s, const Criteria& k) {
  double worst = 0;
  const auto consider = [&](double share) { worst = worst < share ? share : worst; };
  // Unrolled: Stage 2 calls this for every facet that it considers.
  [&]<std::size_t... n>(std::index_sequence<n...>) {
    (consider(share_of_limit(n, s, k)), ...);
  }
  (std::make_index_sequence<kCriteria>());
  return worst;
}

// Returns the criterion that gives violation(); of equal ones the first.
inline Criterion worst_criterion(const FacetShape& s, const Criteria& k) {
  std::size_t worst = 0;
  for (std::size_t n = 1; n < kCriteria; ++n) {
    if (share_of_limit(worst, s, k) < share_of_limit(n, s, k)) worst = n;
  }
  return static_cast<Criterion>(worst);
}

}  // namespace deliso
