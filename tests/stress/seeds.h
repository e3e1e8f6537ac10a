// SPDX-License-Identifier: MIT
// The command line that the storms share: [--first-seed N] [--count M] [--list].
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string_view>

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

}  // namespace deliso::stress
