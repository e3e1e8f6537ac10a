// SPDX-License-Identifier: MIT
// Draws triangle meshes: z-buffer (rasterize.h), colors (shade.h), and the mean over all samples of
// a pixel against jagged edges. The same meshes and options give the same picture.
//
//   P1  several subjects are drawn side by side, in panels of one size with a thin rule between
//       them, all by one camera: what lies at the same place in space does so in every panel.
#pragma once

#include <optional>
#include <span>

#include "mesh/tri_mesh.h"
#include "render/camera.h"
#include "render/image.h"
#include "render/shade.h"

namespace deliso {

struct RenderOptions {
  std::optional<View> view;  // absent: best_view
  Aim aim;
  PictureSize size;  // of the whole picture
  Shading shading = Shading::smooth;
  Edges edges = Edges::automatic;
  Palette palette;
};

inline constexpr int kLargestSide = 8192;   // pixels of a picture
inline constexpr double kLargestZoom = 64;  // with it, the bound that rasterize.h asks for

// The size of each of `count` panels of a picture; what does not divide evenly is left at its
// right. Throws InputError where the picture is too narrow. pre: count >= 1.
PictureSize panel_size(PictureSize picture, std::size_t count);

// Of a ring of views from above, the one that sees most of the surfaces, clipped as they shall be
// drawn: area of the surface through every pixel of a small picture, of the proportions of `panel`.
// Throws as fit_camera.
View best_view(std::span<const Subject> subjects, PictureSize panel);

// pre: at least one subject, sides from 1 to kLargestSide, 0 < zoom <= kLargestZoom. Throws as
// fit_camera and panel_size.
Image render(std::span<const Subject> subjects, const RenderOptions& options);

}  // namespace deliso
