// SPDX-License-Identifier: MIT
#include "view/render/render.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/check.h"
#include "base/triangle.h"
#include "view/render/rasterize.h"
#include "view/render/scale_bar.h"
#include "view/render/seen_edges.h"

namespace deliso {
namespace {

constexpr int kSamplesPerSide = 3;                // of a pixel
constexpr double kMostInk = 0.2;                  // share of the surface that edges cover at most
constexpr double kThinnestEdge = 0.4;             // pixels; thinner lines are no longer told apart
constexpr double kLargestZoom = 64;               // where the picture's size allows it
constexpr double kLargestSpan = 0x1p21;           // samples; of rasterize.h
constexpr std::size_t kMostLayers = 24;           // of a transparent surface
constexpr std::size_t kSamplesAtOnce = 1u << 22;  // bounds the memory

// Length of the edges per area of the surface, in the mesh's units.
double edge_density(const TriMesh& mesh) {
  double lines = 0, area = 0;
  for (const Face& face : mesh.faces) {
    const Vec3 &a = mesh.points[face.v[0]], &b = mesh.points[face.v[1]],
               &c = mesh.points[face.v[2]];
    lines += 0.5 * (distance(a, b) + distance(b, c) + distance(c, a));  // two facets share an edge
    area += 0.5 * length(area_normal(a, b, c));
  }
  return lines / area;
}

// One width for all panels, in pixels; 0: no edges. Lines are thinner where triangles are so small
// that little would be left of the surface otherwise.
double edge_width(std::span<const Subject> subjects, const RenderOptions& options,
                  const Camera& camera, double widest) {
  if (options.edges == Edges::hidden) return 0;
  double density = 0;
  for (const Subject& subject : subjects) {
    density = std::max(density, edge_density(*subject.mesh) / camera.scale);
  }
  const double width = std::min(widest, kMostInk / density);
  return options.edges == Edges::drawn || width >= kThinnestEdge ? width : 0;
}

std::uint8_t to_byte(double value) {
  return static_cast<std::uint8_t>(std::clamp(std::floor(255 * value + 0.5), 0.0, 255.0));
}

Rgb to_rgb(const Vec3& color) {
  return {to_byte(color.x), to_byte(color.y), to_byte(color.z)};
}

// Returns the color of the cut at a sample, if it is filled there.
std::optional<Vec3> section_color(const Subject& subject, const Camera& camera, int column,
                                  int row) {
  if (!subject.clip || !subject.section) return std::nullopt;
  const auto place = camera.place_on(*subject.clip, (column + 0.5) / kSamplesPerSide,
                                     (row + 0.5) / kSamplesPerSide);
  const auto gray = place ? subject.section(*place) : std::nullopt;
  return gray ? std::optional(*gray * Vec3{1, 1, 1}) : std::nullopt;
}

// The surface is on one side of the cut. Where it is behind, a filled cut hides it.
void hide_behind_cut(const Subject& subject, const Camera& camera, int first_row, int columns,
                     Layer& front) {
  if (!subject.clip || !subject.section) return;
  const double eye_above = dot(subject.clip->normal, camera.back) +
                           camera.nearness * subject.clip->height(camera.center);
  if (eye_above <= 0) return;
  for (std::size_t n = 0; n < front.faces.size(); ++n) {
    if (front.faces[n] == kNoId) continue;
    const int at = static_cast<int>(n);
    if (section_color(subject, camera, at % columns, first_row + at / columns)) {
      front.faces[n] = kNoId;
    }
  }
}

// The mean of a pixel's samples, each the mixture of its layers from front to back, and of the cut.
Rgb pixel_color(const Subject& subject, const Camera& camera, const Shader& shader,
                const RenderOptions& options, std::span<const Layer> layers, int columns,
                int first_row, int x, int y) {
  Vec3 sum;
  for (int row = y * kSamplesPerSide; row < (y + 1) * kSamplesPerSide; ++row) {
    for (int column = x * kSamplesPerSide; column < (x + 1) * kSamplesPerSide; ++column) {
      const std::size_t sample =
          static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(columns) +
          static_cast<std::size_t>(column);
      double light = 1;  // the share that passes the layers so far
      for (const Layer& layer : layers) {
        const FaceId face = layer.faces[sample];
        if (face == kNoId) break;
        sum = sum + light * options.opacity * shader.color(face, column, row);
        light *= 1 - options.opacity;
      }
      if (light == 0) continue;
      sum =
          sum +
          light * section_color(subject, camera, column, row).value_or(options.palette.background);
    }
  }
  return to_rgb(sum / (kSamplesPerSide * kSamplesPerSide));
}

// Returns the area of the surface seen, in the mesh's units. Facets at an angle count less, by the
// root of the cosine: halfway between their own size and their size in the picture.
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

// Returns how many layers are drawn: until a layer behind them would change no byte.
std::size_t count_layers(double opacity) {
  constexpr double kLeastLight = 1.0 / 512;
  if (opacity >= 1) return 1;
  return static_cast<std::size_t>(
      std::min<double>(kMostLayers, std::ceil(std::log(kLeastLight) / std::log(1 - opacity))));
}

std::vector<Layer> visible_layers(const TriMesh& mesh, const ProjectedMesh& projected,
                                  int row_begin, int row_end, std::size_t count) {
  std::vector<Layer> layers{visible_layer(mesh, projected, row_begin, row_end)};
  while (layers.size() < count) {
    Layer next = visible_layer(mesh, projected, row_begin, row_end, &layers.back());
    if (std::ranges::all_of(next.faces, [](FaceId f) { return f == kNoId; })) break;
    layers.push_back(std::move(next));
  }
  return layers;
}

// Draws into the part of the image that begins at (left, top) and has the camera's size.
void draw_panel(const Subject& subject, const Camera& camera, const RenderOptions& options,
                double width_of_edges, Image& image, int left, int top) {
  const TriMesh& mesh = *subject.mesh;
  const ProjectedMesh projected = project(mesh, camera, kSamplesPerSide, subject.clip);
  const std::vector<SkySeen> sky = options.occlusion && options.opacity == 1
                                       ? find_sky(subject, vertex_normals(mesh), options.threads)
                                       : std::vector<SkySeen>{};
  const double painted = options.keep_strokes ? 0 : width_of_edges;
  const Shader shader(subject, projected, camera, options.shading, painted * kSamplesPerSide,
                      options.palette, sky);
  const std::size_t layers = count_layers(options.opacity);

  const std::size_t samples_per_line =
      static_cast<std::size_t>(projected.columns) * kSamplesPerSide;
  const int lines_at_once =
      static_cast<int>(std::max<std::size_t>(1, kSamplesAtOnce / layers / samples_per_line));
  for (int begin = 0; begin < camera.size.height; begin += lines_at_once) {
    const int end = std::min(camera.size.height, begin + lines_at_once);
    std::vector<Layer> seen =
        visible_layers(mesh, projected, begin * kSamplesPerSide, end * kSamplesPerSide, layers);
    hide_behind_cut(subject, camera, begin * kSamplesPerSide, projected.columns, seen.front());
    if (painted < width_of_edges) {
      const Rgb color = to_rgb(options.palette.edge);
      for (const SeenEdge& edge :
           seen_edges(mesh, projected, seen.front(), begin * kSamplesPerSide)) {
        const Vec2 corner{static_cast<double>(left), static_cast<double>(top)};
        image.strokes.push_back({corner + (1.0 / kSamplesPerSide) * edge.from,
                                 corner + (1.0 / kSamplesPerSide) * edge.to, width_of_edges,
                                 color});
      }
    }
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < camera.size.width; ++x) {
        image.at(left + x, top + y) = pixel_color(subject, camera, shader, options, seen,
                                                  projected.columns, begin * kSamplesPerSide, x, y);
      }
    }
  }
}

// How much a view looks into the cuts: the cosine between it and the normal of the plane that faces
// it least; 1 without planes.
double facing(std::span<const Subject> subjects, const View& view) {
  double least = 1;
  for (const Subject& subject : subjects) {
    if (!subject.clip) continue;
    const Vec3& normal = subject.clip->normal;
    least = std::min(least, dot(normal, direction_to(view)) / length(normal));
  }
  return least;
}

}  // namespace

double largest_zoom(PictureSize size) {
  return std::min(kLargestZoom,
                  kLargestSpan / (kSamplesPerSide * (1 + std::max(size.width, size.height))));
}

Layout layout_of(const RenderOptions& options, std::size_t panels) {
  return lay_out(options.size, panels, !options.captions.empty(), options.bar.has_value());
}

View best_view(std::span<const Subject> subjects, PictureSize panel, const Up& up) {
  constexpr double kPixels = 25000;
  constexpr double kIntoCut = 0.5;  // 60 degrees
  const double shrink = std::sqrt(kPixels / (static_cast<double>(panel.width) * panel.height));
  const PictureSize small{std::max(1, static_cast<int>(shrink * panel.width)),
                          std::max(1, static_cast<int>(shrink * panel.height))};
  std::optional<View> best;
  double most = -1;
  const auto choose_from = [&](double elevation, double least_facing) {
    for (int azimuth = 30; azimuth < 360; azimuth += 30) {
      if (azimuth % 90 == 0) continue;  // along an axis much of a volume lies edge on
      const View view{static_cast<double>(azimuth), elevation, up};
      if (facing(subjects, view) < least_facing) continue;
      const Camera camera = fit_camera(subjects, view, {}, small);
      double area = 0;
      for (const Subject& subject : subjects) area += area_seen(subject, camera);
      if (area > most) {
        most = area;
        best = view;
      }
    }
  };
  for (const double elevation : {25.0, 50.0, -25.0, -50.0}) {
    if (!best) choose_from(elevation, kIntoCut);
  }
  if (!best) choose_from(25, -1);
  return *best;
}

Image render(std::span<const Subject> subjects, const RenderOptions& options) {
  const PictureSize size = options.size;
  DELISO_CHECK(!subjects.empty());
  DELISO_CHECK(1 <= std::min(size.width, size.height));
  DELISO_CHECK(std::max(size.width, size.height) <= kLargestSide);
  DELISO_CHECK(0 < options.aim.zoom && options.aim.zoom <= largest_zoom(size));
  DELISO_CHECK(0 < options.opacity && options.opacity <= 1);
  DELISO_CHECK(options.captions.empty() || options.captions.size() == subjects.size());

  const Layout layout = layout_of(options, subjects.size());
  const View view = options.view ? *options.view : best_view(subjects, layout.panel);
  const Camera camera = fit_camera(subjects, view, options.aim, layout.panel);
  const double width_of_edges = edge_width(subjects, options, camera, layout.line);

  const Rgb background = to_rgb(options.palette.background), ink = ink_on(background);
  Image image(size.width, size.height, background);
  image.keeps_strokes = options.keep_strokes;
  for (std::size_t n = 0; n < subjects.size(); ++n) {
    draw_panel(subjects[n], camera, options, width_of_edges, image, layout.left(n),
               layout.captions);
    if (!options.captions.empty()) draw_caption(image, layout, n, options.captions[n], ink);
  }
  draw_rules(image, layout, subjects.size(), mixed(background, ink, 0.25));
  if (options.bar) draw_color_bar(image, layout, *options.bar, ink);
  if (options.scale_bar) draw_scale_bar(image, layout, camera, *options.scale_bar, ink);
  if (options.axes) draw_axes(image, layout, camera, *options.axes, ink);
  return image;
}

}  // namespace deliso
