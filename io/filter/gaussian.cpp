// SPDX-License-Identifier: MIT
#include "io/filter/gaussian.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/elementary.h"
#include "base/parallel.h"
#include "io/files/input_file.h"
#include "io/filter/reflect.h"

namespace deliso {
namespace {

constexpr std::size_t kSlicesOfTask = 8;  // they share a thread's buffers

// The weights at distances 0, 1, ... A row has their sum 1.
std::vector<double> half_kernel(double sigma) {
  std::vector<double> weights{1};
  double sum = 1;
  for (int d = 1; d <= gaussian_radius(sigma); ++d) {
    weights.push_back(exponential(-0.5 * d * d / (sigma * sigma)));
    sum += 2 * weights.back();
  }
  for (double& w : weights) w /= sum;
  return weights;
}

// Sets `to` to a weighted sum of rows of its length. row_at(d) is the row at distance d, of any
// sign.
template <class RowAt>
void add_rows(const std::vector<double>& kernel, std::span<double> to, RowAt&& row_at) {
  const auto* middle = row_at(0);
  for (std::size_t n = 0; n < to.size(); ++n) to[n] = kernel[0] * static_cast<double>(middle[n]);
  for (std::size_t d = 1; d < kernel.size(); ++d) {
    const auto *before = row_at(-static_cast<int>(d)), *after = row_at(static_cast<int>(d));
    const double weight = kernel[d];
    for (std::size_t n = 0; n < to.size(); ++n) {
      to[n] += weight * (static_cast<double>(before[n]) + static_cast<double>(after[n]));
    }
  }
}

// One slice at a time: along z from the samples into `slice_`, then row by row along y and x.
template <class T, class Out>
class SliceFilter {
 public:
  SliceFilter(const T* samples, Index3 dims, const std::array<std::vector<double>, 3>& kernels)
      : samples_(samples),
        dims_(dims),
        kernels_(kernels),
        nx_(static_cast<std::size_t>(dims.i)),
        slice_(nx_ * static_cast<std::size_t>(dims.j)),
        padded_(nx_ + 2 * (kernels[0].size() - 1)),
        row_(nx_) {}

  void run(int k, Out* to) {
    for (int j = 0; j < dims_.j; ++j) {
      add_rows(kernels_[2], {slice_row(j), nx_}, [&](int d) {
        return samples_ + (static_cast<std::size_t>(reflected(k + d, dims_.k)) * slice_.size() +
                           static_cast<std::size_t>(j) * nx_);
      });
    }
    const std::size_t radius = kernels_[0].size() - 1;
    double* const first = padded_.data() + radius;
    for (int j = 0; j < dims_.j; ++j, to += nx_) {
      add_rows(kernels_[1], {first, nx_},
               [&](int d) { return slice_row(reflected(j + d, dims_.j)); });
      for (std::size_t n = 1; n <= radius; ++n) {
        const int before = -static_cast<int>(n), after = dims_.i - 1 + static_cast<int>(n);
        first[before] = first[reflected(before, dims_.i)];
        first[after] = first[reflected(after, dims_.i)];
      }
      add_rows(kernels_[0], row_, [&](int d) { return first + d; });
      for (std::size_t n = 0; n < nx_; ++n) to[n] = static_cast<Out>(row_[n]);
    }
  }

 private:
  double* slice_row(int j) { return slice_.data() + static_cast<std::size_t>(j) * nx_; }

  const T* samples_;
  Index3 dims_;
  const std::array<std::vector<double>, 3>& kernels_;
  std::size_t nx_;
  std::vector<double> slice_, padded_, row_;
};

// True of types whose samples float32 does not round.
template <class T>
constexpr bool kFitsFloat = sizeof(T) < 4 || std::is_same_v<T, float>;

template <class T, class Out>
Volume filtered(const Volume& volume, const T* samples, const Vec3& sigma, int threads) {
  const Index3 dims = volume.dims();
  const std::array<std::vector<double>, 3> kernels{half_kernel(sigma.x), half_kernel(sigma.y),
                                                   half_kernel(sigma.z)};
  const std::size_t slice = static_cast<std::size_t>(dims.i) * static_cast<std::size_t>(dims.j);
  Buffer buffer(sizeof(Out) * volume.sample_count());
  Out* const out = reinterpret_cast<Out*>(buffer.data.get());
  for_each_run(threads, static_cast<std::size_t>(dims.k), kSlicesOfTask,
               [&](std::size_t begin, std::size_t end) {
                 SliceFilter<T, Out> filter(samples, dims, kernels);
                 for (std::size_t k = begin; k < end; ++k) {
                   filter.run(static_cast<int>(k), out + k * slice);
                 }
               });
  const Bytes bytes = bytes_of(std::move(buffer), {});
  return volume.with_samples(sample_type_of<Out>(), bytes.data.data(), bytes.owner);
}

}  // namespace

int gaussian_radius(double sigma) {
  return static_cast<int>(std::lround(kGaussianReach * sigma));
}

Volume gaussian(const Volume& volume, const Vec3& sigma, int threads) {
  return volume.visit([&]<class T>(const T* samples) {
    return filtered<T, std::conditional_t<kFitsFloat<T>, float, double>>(volume, samples, sigma,
                                                                         threads);
  });
}

SampleType gaussian_type(SampleType type) {
  return with_type(type,
                   []<class T>(T) { return kFitsFloat<T> ? SampleType::f32 : SampleType::f64; });
}

}  // namespace deliso
