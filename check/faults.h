// SPDX-License-Identifier: MIT
// The faults that a check finds, by kind: their number, and the first few with ids and places.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/enum_table.h"
#include "base/vec3.h"

namespace deliso {

enum class FaultKind : std::uint8_t {
  vertices_not_finite,    // coordinates
  duplicate_vertices,     // at one position; all other tests count them as one
  unused_vertices,        // in no triangle
  degenerate_triangles,   // a corner twice, or all three on one line
  duplicate_triangles,    // on the same three vertices
  non_manifold_edges,     // of more than two triangles
  orientation,            // two triangles run the same way along their edge
  non_manifold_vertices,  // the triangles there are neither a disk nor a half disk
  holes,                  // edges of one triangle that do not lie on the box; of a solid: any
  self_intersections,     // pairs of triangles that meet outside their common vertex or edge
  needle_triangles,       // with an angle below kLeastAngle
  folds,                  // pairs of triangles at an edge, folded on each other
  near_vertices,          // nearer than kNearShare of the box to a triangle of others
  vertices_off_surface,   // not on Sigma within the tolerance
  stray_vertices,         // on another component of Sigma than their triangles stand for
  triangles_off_surface,  // a point of them is further off than a voxel and than was asked for
  missing_components,     // of the exact contour
  extra_components,       // of the mesh, more than one for each of the contour's
  different_components,   // another Euler number or number of boundary loops
  turned_components,      // with the normals to the side where g >= kappa
  turned_caps,            // triangles of a solid on the box that face into it
  no_volume,              // a solid that encloses nothing, or is reversed
  restricted_share,       // too few triangles are restricted Delaunay facets
  over_limits,            // more triangles than allowed are over a limit
  too_far,                // a distance over the given bound
  not_measured,           // omitted, since it would cost more than n log n
  count_
};
inline constexpr std::size_t kFaultKinds = static_cast<std::size_t>(FaultKind::count_);
inline constexpr std::array<EnumRow<FaultKind, std::string_view>, kFaultKinds> kFaultTable{{
    {FaultKind::vertices_not_finite, "vertices not finite"},
    {FaultKind::duplicate_vertices, "duplicate vertices"},
    {FaultKind::unused_vertices, "unused vertices"},
    {FaultKind::degenerate_triangles, "degenerate triangles"},
    {FaultKind::duplicate_triangles, "duplicate triangles"},
    {FaultKind::non_manifold_edges, "non-manifold edges"},
    {FaultKind::orientation, "orientation"},
    {FaultKind::non_manifold_vertices, "non-manifold vertices"},
    {FaultKind::holes, "holes"},
    {FaultKind::self_intersections, "self-intersections"},
    {FaultKind::needle_triangles, "needle triangles"},
    {FaultKind::folds, "folds"},
    {FaultKind::near_vertices, "near vertices"},
    {FaultKind::vertices_off_surface, "vertices off surface"},
    {FaultKind::stray_vertices, "stray vertices"},
    {FaultKind::triangles_off_surface, "triangles off surface"},
    {FaultKind::missing_components, "missing components"},
    {FaultKind::extra_components, "extra components"},
    {FaultKind::different_components, "different components"},
    {FaultKind::turned_components, "turned components"},
    {FaultKind::turned_caps, "turned caps"},
    {FaultKind::no_volume, "no volume"},
    {FaultKind::restricted_share, "restricted share"},
    {FaultKind::over_limits, "over limits"},
    {FaultKind::too_far, "too far"},
    {FaultKind::not_measured, "not measured"},
}};
static_assert(is_in_order(kFaultTable));

constexpr std::string_view name_of(FaultKind kind) {
  return row_of(kFaultTable, kind).words;
}

struct Fault {
  std::string what;  // one line with the ids
  Vec3 at;           // scaled frame
};

// Kind: an enumeration that ends with count_.
template <class Kind>
class FaultList {
 public:
  static constexpr std::size_t kShown = 5;  // faults of every kind are kept in full

  // Adds a fault. `what` is a text or a function that returns one, called only if the fault is
  // kept.
  template <class What>
  void add(Kind kind, const What& what, const Vec3& at) {
    Entry& entry = entries_[static_cast<std::size_t>(kind)];
    if (entry.count++ >= kShown) return;
    if constexpr (std::is_invocable_v<What>) {
      entry.first.push_back({what(), at});
    } else {
      entry.first.push_back({what, at});
    }
  }
  // Adds `more` faults without a description.
  void add_unnamed(Kind kind, std::size_t more) {
    entries_[static_cast<std::size_t>(kind)].count += more;
  }
  std::size_t count(Kind kind) const { return entries_[static_cast<std::size_t>(kind)].count; }
  const std::vector<Fault>& first(Kind kind) const {
    return entries_[static_cast<std::size_t>(kind)].first;
  }
  bool any() const {
    for (const Entry& entry : entries_) {
      if (entry.count > 0) return true;
    }
    return false;
  }

 private:
  struct Entry {
    std::size_t count = 0;
    std::vector<Fault> first;
  };
  std::array<Entry, static_cast<std::size_t>(Kind::count_)> entries_;
};
using Faults = FaultList<FaultKind>;

}  // namespace deliso
