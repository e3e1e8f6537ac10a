// SPDX-License-Identifier: MIT
// Draws triangle meshes: z-buffer (rasterize.h), colors (shade.h), and the mean over all samples of
// a pixel against jagged edges. The same meshes and options give the same picture.
//
//   P1  Several subjects are drawn side by side (layout.h), in panels of one size, all by one
//       camera. So a place in space is at the same place in every panel.
//   P2  Edges are drawn in all panels or in none, by lines of one width and strength.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/tri_mesh.h"
#include "view/render/camera.h"
#include "view/render/color_bar.h"
#include "view/render/image.h"
#include "view/render/layout.h"
#include "view/render/shade.h"

namespace deliso {

struct RenderOptions {
  std::optional<View> view;  // absent: best_view
  Aim aim;
  PictureSize size;  // of the whole picture
  Shading shading = Shading::smooth;
  Edges edges = Edges::automatic;
  bool occlusion = true;  // places between opaque sheets are darker (occlusion.h)
  double opacity = 1;     // of a facet, above 0; below 1 what is behind is seen through it
  int threads = 1;
  Palette palette;
  std::vector<std::string> captions;  // none, or one for each panel; drawable characters
  std::optional<ColorBar> bar;
  std::optional<std::string> scale_bar;  // the unit of lengths, which may be empty; drawable
  std::optional<std::array<std::string_view, 3>> axes;  // their names; drawable
  bool keep_strokes = false;  // of edges that are seen, and of letters, in the image
};

inline constexpr int kLargestSide = 16384;  // pixels of a picture

// What a camera may be aimed by, for the bound that rasterize.h asks for; 64, or less where the
// picture is very large.
double largest_zoom(PictureSize size);

// Throws InputError where the picture is too small for its parts.
Layout layout_of(const RenderOptions& options, std::size_t panels);

// Returns the view, of a ring of views from above, that sees the largest area of the clipped
// surfaces. The area is measured in a small picture with the proportions of `panel`. With clipping
// planes only views that look into every cut count; if there are none, views from further above and
// from below, and then all again. Throws as fit_camera.
View best_view(std::span<const Subject> subjects, PictureSize panel, const Up& up = {});

// pre: at least one subject, sides from 1 to kLargestSide, 0 < zoom <= largest_zoom. Throws as
// fit_camera and layout_of. Memory: the image, and beside it the same whatever its size.
Image render(std::span<const Subject> subjects, const RenderOptions& options);

}  // namespace deliso
