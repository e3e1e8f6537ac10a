// SPDX-License-Identifier: MIT
// Where does a ray meet the isosurface in a voxel? Along a line the trilinear interpolant of the
// voxel's eight samples is a cubic (paper, section 4.2); its roots in the voxel are the points.
// Usage: ray_in_voxel
#include <iostream>
#include <vector>

#include "deliso/isosurface/voxel_ray.h"
#include "deliso/roots/cubic.h"
#include "deliso/volume/volume.h"

int main() {
  // Samples at the corners of the unit cube, x fastest, and the isovalue.
  const std::vector<double> samples{-1, 8, 8, -8, 8, -8, -8, 2};
  const double isovalue = 0.5;
  const deliso::Volume volume = deliso::Volume::from_samples({2, 2, 2}, {1, 1, 1}, samples);

  // The ray, from where it enters the voxel to where it leaves it: its diagonal, nearly.
  const deliso::Vec3 enters{0, 0.05, 0.1}, leaves{1, 0.95, 0.9};

  // In Bernstein form, so that the first and last coefficient are the values at the ends and the
  // cubic lies between the smallest and the largest: all of one sign, and there is no root.
  deliso::Corners corners = volume.corners({0, 0, 0});
  for (double& corner : corners) corner -= isovalue;
  const deliso::Cubic cubic = deliso::patch_along(corners, enters, leaves);
  std::cout << "Bernstein coefficients:";
  for (const double b : cubic) std::cout << " " << b;
  std::cout << "\n";

  // Two solvers, one answer: in closed form (Schwarze 1990, the paper's choice), and by isolation
  // between the extrema (Marmitt and others 2004, the default).
  for (const auto method : {deliso::CubicMethod::schwarze, deliso::CubicMethod::isolation}) {
    std::cout << (method == deliso::CubicMethod::schwarze ? "Schwarze" : "isolation") << ":\n";
    for (const double t : deliso::crossings(cubic, method)) {
      const deliso::Vec3 p = enters + t * (leaves - enters);
      std::cout << "  t = " << t << " at (" << p.x << " " << p.y << " " << p.z
                << "), where the interpolant is " << volume.value(p) << "\n";
    }
  }
}
