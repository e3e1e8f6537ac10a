// SPDX-License-Identifier: MIT
#include "app/bring_home.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "base/text.h"
#include "check/verify.h"
#include "exact/predicates.h"
#include "io/files/text_scan.h"
#include "io/mesh/to_float.h"

namespace deliso {
namespace {

// Errors above this many voxels, a tenth of a perturbation, may be more than what keeps vertices
// off the box on purpose: then they bring only ends to it.
constexpr double kFineVoxels = 1e-8;
// The largest error that brings an end to the box: beyond, no digit tells where the box is.
constexpr double kCoarseVoxels = 0.5;

// Numbers of at least so many digits are doubles; those of nine at most may be floats; and those of
// fewer than five were not rounded to them, but are as simple as that.
constexpr int kDigitsOfDoubles = 15, kDigitsOfFloats = 9, kFewestDigits = 5;

double largest_coordinate(const std::vector<Vec3>& points) {
  double largest = 0;
  for (const Vec3& p : points) {
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  }
  return largest;
}

// The decimal with the fewest digits that no other double is nearer to.
struct Decimal {
  int digits = 0, exponent = 0;  // d.ddd * 10^exponent
};
Decimal decimal_of(double x) {
  char words[32];
  const auto end = std::to_chars(words, words + sizeof words, x, std::chars_format::scientific).ptr;
  const std::string_view all(words, end);
  const std::size_t e = all.find('e');
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return {static_cast<int>(std::ranges::count_if(all.substr(0, e), is_digit)),
          number_in<int>(all.substr(e + 1)).value_or(0)};
}

// Returns the most digits of a coordinate, or kDigitsOfDoubles if there are as many.
int digits_of_all(const std::vector<Vec3>& points) {
  int most = 0;
  for (const Vec3& p : points) {
    for (int axis = 0; axis < 3 && most < kDigitsOfDoubles; ++axis) {
      most = std::max(most, decimal_of(p[axis]).digits);
    }
    if (most >= kDigitsOfDoubles) return kDigitsOfDoubles;
  }
  return most;
}

// Returns half a unit of the last of n digits of x.
double half_digit(double x, int n) {
  return x == 0 ? 0 : to_double(text("5e", decimal_of(x).exponent - n)).value_or(0);
}

// True if x is a float, or what a text has for one: the decimal with the fewest digits that is
// nearest to this float and to no other, or that of `digits` digits.
bool is_float(double x, int digits) {
  if (to_float(x) == x) return true;
  if (digits > kDigitsOfFloats) return false;
  if (std::fabs(to_float(x) - x) <= half_digit(x, digits)) return true;
  char words[32];
  const std::to_chars_result end =
      std::to_chars(words, words + sizeof words, static_cast<float>(x));
  return to_double({words, end.ptr}) == x;
}

// Returns the largest change of a coordinate at home by one of 1 along every axis of the world. It
// is 1 for axes along those of the world.
double stretch_of(Frame at) {
  at.origin = {};
  Vec3 sum;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 unit;
    unit[axis] = 1;
    const Vec3 home = at.from_world(unit);
    for (int n = 0; n < 3; ++n) sum[n] += std::fabs(home[n]);
  }
  return std::max({sum.x, sum.y, sum.z});
}

// Puts vertices back on the faces of the box that rounding moved them off. Lengths in the scaled
// frame.
class FacesOfBox {
 public:
  FacesOfBox(TriMesh& mesh, const Box3& box) : mesh_(mesh), box_(box) {
    is_end_.assign(mesh.points.size(), 0);
    for (const Face& face : mesh.faces) {
      for (int side = 0; side < 3; ++side) {
        if (face.n[side] != kNoId) continue;
        is_end_[face.v[(side + 1) % 3]] = is_end_[face.v[(side + 2) % 3]] = 1;
      }
    }
    if (std::ranges::count(is_end_, 1) == 0) std::ranges::fill(is_end_, 1);
  }

  // H1 and H2. `errors`: that of doubles, and that of the digits.
  void settle(const std::array<double, 2>& errors, double tolerance) {
    for (int face = 0; face < 6; ++face) {
      const int axis = face / 2;
      const bool high = face % 2 == 1;
      const double at = (high ? box_.hi : box_.lo)[axis];
      const double reach = reach_at(axis, at, errors, tolerance);
      for (VertexId v = 0; v < mesh_.points.size(); ++v) {
        double& x = mesh_.points[v][axis];
        const double outside = high ? x - at : at - x;
        // The nearer of two faces, where the tolerance is as large as the box.
        const bool is_nearer = std::fabs(x - at) <= 0.5 * box_.size()[axis];
        const bool is_near =
            is_nearer && std::fabs(x - at) <= (is_end_[v] != 0 ? reach : errors[0]);
        if (is_near || (outside > 0 && outside <= tolerance)) x = at;
      }
    }
  }

 private:
  // Returns from how far ends come to the plane: the least of the errors and the tolerance that has
  // most of those within the tolerance.
  double reach_at(int axis, double at, const std::array<double, 2>& errors,
                  double tolerance) const {
    const auto within = [&](double reach) {
      std::size_t count = 0;
      for (VertexId v = 0; v < mesh_.points.size(); ++v) {
        count += is_end_[v] != 0 && std::fabs(mesh_.points[v][axis] - at) <= reach;
      }
      return count;
    };
    const std::size_t all = within(tolerance);
    for (const double reach : errors) {
      if (2 * within(reach) > all) return reach;
    }
    return tolerance;
  }

  TriMesh& mesh_;
  const Box3 box_;
  std::vector<std::uint8_t> is_end_;
};

}  // namespace

DigitsOfPoints digits_of(const std::vector<Vec3>& points) {
  const int digits = digits_of_all(points);
  DigitsOfPoints found;
  found.is_single = std::ranges::all_of(points, [&](const Vec3& p) {
    return is_float(p.x, digits) && is_float(p.y, digits) && is_float(p.z, digits);
  });
  const double largest = largest_coordinate(points);
  if (digits < kDigitsOfDoubles) {
    found.error = half_digit(largest, std::max(digits, kFewestDigits));
  }
  if (found.is_single) {
    constexpr double kFloatRounding = std::numeric_limits<float>::epsilon();
    found.error = std::max(found.error, kFloatRounding * largest);
  }
  return found;
}

void drop_smallest(std::vector<Vec3>& points) {
  for (Vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::fabs(p[axis]) < kSmallestCoordinate) p[axis] = 0;
    }
  }
}

double bring_home(TriMesh& mesh, const Grid& volume, double rounding, double stated) {
  const Frame at = volume.frame().in_space(mesh.frame.space);
  const Box3 box = volume.box();
  const DigitsOfPoints digits = digits_of(mesh.points);
  const double largest =
      std::max({largest_coordinate(mesh.points), largest_coordinate({at.origin, box.lo, box.hi})});
  for (Vec3& p : mesh.points) p = at.from_world(p);  // exact where the frames are the same
  // To the world, rounded there, and back.
  const double stretch = stretch_of(at);
  const double of_doubles = 16 * std::numeric_limits<double>::epsilon() * largest * stretch;
  const double error = of_doubles + stretch * (rounding + digits.error);
  const double voxel = volume.voxel(), coarse = kCoarseVoxels * voxel;
  const double tolerance = std::max(kToleranceVoxels * voxel + 2 * error, stated);

  const double fine = of_doubles <= kFineVoxels * voxel ? of_doubles : 0;
  FacesOfBox(mesh, volume.box())
      .settle({fine, std::min(error, coarse)}, std::max(std::min(tolerance, coarse), stated));
  drop_smallest(mesh.points);
  if (at.left_handed()) {
    for (Face& face : mesh.faces) {
      std::swap(face.v[1], face.v[2]);
      std::swap(face.n[1], face.n[2]);
    }
  }
  return tolerance;
}

}  // namespace deliso
