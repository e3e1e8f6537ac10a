// SPDX-License-Identifier: MIT
#include "volume/grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.h"

namespace deliso {

void require_in_range(Index3 dims, const Vec3& spacing, const Frame& frame, std::string_view name) {
  for (int axis = 0; axis < 3; ++axis) {
    const double s = spacing[axis];
    const std::string_view along =
        std::string_view("xyz").substr(static_cast<std::size_t>(axis), 1);
    if (dims[axis] < 1) {
      throw InputError(name, ": has ", dims[axis], " samples along ", along);
    }
    if (!(s >= kSmallestSpacing && s * dims[axis] <= kLargestLength)) {
      throw InputError(name, ": spacing ", s, " along ", along, " is out of range (from ",
                       kSmallestSpacing, ", and to a box of ", kLargestLength, ")");
    }
  }
  if (!in_range(frame.origin)) {
    throw InputError(name, ": its origin is further than ", kLargestLength, " away");
  }
  for (const Vec3& axis : frame.axes) {
    constexpr double kTolerance = 1e-6;
    if (!(std::fabs(length(axis) - 1) <= kTolerance)) {
      throw InputError(name, ": an axis of its frame is no unit vector");
    }
  }
}

double median_gap(const std::vector<double>& places) {
  std::vector<double> gaps;
  for (std::size_t n = 1; n < places.size(); ++n) gaps.push_back(places[n] - places[n - 1]);
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>((gaps.size() - 1) / 2);
  std::ranges::nth_element(gaps, middle);
  return *middle;
}

Grid Grid::with_places(Coordinates places, std::string_view name) const {
  Grid grid = *this;
  bool any = false;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double>& at = places[axis];
    if (at.empty()) continue;
    any = true;
    const std::string_view along =
        std::string_view("xyz").substr(static_cast<std::size_t>(axis), 1);
    if (at.size() != static_cast<std::size_t>(dims_[axis]) || at.size() < 2) {
      throw InputError(name, ": has ", dims_[axis], " samples along ", along, ", and ", at.size(),
                       at.size() == 1 ? " coordinate" : " coordinates");
    }
    double& least = grid.least_spacing_[axis] = at[1] - at[0];
    for (std::size_t n = 1; n < at.size(); ++n) {
      const double gap = at[n] - at[n - 1];
      if (!(gap >= kSmallestSpacing)) {
        throw InputError(name, ": its coordinates along ", along, " do not increase at sample ", n);
      }
      least = std::min(least, gap);
    }
    if (!(at[0] == 0 && at.back() <= kLargestLength)) {
      throw InputError(name, ": its coordinates along ", along, " are out of range");
    }
  }
  if (any) grid.places_ = std::make_shared<const Coordinates>(std::move(places));
  return grid;
}

Grid Grid::cropped(Index3 first, Index3 dims) const {
  Frame frame = frame_;
  frame.origin = frame.to_world(position(first));
  const Grid grid(dims, spacing_, type_, frame);
  Coordinates cropped;
  for (int axis = 0; axis < 3; ++axis) {
    const double* at = places(axis);
    for (int n = 0; at && n < dims[axis]; ++n) {
      cropped[axis].push_back(at[first[axis] + n] - at[first[axis]]);
    }
  }
  return grid.with_places(std::move(cropped), "volume");
}

double Grid::between_places(const double* at, double x, int axis) const {
  const int n = gap_at(at, dims_[axis], x);
  return first_[axis] + (n + (x - at[n]) / (at[n + 1] - at[n]));
}

double Grid::at_between_places(const double* at, double u, int axis) const {
  const int n = static_cast<int>(std::clamp(std::floor(u) - first_[axis], 0.0, dims_[axis] - 2.0));
  const double share = u - (first_[axis] + n);
  if (share == 1) return at[n + 1];
  const double x = at[n] + share * (at[n + 1] - at[n]);
  return share < 1 ? std::min(x, at[n + 1]) : x;
}

double Grid::share_of(int axis, int begin, int end) const {
  const double* at = places(axis);
  const int count = dims_[axis];
  if (!at) return end - begin - (begin == 0 ? 0.5 : 0) - (end == count ? 0.5 : 0);
  // The border before a sample.
  const auto border = [&](int n) {
    return (at[std::max(n - 1, 0)] + at[std::min(n, count - 1)]) / 2;
  };
  return (border(end) - border(begin)) / spacing_[axis];
}

bool Grid::is_on_plane(const Vec3& p, int axis) const {
  const double* at = places(axis);
  if (at) return std::binary_search(at, at + dims_[axis], p[axis]);
  return std::round(p[axis] / spacing_[axis]) * spacing_[axis] == p[axis];
}

unsigned Grid::inner_faces() const {
  unsigned faces = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (first_[axis] > 0) faces |= 1u << (2 * axis);
    if (first_[axis] + dims_[axis] < whole_[axis]) faces |= 2u << (2 * axis);
  }
  return faces;
}

namespace {

// Returns the side of the cube that is as large as a box of these sides.
double side_of_cube(const Vec3& sides) {
  const auto [x, y, z] = sides;
  if (x == y && y == z) return x;
  // Newton's method from above, the same bits on every machine, which cbrt() need not give.
  double side = std::max({x, y, z});
  for (;;) {
    const double next = (2 * side + x / side * y / side * z) / 3;
    if (!(next < side)) return side;
    side = next;
  }
}

}  // namespace

double Grid::voxel() const {
  return side_of_cube(spacing_);
}
double Grid::least_voxel() const {
  return side_of_cube(least_spacing_);
}

Box3 Grid::box() const {
  return {position({0, 0, 0}), position(voxels())};
}

Box3 Grid::within() const {
  constexpr double kRounding = 0x1p-46, kMostVoxels = 1e-3;
  const Vec3 far = whole().box().hi, &origin = frame_.origin;
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    largest = std::max({largest, far[axis], std::fabs(origin[axis])});
  }
  const Vec3& s = least_spacing_;
  return box().grown(-std::min(kRounding * largest, kMostVoxels * std::min({s.x, s.y, s.z})));
}

Index3 Grid::voxel_at(const Vec3& p) const {
  Index3 voxel;
  for (int axis = 0; axis < 3; ++axis) {
    const double u = in_samples(p, axis);
    const int last = std::max(dims_[axis] - 2, 0);
    voxel[axis] = u > 0 ? static_cast<int>(std::min(u, static_cast<double>(last))) : 0;
  }
  return voxel;
}

}  // namespace deliso
