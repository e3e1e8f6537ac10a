// SPDX-License-Identifier: MIT
// Draws a triangle mesh: z-buffer (rasterize.h), colors (shade.h), and the mean over all samples of
// a pixel against jagged edges. The same mesh and options give the same picture.
#pragma once

#include <optional>

#include "mesh/tri_mesh.h"
#include "render/camera.h"
#include "render/image.h"
#include "render/shade.h"

namespace deliso {

struct RenderOptions {
  std::optional<View> view;  // absent: best_view
  double zoom = 1;           // 1: the mesh fills the picture
  PictureSize size;
  Shading shading = Shading::smooth;
  Edges edges = Edges::automatic;
  std::optional<ClipPlane> clip;
  Palette palette;
};

inline constexpr int kLargestSide = 8192;   // pixels of a picture
inline constexpr double kLargestZoom = 64;  // with it, the bound that rasterize.h asks for

// Of a ring of views from above, the one that sees most of the surface, clipped as it shall be
// drawn: area of the surface through every pixel of a small picture. Throws as fit_camera.
View best_view(const TriMesh& mesh, PictureSize size, const std::optional<ClipPlane>& clip);

// pre: sides from 1 to kLargestSide, 0 < zoom <= kLargestZoom. Throws as fit_camera.
Image render(const TriMesh& mesh, const RenderOptions& options);

}  // namespace deliso
