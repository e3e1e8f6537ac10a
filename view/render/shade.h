// SPDX-License-Identifier: MIT
// The color of a place on a mesh: two lights fixed to the camera, one color for the side where
// f < kappa (outside) and one for the other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/tri_mesh.h"
#include "view/render/camera.h"
#include "view/render/occlusion.h"
#include "view/render/rasterize.h"

namespace deliso {

enum class Shading : std::uint8_t {
  smooth,  // normals vary over a facet
  flat,
};

enum class Edges : std::uint8_t {
  automatic,  // drawn where the picture is large enough to tell them apart in every panel
  drawn,
  hidden,
};

struct Palette {
  Vec3 outside{0.62, 0.73, 0.88}, inside{0.93, 0.66, 0.38};
  Vec3 edge{0.10, 0.12, 0.16}, background{1, 1, 1};  // red, green, blue from 0 to 1
};

// Means of the facets' normals at each vertex, weighted by area; zero where there are none.
std::vector<Vec3> vertex_normals(const TriMesh& mesh);

class Shader {
 public:
  // Keeps references to all but the palette. edge_width in samples, 0: no edges. `sky`: what each
  // vertex sees of it; empty: no occlusion.
  Shader(const Subject& subject, const ProjectedMesh& projected, const Camera& camera,
         Shading shading, double edge_width, const Palette& palette, std::span<const SkySeen> sky);

  // The color of the facet at a sample that it covers, each part from 0 to 1.
  Vec3 color(FaceId face, int column, int row) const;

 private:
  double edge_share(const Triangle& triangle, const CornerWeights& corners) const;
  Vec3 surface_color(FaceId face, bool outside) const;
  Vec3 lit(const Vec3& base, const Vec3& normal) const;

  const TriMesh& mesh_;
  std::span<const Rgb> colors_;
  std::span<const SkySeen> sky_;
  const ProjectedMesh& projected_;
  const Camera& camera_;
  Palette palette_;
  double edge_reach_;          // samples
  Vec3 key_, fill_, gloss_;    // unit directions to the lights, and that of the highlight
  std::vector<Vec3> normals_;  // one per vertex; empty for flat shading
};

}  // namespace deliso
