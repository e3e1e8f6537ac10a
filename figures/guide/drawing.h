// SPDX-License-Identifier: MIT
// Diagrams as SVG 1.1: plain shapes and text, nothing to load, the same bytes for the same numbers.
// Paper coordinates are in pixels, y down; a Panel leads there from the subject's own, y up.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/vec2.h"
#include "base/vec3.h"

namespace deliso::guide {

// One style for all pictures of the guide: blue where g < kappa, orange where g >= kappa, as in
// docs/figures; Sigma is dark; what the text is about is red; what would be is dashed.
namespace ink {
inline constexpr const char* kBelow = "#dbe7f6";
inline constexpr const char* kAbove = "#fae0c4";
inline constexpr const char* kBlue = "#3b6fb6";
inline constexpr const char* kOrange = "#d9822b";
inline constexpr const char* kSigma = "#222222";
inline constexpr const char* kRed = "#c62828";
inline constexpr const char* kGreen = "#2e8b57";
inline constexpr const char* kGray = "#8a8f98";
inline constexpr const char* kLight = "#d5d8dd";
inline constexpr const char* kText = "#222222";
inline constexpr const char* kPaper = "#ffffff";
}  // namespace ink

struct Style {
  const char* stroke = nullptr;  // none
  double width = 1.5;
  const char* fill = nullptr;  // none
  bool dashed = false;
  double opacity = 1;
};

// A window of the subject's plane on the paper.
struct Panel {
  Vec2 lo{};           // of the subject, at the window's lower left corner
  double scale{};      // pixels for each of its units
  Vec2 corner{};       // of the window: upper left, in pixels
  Vec2 size{};         // in pixels
  double stretch = 1;  // of y against x

  Vec2 at(const Vec2& p) const {
    return {corner.x + scale * (p.x - lo.x), corner.y + size.y - stretch * scale * (p.y - lo.y)};
  }
  std::vector<Vec2> at(std::vector<Vec2> points) const {
    for (Vec2& p : points) p = at(p);
    return points;
  }
  std::vector<std::vector<Vec2>> at(std::vector<std::vector<Vec2>> loops) const {
    for (std::vector<Vec2>& loop : loops) loop = at(std::move(loop));
    return loops;
  }
};

// Returns p as it is seen: x to the right, y up, z towards the eye.
Vec3 turned(const Vec3& p, double yaw, double pitch);

enum class Anchor { start, middle, end };

class Drawing {
 public:
  // `ground`: the color of the paper; nullptr: what is behind the picture shows.
  Drawing(double width, double height, const char* ground = ink::kPaper);

  void line(const Vec2& a, const Vec2& b, const Style& style);
  void polyline(std::span<const Vec2> points, const Style& style);
  void polygon(std::span<const Vec2> points, const Style& style);
  // Inside is where a ray crosses the loops an odd number of times.
  void region(std::span<const std::vector<Vec2>> loops, const Style& style);
  void rectangle(const Vec2& corner, const Vec2& size, const Style& style);
  void circle(const Vec2& center, double radius, const Style& style);
  void dot(const Vec2& at, const char* color, double radius = 4);
  void arrow(const Vec2& from, const Vec2& to, const Style& style);
  // Text stands on `at`. A halo keeps it legible on what it lies over.
  void text(const Vec2& at, std::string_view words, Anchor anchor = Anchor::start, double size = 13,
            const char* color = ink::kText, bool bold = false);
  // Until the next call nothing is drawn outside of the window; none: everywhere.
  void clip_to(const Panel& panel);
  void clip_nowhere();
  // The window's outline, and its title above; ends clip_to().
  void frame(const Panel& panel, std::string_view title);

  // The whole picture, to FOLDER/NAME.svg.
  void write(const std::string& folder, const std::string& name) const;

 private:
  void attributes(const Style& style);

  double width_, height_;
  std::string body_;
  int clips_ = 0;
  bool clipped_ = false;
};

}  // namespace deliso::guide
