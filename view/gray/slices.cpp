// SPDX-License-Identifier: MIT
#include "view/gray/slices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/parallel.h"
#include "base/text.h"
#include "view/render/scale_bar.h"

namespace deliso {
namespace {

constexpr int kSide = 3;           // samples of a pixel in each direction
constexpr int kRowsAtOnce = 64;    // pixels
constexpr double kCurveWidth = 2;  // in widths of an edge (layout.h)
// In heights of capital letters: below the slices, and for a caption.
constexpr double kBarStrip = 4, kCaption = 24;

// A slice: the volume's axes across it, to the right and up, with the signs of the latter two.
struct Slice {
  int across, right, up;
  double right_sign = 1, up_sign = 1;
  std::string_view right_name, up_name;
};

// S2. The volume's axes are ordered by the patient's.
std::array<Slice, 3> slices_of(const Frame& frame) {
  std::array<Slice, 3> plain{
      {{0, 1, 2, 1, 1, "y", "z"}, {1, 0, 2, 1, 1, "x", "z"}, {2, 0, 1, 1, 1, "x", "y"}}};
  if (frame.space == AnatomicalSpace::unknown) return plain;
  std::array<int, 3> along{-1, -1, -1};  // the volume's axis along the patient's
  std::array<double, 3> sign{};          // to the patient's left, back and head
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3& to = frame.axes[static_cast<std::size_t>(axis)];
    int of = 0;
    for (const int other : {1, 2}) of = std::abs(to[other]) > std::abs(to[of]) ? other : of;
    const auto n = static_cast<std::size_t>(of);
    if (along[n] >= 0) return plain;
    along[n] = axis;
    sign[n] = (to[of] < 0) != (frame.space == AnatomicalSpace::ras && of < 2) ? -1 : 1;
  }
  const auto& [x, y, z] = along;
  return {{{x, y, z, sign[1], sign[2], "P", "S"},
           {y, x, z, sign[0], sign[2], "L", "S"},
           {z, x, y, sign[0], -sign[1], "L", "A"}}};
}

// The part of the picture that a slice fills.
struct Window {
  int left, top, width, height;
};

// Draws pixel rows `begin` to `end` of the window.
void draw_rows(const Volume& volume, const SliceOptions& options, const Slice& slice,
               const Window& window, double scale, double curve, int begin, int end, Image& image) {
  const Vec3 middle = volume.box().middle();
  const auto value_at = [&](int column, int row) {
    Vec3 p;
    p[slice.across] = options.through[slice.across];
    p[slice.right] = middle[slice.right] +
                     slice.right_sign * ((column + 0.5) / kSide - 0.5 * window.width) / scale;
    p[slice.up] =
        middle[slice.up] + slice.up_sign * (0.5 * window.height - (row + 0.5) / kSide) / scale;
    return volume.value(p);
  };
  // Rows of samples, those beside that the curve's width reaches included.
  const int reach = static_cast<int>(std::ceil(0.5 * curve * kSide)),
            columns = kSide * window.width;
  const int first = kSide * begin - reach, rows = kSide * (end - begin) + 2 * reach;
  const auto place = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  };
  std::vector<double> values(place(0, rows));
  std::vector<int> on_curve(values.size());  // at first where spans begin less where they end
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      values[place(column, row)] = value_at(column, first + row);
    }
  }
  const auto differ = [&](int column, int row, int other_column, int other_row) {
    return other_column < columns && other_row < rows &&
           (values[place(column, row)] >= *options.kappa) !=
               (values[place(other_column, other_row)] >= *options.kappa);
  };
  // Draws a disk, row by row.
  const auto widen = [&](int column, int row) {
    const double radius = 0.5 * curve * kSide;
    for (int y = std::max(0, row - reach); y <= std::min(rows - 1, row + reach); ++y) {
      const double rest = radius * radius - static_cast<double>((y - row) * (y - row));
      if (rest < 0) continue;
      const int half = static_cast<int>(std::sqrt(rest)), past = column + half + 1;
      ++on_curve[place(std::max(0, column - half), y)];
      if (past < columns) --on_curve[place(past, y)];
    }
  };
  for (int row = 0; options.kappa && row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (differ(column, row, column + 1, row) || differ(column, row, column, row + 1)) {
        widen(column, row);
      }
    }
  }
  for (int row = 0; row < rows; ++row) {
    for (int column = 1; column < columns; ++column) {
      on_curve[place(column, row)] += on_curve[place(column - 1, row)];
    }
  }
  for (int y = begin; y < end; ++y) {
    for (int x = 0; x < window.width; ++x) {
      double gray = 0, covered = 0;
      for (int n = 0; n < kSide * kSide; ++n) {
        const std::size_t at = place(kSide * x + n % kSide, kSide * y - first + n / kSide);
        gray += options.window.gray(values[at]) / (kSide * kSide);
        covered += on_curve[at] > 0 ? 1.0 / (kSide * kSide) : 0;
      }
      const auto byte = static_cast<std::uint8_t>(std::lround(255 * gray));
      image.at(window.left + x, window.top + y) = mixed({byte, byte, byte}, kCurve, covered);
    }
  }
}

}  // namespace

Image draw_slices(const Volume& volume, const SliceOptions& wanted) {
  const Vec3 sides = volume.box().size();
  if (!(volume.box().smallest_side() > 0)) throw InputError("the volume has no voxel to draw");
  SliceOptions options = wanted;
  for (int axis = 0; axis < 3; ++axis) {
    options.through[axis] =
        std::clamp(options.through[axis], volume.box().lo[axis], volume.box().hi[axis]);
  }
  const std::array<Slice, 3> slices = slices_of(volume.frame());
  double right = 0, up = 0;
  for (const Slice& slice : slices) {
    right = std::max(right, sides[slice.right]);
    up = std::max(up, sides[slice.up]);
  }
  Layout layout = lay_out(options.size, slices.size(), true, false);
  const int strip = static_cast<int>(std::lround(kBarStrip * layout.text));
  if (layout.panel.height <= strip) {
    throw InputError("a picture ", options.size.height, " pixels high has no room for slices");
  }
  const double scale = std::min(layout.panel.width / right, (layout.panel.height - strip) / up);
  const auto pixels = [&](double length) {
    return std::max(1, static_cast<int>(std::lround(scale * length)));
  };
  const int caption = static_cast<int>(std::lround(kCaption * layout.text));
  layout.panel = {std::min(layout.panel.width, std::max(caption, pixels(right))),
                  pixels(up) + strip};
  layout.picture = {layout.left(slices.size()) - layout.rule,
                    layout.captions + layout.panel.height};
  const Rgb paper{255, 255, 255}, ink = ink_on(paper);
  Image image(layout.picture.width, layout.picture.height, paper);
  for (std::size_t n = 0; n < slices.size(); ++n) {
    const Slice& slice = slices[n];
    Window window{0, 0, pixels(sides[slice.right]), pixels(sides[slice.up])};
    window.left = layout.left(n) + (layout.panel.width - window.width) / 2;
    window.top = layout.captions + (pixels(up) - window.height) / 2;
    const auto bands = static_cast<std::size_t>((window.height - 1) / kRowsAtOnce + 1);
    for_each_task(options.threads, bands, [&](std::size_t band) {
      const int begin = static_cast<int>(band) * kRowsAtOnce;
      draw_rows(volume, options, slice, window, scale, kCurveWidth * layout.line, begin,
                std::min(begin + kRowsAtOnce, window.height), image);
    });
    const double sample = volume.in_samples(options.through, slice.across);
    draw_caption(image, layout, n,
                 text(std::string_view("xyz").substr(static_cast<std::size_t>(slice.across), 1),
                      " at sample ", std::round(100 * sample) / 100, ": right ", slice.right_name,
                      ", up ", slice.up_name),
                 ink);
  }
  draw_rules(image, layout, slices.size(), mixed(paper, ink, 0.25));
  Camera camera;
  camera.scale = scale;
  draw_scale_bar(image, layout, camera, options.unit, ink);
  return image;
}

}  // namespace deliso
