// SPDX-License-Identifier: MIT
// Which facet is seen at which place of a picture: a z-buffer over a grid of samples, several to a
// pixel and direction.
//
//   Z1  Corners are snapped to 1/256 of the sample distance. From there on coverage is exact
//       (integers), so facets with a common edge leave no gap.
//   Z2  A sample has the facet nearest to the eye, and the one of the lower id at equal depth.
//   Z3  Clipping is decided sample by sample, so a facet can be drawn in part.
//   Z4  Layers behind the first are peeled off: the next one is the nearest of what is behind the
//       last (Everitt 2001).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/tri_mesh.h"
#include "view/render/camera.h"

namespace deliso {

// A mesh as the camera sees it: one entry per vertex.
struct ProjectedMesh {
  static constexpr std::int64_t kUnit = 256;  // snapped units between two samples

  struct Point {
    std::int64_t x, y;  // snapped units, from the top left corner of the picture
    double depth;
    double height;  // above the clipping plane; what is above 0 is not drawn
  };

  int columns = 0, rows = 0;  // samples of the whole picture
  std::vector<Point> points;
};

// pre: samples_per_side * size * zoom of the camera is below 2^21.
ProjectedMesh project(const TriMesh& mesh, const Camera& camera, int samples_per_side,
                      const std::optional<ClipPlane>& clip);

// The facet's corners seen from one sample.
struct CornerWeights {
  std::array<std::int64_t, 3> weight;  // w[0] + w[1] + w[2] = area; no sign differs from area's
  std::int64_t area = 0;               // twice the signed area; 0: seen from its edge

  double share(int i) const {
    return static_cast<double>(weight[static_cast<std::size_t>(i)]) / static_cast<double>(area);
  }
};
CornerWeights corners_at(const ProjectedMesh& mesh, const Triangle& triangle, int column, int row);

// What the samples of some rows see, row by row; kNoId and minus infinity where nothing is seen.
struct Layer {
  std::vector<FaceId> faces;
  std::vector<double> depths;
};

// Returns the first layer of the rows from row_begin to row_end or, with `front`, the next one
// behind it.
Layer visible_layer(const TriMesh& mesh, const ProjectedMesh& projected, int row_begin, int row_end,
                    const Layer* front = nullptr);
std::vector<FaceId> visible_faces(const TriMesh& mesh, const ProjectedMesh& projected,
                                  int row_begin, int row_end);

}  // namespace deliso
