// SPDX-License-Identifier: MIT
// What the storms share: the command line [--first-seed N] [--count M] [--list], and how they tell.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <span>
#include <string_view>

#include "base/text.h"

namespace deliso::stress {

struct Seeds {
  std::uint64_t first, count;
  bool list;  // every seed with a fault, not only how many
};

// Returns seeds 1 to `count` if nothing else is asked for; nullopt for an unknown option, after a
// line on stderr.
inline std::optional<Seeds> parse_seeds(int argc, char** argv, const char* program,
                                        std::uint64_t count) {
  Seeds seeds{1, count, false};
  for (int n = 1; n < argc; ++n) {
    const std::string_view option = argv[n];
    const auto value = [&] { return n + 1 < argc ? std::strtoull(argv[++n], nullptr, 10) : 0; };
    if (option == "--first-seed") {
      seeds.first = value();
    } else if (option == "--count") {
      seeds.count = value();
    } else if (option == "--list") {
      seeds.list = true;
    } else {
      std::fprintf(stderr, "%s: what is '%s'? (its source's head says)\n", program, argv[n]);
      return std::nullopt;
    }
  }
  return seeds;
}

// Prints a line at once: a crash behind it loses nothing.
template <class... Parts>
void say(const Parts&... parts) {
  std::printf("%s\n", text(parts...).c_str());
  std::fflush(stdout);
}

// A row of a storm's table: counts by column, and seconds.
template <std::size_t Columns>
struct Row {
  std::array<std::uint64_t, Columns> counts{};
  double seconds = 0;

  std::uint64_t& operator[](std::size_t column) { return counts[column]; }
  std::uint64_t operator[](std::size_t column) const { return counts[column]; }
  void operator+=(const Row& b) {
    for (std::size_t n = 0; n < Columns; ++n) counts[n] += b.counts[n];
    seconds += b.seconds;
  }
  void print(std::string_view name) const {
    std::printf("%-16.*s", static_cast<int>(name.size()), name.data());
    for (const std::uint64_t count : counts) {
      std::printf(" %9llu", static_cast<unsigned long long>(count));
    }
    std::printf(" %9.1f\n", seconds);
  }
};

// The line above the rows.
inline void print_columns(std::string_view kind, std::span<const std::string_view> columns) {
  std::printf("%-16.*s", static_cast<int>(kind.size()), kind.data());
  for (const std::string_view column : columns) {
    std::printf(" %9.*s", static_cast<int>(column.size()), column.data());
  }
  std::printf(" %9s\n", "CPU s");
}

}  // namespace deliso::stress
