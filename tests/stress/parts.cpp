// SPDX-License-Identifier: MIT
// Random volumes (tiny_volume.h) meshed in parts, written, read and joined, as the program does it.
//   stress_parts [--first-seed N] [--count M] [--list]
// The seed also says which of --smooth, --median, --label, --cap, --largest and --min-component are
// on, the side of a block (4 to 8 voxels), how many parts there are (1, 4, 7 or 64), and whether
// the samples are in memory or read box by box. Parts are joined in three orders. Exit status 1
// when a join has another mesh than one process. A seam between parts may be refused; that is
// counted.
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "app/input.h"
#include "app/parsed_line.h"
#include "app/parts.h"
#include "base/check.h"
#include "base/random.h"
#include "base/text.h"
#include "deliso/deliso.h"
#include "io/parts/part_file.h"
#include "mesh/meshes.h"
#include "mesh_parts.h"
#include "stress/seeds.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using namespace deliso::stress;

namespace {

constexpr int kParts[] = {4, 7, 64, 1};
constexpr const char* kName = "tiny";

// The samples as labels: 1 inside, 0 outside.
Volume labels_of(const Volume& volume, double isovalue) {
  return volume.visit([&](const auto* samples) {
    std::vector<std::uint8_t> labels;
    for (std::size_t n = 0; n < volume.sample_count(); ++n) {
      labels.push_back(static_cast<double>(samples[n]) >= isovalue);
    }
    return Volume::from_samples(volume.dims(), volume.spacing(), labels);
  });
}

struct Case {
  Volume volume;
  std::vector<std::string> words;  // of deliso mesh
};

Case case_of(std::uint64_t seed) {
  const TinyVolume tiny = make_tiny_volume(seed, 8, 20);
  Case made{tiny.volume, {kName, text("--block-side=", 4 + seed / kTinyKinds % 5), "--threads=2"}};
  const std::uint64_t kind = seed / kTinyKinds % 12;
  if (kind == 3) {
    made.volume = labels_of(tiny.volume, tiny.isovalue);
    made.words.emplace_back("--label=1");
  } else {
    made.words.push_back(text("--iso=", tiny.isovalue));
  }
  if (kind == 1 || kind == 6) made.words.emplace_back("--smooth=0.6vox");
  if (kind == 2 || kind == 6) made.words.emplace_back("--median=1");
  if (kind == 4 || kind == 9) made.words.emplace_back("--cap");
  if (kind == 5 || kind == 9) made.words.emplace_back("--largest=2");
  if (kind == 8) made.words.emplace_back("--min-component=3");
  return made;
}

CommandLine line_of(const Case& made, int part, int of) {
  std::vector<std::string> words = made.words;
  if (of > 0) words.insert(words.end(), {text("--part=", part, "/", of), "--output=x.part"});
  return test::parse_words(words);
}

// The samples for a part: read box by box, or in memory, and then only what the part needs.
VolumeSource source_for(std::uint64_t seed, const Volume& volume, const CommandLine& line) {
  if (seed % 2 == 0) {
    VolumeSource source = source_of(volume);
    source.in_memory.reset();
    return source;
  }
  const auto [begin, end] = region_of_part(line, volume.dims(), volume.spacing());
  return source_of(samples_of(volume, {begin, {end.i - 1, end.j - 1, end.k - 1}}));
}

// Returns what is wrong; empty: nothing.
std::string fault_of(std::uint64_t seed, const Case& made, int of) {
  const CommandLine line = line_of(made, 0, 0);
  const VolumeSource source = source_of(made.volume);
  const FieldSource field = field_source(source, line, kName);
  Report whole_report;
  const TriMesh whole =
      mesh_isosurface(all_of(field.source), field.isovalue, line.options, whole_report);
  std::vector<std::string> bytes;
  for (int n = 1; n <= of; ++n) {
    const CommandLine of_part = line_of(made, n, of);
    const VolumeSource samples = source_for(seed, made.volume, of_part);
    bytes.push_back(part_bytes(make_part(samples, of_part, kName, nullptr)));
  }
  Random random(seed);
  std::vector<std::size_t> order(bytes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (int turn = 0; turn < 3; ++turn) {
    for (std::size_t n = order.size(); n > 1; --n) {
      std::swap(order[n - 1], order[random.below(static_cast<std::uint32_t>(n))]);
    }
    std::vector<PartFile> parts;
    for (const std::size_t n : order) {
      parts.push_back(part_in(std::as_bytes(std::span(bytes[n])), text("part", n)));
    }
    sort_parts(parts);
    const CommandLine noted = line_of(parts.front(), kName);
    require_field(parts, field, noted.options, kName);
    std::vector<Block> blocks;
    for (PartFile& part : parts) blocks.push_back(std::move(part.block));
    Report report;
    const TriMesh joined =
        mesh_of_parts(field.source, field.isovalue, noted.options, std::move(blocks), report);
    if (!test::same_mesh(joined, whole)) return "another mesh";
    if (report.exact != whole_report.exact) return "another exact topology";
    if (report.counters != whole_report.counters) return "other counts";
    if (report.cap.failure != whole_report.cap.failure) return "another fault of the caps";
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  const auto seeds = parse_seeds(argc, argv, "stress_parts", 84);
  if (!seeds) return 2;
  const auto [first, count, list] = *seeds;
  std::uint64_t faulty = 0, refused = 0, joined = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Case made = case_of(seed);
    const int of = kParts[seed % std::size(kParts)];
    std::string fault;
    try {
      fault = fault_of(seed, made, of);
      joined += fault.empty();
      faulty += !fault.empty();
    } catch (const InputError& error) {
      const std::string what = error.what();
      const bool is_refused = what.find("too fine for the seam") != std::string::npos;
      refused += is_refused;
      // Without a surface there is no label to find, and nothing to mesh.
      const bool is_nothing = what.find("no sample has label") != std::string::npos;
      faulty += !is_refused && !is_nothing;
      if (!is_refused && !is_nothing) fault = what;
    }
    if (list && !fault.empty()) {
      std::printf("seed %llu in %d parts:", static_cast<unsigned long long>(seed), of);
      for (const std::string& word : made.words) std::printf(" %s", word.c_str());
      std::printf(": %s\n", fault.c_str());
      std::fflush(stdout);
    }
  }
  std::printf("%llu volumes: %llu joined, %llu with a refused seam, %llu with a fault\n",
              static_cast<unsigned long long>(count), static_cast<unsigned long long>(joined),
              static_cast<unsigned long long>(refused), static_cast<unsigned long long>(faulty));
  return faulty > 0 || 4 * joined < 3 * count;
}
