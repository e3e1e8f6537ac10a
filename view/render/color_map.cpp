// SPDX-License-Identifier: MIT
#include "view/render/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace deliso {
namespace {

// Even steps through OKLCH (Ottosson 2020): lightness 0.40 to 0.95, hue 292 to 105 degrees, chroma
// 0.17 or what sRGB has of it.
constexpr std::array<Rgb, 9> kSequence = {{{78, 41, 153},
                                           {52, 78, 184},
                                           {0, 115, 183},
                                           {11, 144, 177},
                                           {6, 172, 177},
                                           {1, 200, 167},
                                           {92, 224, 137},
                                           {182, 237, 106},
                                           {255, 244, 101}}};

// Okabe and Ito (2008): seven hues that stay apart for readers who lack a kind of cones.
constexpr std::array<Rgb, kCategories> kKinds = {{{86, 180, 233},
                                                  {230, 159, 0},
                                                  {0, 158, 115},
                                                  {204, 121, 167},
                                                  {0, 114, 178},
                                                  {240, 228, 66},
                                                  {213, 94, 0}}};

}  // namespace

Rgb sequential_color(double share) {
  constexpr std::size_t kLast = kSequence.size() - 1;
  if (!(share < 1)) return kSequence[kLast];
  const double place = std::max(0.0, share) * kLast;
  const auto n = static_cast<std::size_t>(place);
  return mixed(kSequence[n], kSequence[n + 1], place - static_cast<double>(n));
}

Rgb category_color(std::size_t number) {
  const Rgb kind = kKinds[number % kCategories];
  if (number < kCategories) return kind;
  // Towards black or white; by golden sections, so that none of hundreds is like another.
  constexpr double kGolden = 0.6180339887498949, kMost = 1.2;
  const std::size_t times = number / kCategories;
  const double turns = kGolden * static_cast<double>(times);
  const double shade = turns - std::floor(turns) - 0.5;
  return mixed(kind, shade < 0 ? Rgb{0, 0, 0} : Rgb{255, 255, 255}, kMost * std::fabs(shade));
}

}  // namespace deliso
