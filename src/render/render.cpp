// SPDX-License-Identifier: MIT
#include "render/render.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/check.h"
#include "base/text.h"
#include "base/triangle.h"
#include "render/rasterize.h"

namespace deliso {
namespace {

constexpr int kSamplesPerSide = 3;   // of a pixel
constexpr double kEdgeWidth = 0.9;   // pixels
constexpr double kShortestEdge = 4;  // pixels, on average, for edges to be drawn
constexpr int kRule = 2;             // pixels, between panels
constexpr Rgb kRuleColor{200, 200, 200};
constexpr std::size_t kSamplesAtOnce = 1u << 22;  // bounds the memory

// Mean length of the facets' edges in the picture, in pixels.
double mean_edge(const TriMesh& mesh, const Camera& camera) {
  double sum = 0;
  for (const Face& face : mesh.faces) {
    for (std::size_t i = 0; i < 3; ++i) {
      sum += distance(mesh.points[face.v[i]], mesh.points[face.v[(i + 1) % 3]]);
    }
  }
  return camera.scale * sum / (3.0 * static_cast<double>(mesh.faces.size()));
}

std::uint8_t to_byte(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::floor(255 * value + 0.5), 0.0, 255.0));
}

// The mean of a pixel's samples.
Rgb pixel_color(const Shader& shader, const Vec3& background, std::span<const FaceId> faces,
                int columns, int first_row, int x, int y) {
  Vec3 sum;
  for (int row = y * kSamplesPerSide; row < (y + 1) * kSamplesPerSide; ++row) {
    for (int column = x * kSamplesPerSide; column < (x + 1) * kSamplesPerSide; ++column) {
      const FaceId face =
          faces[static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(columns) +
                static_cast<std::size_t>(column)];
      sum = sum + (face == kNoId ? background : shader.color(face, column, row));
    }
  }
  const Vec3 mean = sum / (kSamplesPerSide * kSamplesPerSide);
  return {to_byte(mean.x), to_byte(mean.y), to_byte(mean.z)};
}

// Area of the surface seen, in the mesh's units; what is seen at an angle counts less, by the root
// of the cosine: halfway between how large it is and how large it looks.
double area_seen(const Subject& subject, const Camera& camera) {
  const TriMesh& mesh = *subject.mesh;
  const ProjectedMesh projected = project(mesh, camera, 1, subject.clip);
  double area = 0;
  for (const FaceId f : visible_faces(mesh, projected, 0, projected.rows)) {
    if (f == kNoId) continue;
    const Triangle& t = mesh.faces[f].v;
    const Vec3 normal = area_normal(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    const double cosine = std::abs(dot(normal, camera.back)) / length(normal);
    if (cosine > 0) area += 1 / std::sqrt(cosine);
  }
  return area / (camera.scale * camera.scale);
}

// Draws into the part of the image that begins at column `left` and has the camera's size.
void draw_panel(const Subject& subject, const Camera& camera, const RenderOptions& options,
                Image& image, int left) {
  const TriMesh& mesh = *subject.mesh;
  const ProjectedMesh projected = project(mesh, camera, kSamplesPerSide, subject.clip);
  const bool edges = options.edges == Edges::drawn || (options.edges == Edges::automatic &&
                                                       mean_edge(mesh, camera) >= kShortestEdge);
  const Shader shader(mesh, projected, camera, options.shading,
                      edges ? kEdgeWidth * kSamplesPerSide : 0, options.palette);

  const std::size_t samples_per_line =
      static_cast<std::size_t>(projected.columns) * kSamplesPerSide;
  const int lines_at_once =
      static_cast<int>(std::max<std::size_t>(1, kSamplesAtOnce / samples_per_line));
  for (int begin = 0; begin < camera.size.height; begin += lines_at_once) {
    const int end = std::min(camera.size.height, begin + lines_at_once);
    const std::vector<FaceId> faces =
        visible_faces(mesh, projected, begin * kSamplesPerSide, end * kSamplesPerSide);
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < camera.size.width; ++x) {
        image.at(left + x, y) = pixel_color(shader, options.palette.background, faces,
                                            projected.columns, begin * kSamplesPerSide, x, y);
      }
    }
  }
}

}  // namespace

PictureSize panel_size(PictureSize picture, std::size_t count) {
  const auto width = static_cast<std::size_t>(picture.width);
  const std::size_t rules = (count - 1) * static_cast<std::size_t>(kRule);
  if (width < rules + count) {
    throw InputError(text("a picture ", width, " pixels wide has no room for ", count, " panels"));
  }
  return {static_cast<int>((width - rules) / count), picture.height};
}

View best_view(std::span<const Subject> subjects, PictureSize panel) {
  constexpr double kPixels = 25000;
  const double shrink = std::sqrt(kPixels / (static_cast<double>(panel.width) * panel.height));
  const PictureSize small{std::max(1, static_cast<int>(shrink * panel.width)),
                          std::max(1, static_cast<int>(shrink * panel.height))};
  View best;
  double most = -1;
  for (int azimuth = 30; azimuth < 360; azimuth += 30) {
    if (azimuth % 90 == 0) continue;  // along an axis much of a volume lies edge on
    const View view{static_cast<double>(azimuth), 25};
    const Camera camera = fit_camera(subjects, view, {}, small);
    double area = 0;
    for (const Subject& subject : subjects) area += area_seen(subject, camera);
    if (area > most) {
      most = area;
      best = view;
    }
  }
  return best;
}

Image render(std::span<const Subject> subjects, const RenderOptions& options) {
  const PictureSize size = options.size;
  DELISO_CHECK(!subjects.empty());
  DELISO_CHECK(1 <= std::min(size.width, size.height));
  DELISO_CHECK(std::max(size.width, size.height) <= kLargestSide);
  DELISO_CHECK(0 < options.aim.zoom && options.aim.zoom <= kLargestZoom);

  const PictureSize panel = panel_size(size, subjects.size());
  const View view = options.view ? *options.view : best_view(subjects, panel);
  const Camera camera = fit_camera(subjects, view, options.aim, panel);

  const Vec3& background = options.palette.background;
  Image image(size.width, size.height,
              {to_byte(background.x), to_byte(background.y), to_byte(background.z)});
  int left = 0;
  for (const Subject& subject : subjects) {
    if (left > 0) {
      for (int y = 0; y < size.height; ++y) {
        for (int x = left - kRule; x < left; ++x) image.at(x, y) = kRuleColor;
      }
    }
    draw_panel(subject, camera, options, image, left);
    left += panel.width + kRule;
  }
  return image;
}

}  // namespace deliso
