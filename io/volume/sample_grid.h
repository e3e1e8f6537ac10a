// SPDX-License-Identifier: MIT
// The content of every volume header: the number, type and places of the samples. These functions
// make a Volume from it and the bytes of the data. A format's reader only fills in a SampleGrid and
// finds the bytes. All checks that do not depend on the format are here.
//
// 1. Memory for samples is allocated only after the data is known to be long enough.
// 2. Bytes are not copied if they are in native order, aligned for their type, and cropped to whole
//    slices at most. The Volume refers to them and keeps their owner alive.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/vec3.h"
#include "io/files/inflate.h"
#include "io/files/input_file.h"
#include "io/volume/read_volume.h"
#include "volume/volume.h"

namespace deliso {

// The largest cosine of two axes that are taken to be at right angles.
constexpr double kShearTolerance = 1e-4;
// Axes that are less apart are those of no image: of the volume of their unit vectors.
constexpr double kLeastDeterminant = 0.1;

struct SampleGrid {
  std::string name;         // of the input, for messages
  ReadOptions read{};       // the region, and the place if it is not the file's
  bool is_of_file = false;  // so messages may name the options
  ReadLog* log = nullptr;   // for notes, and ids of 64 bits
  std::array<std::int64_t, 3> dims{0, 0, 0};
  StoredType type = SampleType::u8;
  std::endian byte_order = std::endian::native;
  // World position of sample (0,0,0), and the step between samples along each file axis.
  Vec3 origin{0, 0, 0};
  std::array<Vec3, 3> steps{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  // Of samples along an axis whose steps are not even, from the first one, in the steps' unit of
  // length; the step then has the direction alone.
  Coordinates places{};
  AnatomicalSpace space = AnatomicalSpace::unknown;

  // The place of a grid in data that holds more, counted in samples: sample (i, j, k) is
  // first + i * steps[0] + j * steps[1] + k * steps[2] of count.
  struct Among {
    std::uint64_t first = 0;
    std::array<std::uint64_t, 3> steps{};
    std::uint64_t count = 0;  // its bytes fit the address space, whatever the type
  };
  std::optional<Among> among{};

  // Returns the dimensions. pre: data_size() has accepted them.
  Index3 size() const {
    return {static_cast<int>(dims[0]), static_cast<int>(dims[1]), static_cast<int>(dims[2])};
  }
  // Steps along the world's axes, by the file's `own` spacing or, where that is not positive, by
  // the one that is given. Spacings are checked later, with the steps.
  void set_spacing(const Vec3& own);
  // Puts samples at these coordinates along an axis, whose step then has the direction alone.
  void set_coordinates(std::size_t axis, std::span<const double> at);
};

// Ends of messages about a place that is missing or bad: which option gives it.
inline constexpr const char *kGiveSpacing = ": --spacing SX,SY,SZ gives it",
                            *kGiveOrigin = ": --origin X,Y,Z gives it";

// True if all steps have a length, and so a direction. Without one a spacing must be given, and the
// axes are the world's.
bool has_directions(const SampleGrid& grid);

// Reverses the bytes of each word of 2, 4 or 8 bytes.
void swap_bytes(std::span<std::byte> bytes, std::size_t word_size);

// All of these throw InputErrors with the name of the grid or, if the bytes are at fault, of the
// bytes.

// Returns the bytes of the data. Checks the dimensions (2 or more each) and that the sizes fit the
// address space.
std::uint64_t data_size(const SampleGrid& grid);
// Returns "64 x 64 x 32 uint16 samples" or the like, for messages.
std::string describe(const SampleGrid& grid);

// Returns the data behind `skip` bytes, or if that is -1 the samples at its end. `which`: these
// bytes, for a message.
Bytes data_behind(const SampleGrid& grid, const Bytes& data, std::int64_t skip, const char* which);

// Returns the grid of the volume, of which the samples are elsewhere. pre: of no wide type.
Grid grid_of_volume(const SampleGrid& grid);
// Returns the volume. `data` has exactly the samples, with those that the grid is among.
Volume volume_from_raw(const SampleGrid& grid, const Bytes& data);
// Returns the volume. `data` has the samples as numbers in text, and nothing after them unless
// `more_may_follow`.
Volume volume_from_text(const SampleGrid& grid, const Bytes& data, bool more_may_follow);
// Returns the volume. `data` has `skip` bytes and then exactly the samples, compressed.
Volume volume_from_compressed(const SampleGrid& grid, const Bytes& data, Wrapping wrapping,
                              std::uint64_t skip);
// Returns the first bytes of a file, or of what gzip compressed as a whole: `count`, or all if
// there are fewer.
Bytes start_of(const Bytes& bytes, std::size_t count);
// Returns the volume of such a file. Its samples follow `skip` bytes, to the end.
Volume volume_behind(const SampleGrid& grid, const Bytes& bytes, std::uint64_t skip);
// Returns the volume. `write_slice(k, out)` fills `out` with the samples of slice k, in native
// order. It is called for the slices of the grid's region only; the others take no memory. pre: the
// data of all slices is known to exist, and the grid is not among others.
Volume volume_from_slices(
    const SampleGrid& grid,
    const std::function<void(std::size_t k, std::span<std::byte> out)>& write_slice);

}  // namespace deliso
