// SPDX-License-Identifier: MIT
// Writes a NIfTI volume that is turned and shifted in the world. Usage: rotated_nifti FILE
#include <cmath>
#include <fstream>

#include "io/volume/volume_files.h"
#include "volume/sampled.h"

using namespace deliso;

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  constexpr int kSide = 20;
  constexpr double kAngle = 0.7;
  test::Truth truth{{kSide, kSide, kSide}, SampleType::u8};
  truth.spacing = {0.5, 0.75, 1.25};
  truth.origin = {-31, 17, 140};
  const double c = std::cos(kAngle), s = std::sin(kAngle);
  truth.axes = {Vec3{c, s, 0}, Vec3{-s * c, c * c, s}, Vec3{s * s, -s * c, c}};
  for_each_index({kSide, kSide, kSide}, [&](int i, int j, int k) {
    const double r = distance(Vec3{1.0 * i, 1.0 * j, 1.0 * k}, {9, 10, 9.5});
    truth.bytes += static_cast<char>(static_cast<unsigned char>(240 - 20 * r));
  });
  std::ofstream(argv[1], std::ios::binary) << test::nifti(truth, {})[0].content;
  return 0;
}
