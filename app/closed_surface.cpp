// SPDX-License-Identifier: MIT
#include "app/closed_surface.h"

#include <algorithm>
#include <utility>

#include "app/bring_home.h"
#include "app/check_report.h"
#include "app/text.h"
#include "base/box3.h"
#include "base/check.h"
#include "base/text.h"
#include "base/triangle.h"
#include "check/self_intersections.h"
#include "check/validity.h"
#include "mesh/first_at_place.h"

namespace deliso {
namespace {

using Sides = std::array<std::int64_t, 2>;
constexpr std::int64_t kBoxFaces = 6;

bool is_box_face(std::int64_t label) {
  return -kBoxFaces <= label && label < 0;
}

// Returns the regions' labels, ascending. Behind a facet there is no face of the box.
std::vector<RegionLabel> labels_of(std::span<const Sides> sides) {
  std::vector<std::int64_t> all;
  for (const auto& [front, behind] : sides) {
    for (const std::int64_t label : {front, behind}) {
      if (!is_box_face(label) && label != 0) all.push_back(label);
    }
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::vector<RegionLabel> labels;
  labels.reserve(all.size());
  for (const std::int64_t label : all) labels.push_back({label});
  return labels;
}

// Returns 1 plus the face of the box that the triangle lies in, or 0.
std::uint32_t face_of(const TriMesh& mesh, const Triangle& t, const Box3& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto lies_at = [&](double x) {
      return std::ranges::all_of(t, [&](VertexId v) { return mesh.points[v][axis] == x; });
    };
    if (lies_at(box.lo[axis])) return static_cast<std::uint32_t>(2 * axis + 1);
    if (lies_at(box.hi[axis])) return static_cast<std::uint32_t>(2 * axis + 2);
  }
  return 0;
}

// Reports as holes the edges around which the regions do not follow each other.
void find_ends(const ClosedSurface& skin, const CleanMesh& clean, Faults& faults) {
  std::vector<std::pair<RegionId, int>> around;
  for_each_edge(clean.uses, [&](std::span<const EdgeUse> edge) {
    around.clear();
    for (const EdgeUse& use : edge) {
      const Wall& wall = skin.walls[clean.id[use.triangle]];
      around.emplace_back(wall.behind, use.forward ? 1 : -1);
      around.emplace_back(wall.front, use.forward ? -1 : 1);
    }
    for (const auto& side : around) {
      const RegionId region = side.first;
      int sum = 0;
      for (const auto& [other, step] : around) sum += other == region ? step : 0;
      if (sum == 0 || region == kOutside) continue;
      const auto what = [&] {
        return text(
            skin.has_labels ? text("label ", skin.labels[region - 1].number, " ") : "the surface ",
            edge.size() % 2 == 1 || skin.has_labels
                ? "is open at edge "
                : "has triangles that face different ways at edge ",
            edge[0].lo, "-", edge[0].hi);
      };
      faults.add(FaultKind::holes, what,
                 .5 * (skin.mesh.points[edge[0].lo] + skin.mesh.points[edge[0].hi]));
      break;
    }
    return true;
  });
}

}  // namespace

ClosedSurface closed_surface(const TriMesh& surface, const MeshNotes& notes) {
  const std::span<const Sides> sides = notes.sides;
  ClosedSurface made;
  made.has_labels = !sides.empty();
  made.labels = sides.empty() ? std::vector{RegionLabel{1}} : labels_of(sides);
  const auto region_of = [&](std::int64_t label) {
    const auto place = std::ranges::find(made.labels, label, &RegionLabel::number);
    return place == made.labels.end() ? kOutside : RegionId(place - made.labels.begin() + 1);
  };
  const Box3 box = surface.points.empty() ? Box3() : box_of(surface.points);
  const std::vector<VertexId> first = first_at_place(surface.points);
  IdArray<VertexId, VertexId> number(surface.points.size(), kNoId);
  for (FaceId f = 0; f < surface.faces.size(); ++f) {
    const Sides s = sides.empty() ? Sides{0, 1} : sides[f];
    Wall wall{surface.faces[f].v, region_of(s[0]), region_of(s[1])};
    for (VertexId& v : wall.v) v = first[v];
    const auto& [a, b, c] = wall.v;
    if (wall.front == wall.behind || a == b || b == c || c == a) continue;
    wall.kind = sides.empty()       ? face_of(surface, wall.v, box)
                : is_box_face(s[0]) ? static_cast<std::uint32_t>(-s[0])
                                    : 0;
    for (const VertexId v : wall.v) number[v] = 0;
    made.walls.push_back(wall);
  }
  std::vector<Vec3> points;
  for (VertexId v = 0; v < number.size(); ++v) {
    if (number[v] == kNoId) continue;
    number[v] = VertexId(points.size());
    points.push_back(surface.points[v]);
  }
  std::vector<Triangle> triangles;
  for (Wall& wall : made.walls) {
    for (VertexId& v : wall.v) v = number[v];
    triangles.push_back(wall.v);
  }
  made.mesh = make_tri_mesh(std::move(points), triangles);
  made.mesh.frame = surface.frame;
  for (const Wall& wall : made.walls) {
    const auto& [a, b, c] = wall.v;
    const auto& p = made.mesh.points;
    const double sixfold = sixfold_volume(box.middle(), p[a], p[b], p[c]);
    made.volume += ((wall.front == kOutside) - (wall.behind == kOutside)) * sixfold / 6;
  }
  made.is_turned = made.volume < 0 && !made.has_labels;
  if (made.is_turned) {
    made.volume = -made.volume;
    for (Wall& wall : made.walls) std::swap(wall.front, wall.behind);
  }
  return made;
}

void require_closed(const ClosedSurface& surface, const std::string& name, int threads) {
  Faults faults;
  const CleanMesh clean = check_validity(surface.mesh, {}, MayEnd::anywhere, faults);
  find_ends(surface, clean, faults);
  if (faults.count(FaultKind::holes) == 0) {
    report_self_intersections(surface.mesh, clean, threads, faults);
  }
  if (!faults.any() && surface.volume <= 0) {
    throw InputError(name, ": the labels in front of its triangles are those behind them");
  }
  constexpr std::pair<FaultKind, const char*> kAdvice[] = {
      {FaultKind::degenerate_triangles, ""},
      {FaultKind::duplicate_triangles, ""},
      {FaultKind::holes, "a solid needs a closed surface, which deliso mesh makes with --cap"},
      {FaultKind::self_intersections, "a solid needs a surface that does not cross itself"},
      {FaultKind::not_measured, ""}};
  for (const auto& [kind, advice] : kAdvice) {
    if (faults.count(kind) == 0) continue;
    const Fault& fault = faults.first(kind).front();
    const std::size_t more = faults.count(kind) - 1;
    const bool is_rounded =
        (kind == FaultKind::degenerate_triangles || kind == FaultKind::self_intersections) &&
        digits_of(surface.mesh.points).is_single;
    throw InputError(name, ": ", fault.what, " at ", place_text(fault.at),
                     more > 0 ? text(", and ", grouped(more), " more") : "",
                     is_rounded ? text("; single precision may be why: ", kKeepDoubles)
                     : *advice  ? text("; ", advice)
                                : "");
  }
}

}  // namespace deliso
