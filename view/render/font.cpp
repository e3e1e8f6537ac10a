// SPDX-License-Identifier: MIT
#include "view/render/font.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/check.h"
#include "base/vec2.h"

namespace deliso {
namespace {

// Glyphs lie on a grid: the baseline is at height 3, capitals reach to 12, small letters to 9, and
// what hangs down to 0. A point is two hexadecimal digits, x and y; a stroke is a chain of points,
// and strokes are parted by blanks. After ~ corners are rounded: a parabola leads from the middle
// of the side before each to that of the side after it. After @ they are too, and the chain is
// closed.
struct Glyph {
  int width;
  std::string_view strokes;
};
constexpr double kBaseline = 3, kCapitals = 9;  // units
constexpr double kPen = 1.15, kGlyphGap = 3.2;  // its width, and between glyphs; units
constexpr double kThinnest = 0.9;               // pixels

constexpr std::array kGlyphs = std::to_array<Glyph>({
    {2, ""},
    {0, "0c06 0303"},
    {2, "0c09 2c29"},
    {6, "2c13 5c43 0969 0666"},
    {6, "~6a6c0c0867630305 3d32"},
    {8, "7c13 @090c3c39 @53568683"},
    {7, "~731a1c5c5a05035377"},
    {0, "0c09"},
    {2, "~2d0a0421"},
    {2, "~0d2a2401"},
    {4, "2b27 0a48 084a"},
    {6, "3a34 0767"},
    {1, "1301"},
    {4, "0747"},
    {0, "0303"},
    {5, "5d01"},
    {6, "@030c6c63 254a"},
    {6, "1a3c33 1353"},
    {6, "~0a0c6c6703 0363"},
    {6, "~0a0c6c6828 ~2868630305"},
    {6, "4c0666 4c43"},
    {6, "6c0c08 ~0829696303 0304"},
    {6, "~6a6c0c06 @03096963"},
    {6, "0c6c23"},
    {6, "@181c5c58 @03086863"},
    {6, "@060c6c66 ~69630305"},
    {0, "0404 0909"},
    {1, "1401 1919"},
    {5, "5a0754"},
    {6, "0969 0565"},
    {5, "0a5704"},
    {5, "~0a0c5c582826 2323"},
    {9, "~82020c9c956569 @35396965"},
    {6, "033c63 1656"},
    {6, "2c0c0323 0828 ~2c5c5828 ~28686323"},
    {6, "~6a6c0c036365"},
    {6, "2c0c0323 ~2c6c6323"},
    {5, "5c0c0353 0848"},
    {5, "5c0c03 0848"},
    {6, "~6a6c0c036367 6747"},
    {6, "0c03 6c63 0868"},
    {4, "0c4c 2c23 0343"},
    {5, "~5c530305"},
    {6, "0c03 6c06 2863"},
    {5, "0c0353"},
    {8, "030c468c83"},
    {6, "030c636c"},
    {7, "@030c7c73"},
    {6, "2c0c03 0727 ~2c6c6727"},
    {7, "@030c7c73 4572"},
    {6, "2c0c03 0727 ~2c6c6727 2763"},
    {6, "~6a6c0c0867630305"},
    {6, "0c6c 3c33"},
    {6, "~0c03636c"},
    {6, "0c336c"},
    {8, "0c234a638c"},
    {6, "0c63 6c03"},
    {6, "0c376c 3733"},
    {6, "0c6c0363"},
    {2, "2d0d0121"},
    {5, "0d51"},
    {2, "0d2d2101"},
    {4, "092c49"},
    {6, "0161"},
    {2, "0c2a"},
    {5, "@03095953 5953"},
    {5, "0c03 @03095953"},
    {5, "~585909035354"},
    {5, "5c53 @03095953"},
    {5, "0656 ~565909035354"},
    {4, "~4c1c19 1913 0939"},
    {5, "@03095953 5953 ~53500001"},
    {5, "0c03 ~06095953"},
    {0, "0903 0c0c"},
    {2, "2922 ~222000 2c2c"},
    {5, "0c03 5904 2653"},
    {2, "0c05 ~050323"},
    {8, "0903 ~06094943 ~46498983"},
    {5, "0903 ~06095953"},
    {5, "@03095953"},
    {5, "0900 @03095953"},
    {5, "5950 @03095953"},
    {4, "0903 ~06094948"},
    {5, "~5859090656530304"},
    {4, "1c15 ~151343 0939"},
    {5, "~09035356 5953"},
    {6, "093369"},
    {8, "0923486389"},
    {5, "0953 5903"},
    {6, "0933 692100"},
    {5, "09590353"},
    {3, "~3d1d1707 ~07171131"},
    {0, "0d01"},
    {3, "~0d2d2737 ~37272101"},
    {6, "~06194568"},
});
static_assert(kGlyphs.size() == kLastGlyph - kFirstGlyph + 1);

const Glyph& glyph_of(char c) {
  return kGlyphs[static_cast<std::size_t>(c - kFirstGlyph)];
}

double digit(char c) {
  return c <= '9' ? c - '0' : c - 'a' + 10;
}

struct Line {
  Vec2 from, to;
};

// The parabola at `corner`, as chords.
void round_corner(const Vec2& before, const Vec2& corner, const Vec2& after,
                  std::vector<Line>& lines) {
  constexpr int kChords = 8;
  const Vec2 begin = 0.5 * (before + corner), end = 0.5 * (corner + after);
  Vec2 last = begin;
  for (int n = 1; n <= kChords; ++n) {
    const double t = static_cast<double>(n) / kChords, s = 1 - t;
    const Vec2 next = s * s * begin + 2 * s * t * corner + t * t * end;
    lines.push_back({last, next});
    last = next;
  }
}

void add_stroke(std::string_view stroke, std::vector<Line>& lines) {
  const char kind = stroke.front();
  if (kind == '~' || kind == '@') stroke.remove_prefix(1);
  std::vector<Vec2> points;
  for (; !stroke.empty(); stroke.remove_prefix(2)) {
    points.push_back({digit(stroke[0]), digit(stroke[1])});
  }
  const std::size_t n = points.size();
  if (kind == '@') {
    for (std::size_t i = 0; i < n; ++i) {
      round_corner(points[(i + n - 1) % n], points[i], points[(i + 1) % n], lines);
    }
    return;
  }
  const bool round = kind == '~';
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Vec2 middle = 0.5 * (points[i] + points[i + 1]);
    if (!round || i == 0) lines.push_back({points[i], round ? middle : points[i + 1]});
    if (round && i + 2 < n) round_corner(points[i], points[i + 1], points[i + 2], lines);
    if (round && i + 2 == n) lines.push_back({middle, points[i + 1]});
  }
}

std::vector<Line> lines_of(const Glyph& glyph) {
  std::vector<Line> lines;
  for (std::string_view rest = glyph.strokes; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    add_stroke(rest.substr(0, end), lines);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return lines;
}

double distance_to(const Line& line, const Vec2& p) {
  const Vec2 d = line.to - line.from;
  const double size2 = dot(d, d);
  const double t = size2 > 0 ? std::clamp(dot(p - line.from, d) / size2, 0.0, 1.0) : 0;
  const Vec2 off = p - (line.from + t * d);
  return std::sqrt(dot(off, off));
}

// The share of a pixel that the pen covers is about how far its middle is within the stroke.
void draw_glyph(Image& image, const Glyph& glyph, double left, double baseline, double unit,
                Rgb color, double strength) {
  const std::vector<Line> lines = lines_of(glyph);
  const double reach = 0.5 * std::max(kThinnest, kPen * unit);
  if (image.keeps_strokes) {
    const auto place = [&](const Vec2& p) {
      return Vec2{left + unit * p.x, baseline + unit * (kBaseline - p.y)};
    };
    for (const Line& line : lines) {
      image.strokes.push_back({place(line.from), place(line.to), 2 * reach, color, strength});
    }
    return;
  }
  const double margin = reach + 2;
  const auto draw = [&](int x, int y, Rgb& pixel) {
    const Vec2 p{(x + 0.5 - left) / unit, (baseline - y - 0.5) / unit + kBaseline};
    double nearest = margin / unit;
    for (const Line& line : lines) nearest = std::min(nearest, distance_to(line, p));
    pixel = mixed(pixel, color, strength * std::clamp(0.5 + reach - nearest * unit, 0.0, 1.0));
  };
  image.for_pixels(left - margin, baseline - 11 * unit - margin, left + glyph.width * unit + margin,
                   baseline + kBaseline * unit + margin, draw);
}

}  // namespace

bool is_drawable(std::string_view text) {
  return std::all_of(text.begin(), text.end(),
                     [](char c) { return c >= kFirstGlyph && c <= kLastGlyph; });
}

double text_width(std::string_view text, double height) {
  double units = 0;
  for (const char c : text) units += glyph_of(c).width + kGlyphGap;
  return text.empty() ? 0 : (units - kGlyphGap) * height / kCapitals;
}

void draw_text(Image& image, std::string_view text, double left, double baseline, double height,
               Rgb color, double strength) {
  DELISO_CHECK(is_drawable(text));
  const double unit = height / kCapitals;
  for (const char c : text) {
    draw_glyph(image, glyph_of(c), left, baseline, unit, color, strength);
    left += (glyph_of(c).width + kGlyphGap) * unit;
  }
}

}  // namespace deliso
