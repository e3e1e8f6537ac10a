// SPDX-License-Identifier: MIT
// Draws triangle meshes: z-buffer (rasterize.h), colors (shade.h), and the mean over all samples of
// a pixel against jagged edges. The same meshes and options give the same picture.
//
//   P1  several subjects are drawn side by side (layout.h), in panels of one size, all by one
//       camera: what lies at the same place in space does so in every panel;
//   P2  edges are drawn in all panels or in none, by lines of one width and strength.
#pragma once

#include <optional>
#include <span>
#include <string>
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
  Palette palette;
  std::vector<std::string> captions;  // none, or one for each panel; drawable characters
  std::optional<ColorBar> bar;
};

inline constexpr int kLargestSide = 16384;  // pixels of a picture

// What a camera may be aimed by, for the bound that rasterize.h asks for; 64, or less where the
// picture is very large.
double largest_zoom(PictureSize size);

// Throws InputError where the picture is too small for its parts.
Layout layout_of(const RenderOptions& options, std::size_t panels);

// Of a ring of views from above, the one that sees most of the surfaces, clipped as they shall be
// drawn: area of the surface through every pixel of a small picture, of the proportions of `panel`.
// Where there are clipping planes, only views that look into every cut count, from further above or
// from below where it takes that; and all again where cuts face away from each other. Throws as
// fit_camera.
View best_view(std::span<const Subject> subjects, PictureSize panel, const Up& up = {});

// pre: at least one subject, sides from 1 to kLargestSide, 0 < zoom <= largest_zoom. Throws as
// fit_camera and layout_of. Memory: the image, and beside it the same whatever its size.
Image render(std::span<const Subject> subjects, const RenderOptions& options);

}  // namespace deliso
