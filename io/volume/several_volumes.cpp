// SPDX-License-Identifier: MIT
#include "io/volume/several_volumes.h"

#include <limits>
#include <string_view>

#include "base/text.h"
#include "io/files/input_file.h"

namespace deliso {
namespace {

std::string counted(std::int64_t count, std::string_view noun) {
  return text(count, " ", noun, count == 1 ? "" : "s");
}

}  // namespace

VolumeChoice choose_volume(const std::string& name, const ReadOptions& options,
                           const VolumeCounts& counts, const std::string& hint) {
  struct {
    std::string_view noun;
    std::int64_t count;
    const std::optional<std::int64_t>& chosen;
    bool is_open() const { return count != 1 && !chosen; }
  } const axes[] = {{"channel", counts.channels, options.channel},
                    {"time", counts.times, options.time}};
  std::string several, switches;
  for (const auto& axis : axes) {
    if (axis.chosen && (*axis.chosen < 1 || *axis.chosen > axis.count)) {
      fail(name, "has ", counted(axis.count, axis.noun), ", and no ", axis.noun, " ", *axis.chosen);
    }
    if (!axis.is_open()) continue;
    several += text(several.empty() ? "" : " and ", counted(axis.count, axis.noun));
    switches += text(switches.empty() ? "" : " and ", "--", axis.noun, " N");
  }
  if (!several.empty()) {
    const bool is_one = axes[0].is_open() != axes[1].is_open();
    throw SeveralVolumes(counts, name,
                         text("has ", several, ": ", switches, is_one ? " chooses" : " choose",
                              " one, counted from 1", hint));
  }
  return {options.channel.value_or(1) - 1, options.time.value_or(1) - 1};
}

void set_axes(SampleGrid& grid, std::span<const DataAxis> axes, const std::string& hint) {
  using Kind = DataAxis::Kind;
  VolumeCounts counts;
  for (const DataAxis& axis : axes) {
    if (axis.kind <= Kind::z) grid.dims[static_cast<std::size_t>(axis.kind)] = axis.size;
    if (axis.kind == Kind::channel) counts.channels = axis.size;
    if (axis.kind == Kind::time) counts.times = axis.size;
  }
  data_size(grid);
  const VolumeChoice chosen = choose_volume(grid.name, grid.read, counts, hint);
  if (counts.channels == 1 && counts.times == 1) return;
  SampleGrid::Among among{.count = 1};
  constexpr std::uint64_t kMost = std::numeric_limits<std::ptrdiff_t>::max() / sizeof(double);
  for (const DataAxis& axis : axes) {
    if (axis.kind <= Kind::z) among.steps[static_cast<std::size_t>(axis.kind)] = among.count;
    if (axis.kind == Kind::channel) {
      among.first += among.count * static_cast<std::uint64_t>(chosen.channel);
    }
    if (axis.kind == Kind::time)
      among.first += among.count * static_cast<std::uint64_t>(chosen.time);
    const auto size = static_cast<std::uint64_t>(axis.size);
    if (among.count > kMost / size) {
      fail(grid.name, describe(grid), " in ", counted(counts.channels, "channel"), " and ",
           counted(counts.times, "time"), " are too many");
    }
    among.count *= size;
  }
  grid.among = among;
}

}  // namespace deliso
