// SPDX-License-Identifier: MIT
#include "io/filter/nan_samples.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "io/files/input_file.h"

namespace deliso {

Volume without_nan(const Volume& volume, double value, std::uint64_t& count) {
  return volume.visit([&](const auto* samples) {
    using T = std::remove_cvref_t<decltype(*samples)>;
    if constexpr (std::is_floating_point_v<T>) {
      const auto is_nan = [](T sample) { return std::isnan(sample); };
      const T* const end = samples + volume.sample_count();
      const auto found = std::count_if(samples, end, is_nan);
      count += static_cast<std::uint64_t>(found);
      if (found > 0) {
        Buffer buffer(sizeof(T) * volume.sample_count());
        std::replace_copy_if(samples, end, reinterpret_cast<T*>(buffer.data.get()), is_nan,
                             static_cast<T>(value));
        const Bytes bytes = bytes_of(std::move(buffer), {});
        return volume.with_samples(volume.type(), bytes.data.data(), bytes.owner);
      }
    }
    return volume;
  });
}

}  // namespace deliso
