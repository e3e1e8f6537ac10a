// SPDX-License-Identifier: MIT
#include "io/volume/scaled_samples.h"

#include <string>
#include <utility>

namespace deliso {
namespace {

template <class Real>
Volume scaled(const Volume& volume, double slope, double intercept) {
  const std::size_t count = volume.sample_count();
  Buffer buffer(count * sizeof(Real));
  volume.visit([&](const auto* samples) {
    write_scaled<Real>(samples, count, slope, intercept, buffer.data.get());
  });
  const Bytes bytes = bytes_of(std::move(buffer), {});
  return volume.with_samples(sample_type_of<Real>(), bytes.data.data(), bytes.owner);
}

}  // namespace

Volume scaled_volume(const VolumeInput& input, const Volume& volume, double slope,
                     double intercept) {
  const bool small = size_of(volume.type()) <= 2 || volume.type() == SampleType::f32;
  Volume result =
      small ? scaled<float>(volume, slope, intercept) : scaled<double>(volume, slope, intercept);
  input.note("rescaled", "samples are scaled as the header asks (", std::to_string(slope),
             " * sample + ", std::to_string(intercept), ") and held as ", name_of(result.type()));
  return result;
}

}  // namespace deliso
