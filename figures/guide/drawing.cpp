// SPDX-License-Identifier: MIT
#include "guide/drawing.h"

#include <cmath>

#include "io/files/append_format.h"
#include "io/files/atomic_file.h"
#include "support/line_chart.h"

namespace deliso::guide {
namespace {

void append_path(std::string& out, std::span<const Vec2> points) {
  for (std::size_t n = 0; n < points.size(); ++n) {
    append_format(out, "%s%.1f %.1f", n == 0 ? "M" : "L", points[n].x, points[n].y);
  }
}

}  // namespace

Vec3 turned(const Vec3& p, double yaw, double pitch) {
  const double across = std::cos(yaw) * p.x - std::sin(yaw) * p.y,
               deep = std::sin(yaw) * p.x + std::cos(yaw) * p.y;
  return {across, std::cos(pitch) * p.z + std::sin(pitch) * deep,
          std::sin(pitch) * p.z - std::cos(pitch) * deep};
}

Drawing::Drawing(double width, double height, const char* ground) : width_(width), height_(height) {
  rectangle({0, 0}, {width, height}, {.fill = ground});
}

void Drawing::attributes(const Style& style) {
  append_format(body_, " fill=\"%s\"", style.fill ? style.fill : "none");
  if (style.stroke)
    append_format(body_, " stroke=\"%s\" stroke-width=\"%g\"", style.stroke, style.width);
  if (style.dashed) body_ += " stroke-dasharray=\"5 4\"";
  if (style.opacity < 1) append_format(body_, " opacity=\"%g\"", style.opacity);
  body_ += "/>\n";
}

void Drawing::line(const Vec2& a, const Vec2& b, const Style& style) {
  const Vec2 both[] = {a, b};
  polyline(both, style);
}

void Drawing::polyline(std::span<const Vec2> points, const Style& style) {
  body_ += "<path d=\"";
  append_path(body_, points);
  body_ += "\" stroke-linejoin=\"round\" stroke-linecap=\"round\"";
  attributes(style);
}

void Drawing::polygon(std::span<const Vec2> points, const Style& style) {
  body_ += "<path d=\"";
  append_path(body_, points);
  body_ += "Z\" stroke-linejoin=\"round\"";
  attributes(style);
}

void Drawing::region(std::span<const std::vector<Vec2>> loops, const Style& style) {
  body_ += "<path d=\"";
  for (const std::vector<Vec2>& loop : loops) {
    append_path(body_, loop);
    body_ += "Z";
  }
  body_ += "\" fill-rule=\"evenodd\" stroke-linejoin=\"round\"";
  attributes(style);
}

void Drawing::rectangle(const Vec2& corner, const Vec2& size, const Style& style) {
  append_format(body_, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"", corner.x,
                corner.y, size.x, size.y);
  attributes(style);
}

void Drawing::circle(const Vec2& center, double radius, const Style& style) {
  append_format(body_, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\"", center.x, center.y, radius);
  attributes(style);
}

void Drawing::dot(const Vec2& at, const char* color, double radius) {
  circle(at, radius, {.stroke = ink::kPaper, .width = 1, .fill = color});
}

void Drawing::arrow(const Vec2& from, const Vec2& to, const Style& style) {
  const Vec2 d = to - from;
  const double length = std::sqrt(deliso::dot(d, d));
  if (!(length > 0)) return;
  const Vec2 along = (1 / length) * d, across{-along.y, along.x};
  const Vec2 base = to - 9.0 * along;
  line(from, base, style);
  const Vec2 head[] = {to, base + 4.0 * across, base - 4.0 * across};
  polygon(head, {.fill = style.stroke});
}

void Drawing::text(const Vec2& at, std::string_view words, Anchor anchor, double size,
                   const char* color, bool bold) {
  const char* const names[] = {"start", "middle", "end"};
  append_format(body_,
                "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%g\" text-anchor=\"%s\" fill=\"%s\"%s "
                "stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" "
                "paint-order=\"stroke\">",
                at.x, at.y, size, names[static_cast<int>(anchor)], color,
                bold ? " font-weight=\"bold\"" : "");
  body_ += svg_escaped(words) + "</text>\n";
}

void Drawing::clip_to(const Panel& panel) {
  clip_nowhere();
  append_format(body_,
                "<clipPath id=\"c%d\"><rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" "
                "height=\"%.1f\"/></clipPath>\n<g clip-path=\"url(#c%d)\">\n",
                clips_, panel.corner.x, panel.corner.y, panel.size.x, panel.size.y, clips_);
  ++clips_;
  clipped_ = true;
}

void Drawing::clip_nowhere() {
  if (clipped_) body_ += "</g>\n";
  clipped_ = false;
}

void Drawing::frame(const Panel& panel, std::string_view title) {
  clip_nowhere();
  rectangle(panel.corner, panel.size, {.stroke = ink::kGray, .width = 1});
  text({panel.corner.x, panel.corner.y - 9}, title, Anchor::start, 13, ink::kText, true);
}

void Drawing::write(const std::string& folder, const std::string& name) const {
  std::string out;
  append_format(out,
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" viewBox=\"0 "
                "0 %g %g\" font-family=\"sans-serif\">\n",
                width_, height_, width_, height_);
  out += body_ + (clipped_ ? "</g>\n" : "") + "</svg>\n";
  AtomicFile file(folder + "/" + name + ".svg");
  file.write(out);
  file.commit();
}

}  // namespace deliso::guide
