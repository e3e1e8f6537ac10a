// SPDX-License-Identifier: MIT
#include "app/facet_colors.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/bring_home.h"
#include "app/facet_values.h"
#include "base/check.h"
#include "view/render/color_map.h"

namespace deliso {
namespace {

using Values = std::vector<std::vector<double>>;  // of each mesh's facets

// Returns the upper end of a scale: above 99 % of the values, so that a few outliers do not reduce
// the contrast of the others.
ColorBar scale_for(const Values& values, const char* title) {
  std::vector<double> all;
  double greatest = 0;
  for (const std::vector<double>& of_mesh : values) {
    for (const double value : of_mesh) {
      if (std::isfinite(value)) all.push_back(value);
      greatest = std::max(greatest, value);
    }
  }
  if (all.empty()) throw InputError("no triangle is near the isosurface of the volume");
  const double share = std::ceil(0.99 * static_cast<double>(all.size()));
  const auto rank = static_cast<std::ptrdiff_t>(share) - 1;
  std::nth_element(all.begin(), all.begin() + rank, all.end());
  const double most = all[static_cast<std::size_t>(rank)];
  const double hi = most > 0 ? round_up(std::clamp(most, 1e-300, 1e300)) : 1;
  return {title, hi, greatest > hi};
}

FacetColors by_component(std::span<const TriMesh> meshes) {
  FacetColors colors;
  for (const TriMesh& mesh : meshes) {
    const FacetComponents components = facet_components(mesh);
    colors.components.push_back(components.count);
    std::vector<Rgb>& of_mesh = colors.of_mesh.emplace_back();
    for (const std::uint32_t c : components.of_facet) of_mesh.push_back(category_color(c));
  }
  return colors;
}

// The colors that files have; of facets between two labels that of the label behind, as of the
// label's own mesh.
FacetColors by_label(std::span<const MeshNotes> notes, const CommandLine& line) {
  FacetColors colors;
  for (std::size_t n = 0; n < notes.size(); ++n) {
    std::vector<Rgb>& of_mesh = colors.of_mesh.emplace_back();
    if (notes[n].colors.empty() && notes[n].sides.empty()) {
      throw InputError("--color-by label: '", line.meshes[n],
                       "' has no colors; a .glb, .3mf or .vtp of --label all has, and a .ply, "
                       ".vtp or .glb of --shared");
    }
    for (const auto& [red, green, blue] : notes[n].colors) of_mesh.push_back({red, green, blue});
    if (!of_mesh.empty()) continue;
    for (const auto& [front, behind] : notes[n].sides) {
      of_mesh.push_back(category_color(static_cast<std::size_t>(behind != 0 ? behind : front)));
    }
  }
  return colors;
}

FacetColors by_value(const Values& values, ColorBar bar) {
  FacetColors colors;
  for (const std::vector<double>& of_mesh : values) {
    std::vector<Rgb>& to = colors.of_mesh.emplace_back();
    for (const double value : of_mesh) to.push_back(sequential_color(value / bar.hi));
  }
  colors.bar = std::move(bar);
  return colors;
}

template <class F>
Values of_each(std::span<const TriMesh> meshes, F f) {
  Values values;
  for (const TriMesh& mesh : meshes) values.push_back(f(mesh));
  return values;
}

}  // namespace

FacetColors color_facets(std::span<const TriMesh> meshes, std::span<const MeshNotes> notes,
                         const CommandLine& line, const Input* input) {
  const ColorBy color_by = line.picture.color_by;
  if (color_by == ColorBy::side) return {std::vector<std::vector<Rgb>>(meshes.size()), {}, {}};
  if (color_by == ColorBy::label) return by_label(notes, line);
  if (color_by == ColorBy::component) return by_component(meshes);
  if (color_by == ColorBy::angle) {
    return by_value(of_each(meshes, smallest_angles), {"smallest angle (degrees)", 60, false});
  }
  const Volume& volume = input->volume();
  const bool of_distance = color_by == ColorBy::distance;
  const Values values = of_each(meshes, [&](TriMesh mesh) {
    bring_home(mesh, volume);
    return of_distance ? distances_in_voxels(mesh, volume, input->level())
                       : gradient_sizes(mesh, volume);
  });
  return by_value(values,
                  scale_for(values, of_distance ? "distance to the isosurface (voxels)"
                                                : "gradient (sample values per unit of length)"));
}

}  // namespace deliso
