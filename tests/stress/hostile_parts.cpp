// SPDX-License-Identifier: MIT
// Parts of random volumes (tiny_volume.h) edited by a hostile hand, then joined.
//   stress_hostile_parts [--first-seed N] [--count M] [--list]
// A seed says everything: volume, parts, part and edit. Two of three edits come with a checksum
// that fits. The join must refuse the edit with one line; or make the mesh of the parts as they
// were; or make one that a check faults, or that is sound. Exit status 1 where it does none of
// these, crashes, or works for more than 20 s.
#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "base/text.h"
#include "check/check_mesh.h"
#include "check/verify.h"
#include "deliso/mesh_isosurface.h"
#include "io/files/checksum.h"
#include "io/parts/part_file.h"
#include "mesh/meshes.h"
#include "stress/in_child.h"
#include "stress/judge.h"
#include "stress/seeds.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using namespace deliso::stress;

namespace {

constexpr unsigned kMostSeconds = 20;

enum class Edit : std::uint8_t {
  bytes,      // one to four, anywhere
  number,     // eight bytes become those of another place
  small,      // four bytes become a small number: an id, a count
  large,      // eight bytes become a large one
  row,        // two runs of bytes change places
  shifted,    // a run of bytes goes, or comes twice
  truncated,  // the end is missing
};
constexpr std::uint64_t kEdits = 7;

std::string edited(std::string part, Edit edit, Random& random) {
  const auto below = [&](std::size_t n) { return random.below(static_cast<std::uint32_t>(n)); };
  const std::size_t size = part.size();
  switch (edit) {
    case Edit::bytes:
      for (std::uint32_t n = 1 + below(4); n > 0; --n) {
        part[below(size)] = static_cast<char>(random.next());
      }
      break;
    case Edit::number: {
      const std::string from = part.substr(below(size - 8), 8);
      part.replace(below(size - 8), 8, from);
      break;
    }
    case Edit::small: {
      const std::uint32_t number = below(300);
      std::memcpy(&part[below(size - 4)], &number, sizeof number);
      break;
    }
    case Edit::large: {
      const std::uint64_t number = ~std::uint64_t{below(300)} >> below(40);
      std::memcpy(&part[below(size - 8)], &number, sizeof number);
      break;
    }
    case Edit::row: {
      const std::size_t length = 1 + below(48);
      const std::size_t a = below(size - 2 * length);
      const std::size_t b = a + length + below(size - a - 2 * length);
      for (std::size_t n = 0; n < length; ++n) std::swap(part[a + n], part[b + n]);
      break;
    }
    case Edit::shifted: {
      const std::size_t at = below(size - 60), length = 1 + below(48);
      const std::string run = part.substr(at, length);
      below(2) == 0 ? part.erase(at, length) : part.insert(at, run);
      break;
    }
    case Edit::truncated:
      part.resize(below(2) == 0 ? below(size) : size - 1 - below(40));
      break;
  }
  return part;
}

// Returns the part with a checksum that fits its other bytes.
std::string summed(std::string part) {
  constexpr std::size_t kSize = sizeof(std::uint32_t);
  if (part.size() < kSize) return part;
  part.resize(part.size() - kSize);
  const std::uint32_t sum = crc32(std::as_bytes(std::span(part)));
  char bytes[kSize];
  std::memcpy(bytes, &sum, kSize);
  return part.append(bytes, kSize);
}

Options options_for(std::uint64_t volume) {
  Options options;
  options.block_side = 4 + static_cast<int>(volume % 4);
  options.cap = volume % 5 == 0;
  options.threads = 1;
  return options;
}

TriMesh joined(const VolumeSource& source, double isovalue, const Options& options,
               const std::vector<std::string>& bytes, Report& report) {
  std::vector<PartFile> parts;
  for (const std::string& part : bytes) {
    parts.push_back(part_in(std::as_bytes(std::span(part)), text("part", parts.size())));
  }
  sort_parts(parts);
  std::vector<Block> blocks;
  for (PartFile& part : parts) {
    // What app/parts.h asks, but for the samples at seams.
    if (!part.is_of(source.shape, isovalue)) throw InputError("a part of another volume");
    blocks.push_back(std::move(part.block));
  }
  return mesh_of_parts(source, isovalue, options, std::move(blocks), report);
}

enum class Outcome : std::uint8_t { none, refused, same, faulted, sound, wrong };
constexpr std::array<std::string_view, 6> kOutcomes{
    "not made", "refused", "the same mesh", "faulted by a check", "sound", "WRONG"};

// POD, so that it can go through a pipe.
struct EditVerdict {
  Outcome outcome = Outcome::none;
  char what[200] = "";
};

EditVerdict run_seed(std::uint64_t seed) {
  constexpr std::uint64_t kEditsPerVolume = 20;
  const std::uint64_t number = 1 + seed / kEditsPerVolume;
  const TinyVolume tiny = make_tiny_volume(number, 6, 12);
  const Options options = options_for(number);
  const VolumeSource source = source_of(tiny.volume);
  const int of = 2 + static_cast<int>(number % 4);
  EditVerdict verdict;
  const auto end = [&](Outcome outcome, const std::string& what) {
    verdict.outcome = outcome;
    what.copy(verdict.what, sizeof verdict.what - 1);
    return verdict;
  };
  std::vector<std::string> bytes;
  Report of_parts, report;
  TriMesh usual;
  try {
    for (int n = 1; n <= of; ++n) {
      PartFile part{.name = "",
                    .choice = {n, of},
                    .words = {"--iso=1"},
                    .dims = tiny.volume.dims(),
                    .spacing = tiny.volume.spacing(),
                    .type = tiny.volume.type(),
                    .frame = tiny.volume.frame(),
                    .isovalue = tiny.isovalue,
                    .samples_at_seams = 0,
                    .block = mesh_part(source, tiny.isovalue, options, {n, of})};
      bytes.push_back(part_bytes(std::move(part)));
    }
    usual = joined(source, tiny.isovalue, options, bytes, of_parts);
  } catch (const InputError& error) {
    return end(Outcome::none, error.what());  // a seam that is refused
  }
  Random random(seed);
  const std::size_t p = random.below(static_cast<std::uint32_t>(of));
  bytes[p] = edited(bytes[p], static_cast<Edit>(seed % kEdits), random);
  if (seed % 3 != 0) bytes[p] = summed(bytes[p]);
  TriMesh mesh;
  try {
    mesh = joined(source, tiny.isovalue, options, bytes, report);
  } catch (const InputError& error) {
    const std::string what = error.what();
    const bool is_line = !what.empty() && what.find('\n') == std::string::npos;
    return end(is_line ? Outcome::refused : Outcome::wrong, what);
  }
  if (test::same_mesh(mesh, usual)) return end(Outcome::same, "");
  VerifyOptions how;
  how.solid = options.cap;
  const Verification found = verify(mesh, tiny.volume, report.kappa_effective, how);
  bool is_faulted = !report.cap.failure.empty();
  for (std::size_t n = 0; n < kFaultKinds; ++n) {
    const auto kind = static_cast<FaultKind>(n);
    is_faulted |= kind != FaultKind::over_limits && found.faults.count(kind) > 0;
  }
  if (is_faulted) return end(Outcome::faulted, "");
  if (const std::string fault = check_mesh(mesh); !fault.empty()) return end(Outcome::wrong, fault);
  if (options.cap) return end(Outcome::sound, "");
  const std::string fault = judge(tiny.volume, mesh, {}, report).fault;
  return end(fault.empty() ? Outcome::sound : Outcome::wrong, fault);
}

}  // namespace

int main(int argc, char** argv) {
  const auto seeds = parse_seeds(argc, argv, "stress_hostile_parts", 440);
  if (!seeds) return 2;
  const std::uint64_t first = seeds->first, count = seeds->count;
  const bool list = seeds->list;
  std::array<std::uint64_t, kOutcomes.size()> outcomes{};
  std::uint64_t lost = 0;
  const auto print = [](std::uint64_t seed, std::string_view outcome, const char* what) {
    say("seed ", seed, ": ", outcome, " ", what);
  };
  const bool forked = run_in_children<EditVerdict>(
      first, first + count, kMostSeconds, run_seed,
      [&](std::uint64_t seed, const EditVerdict& verdict) {
        const auto n = static_cast<std::size_t>(verdict.outcome);
        ++outcomes[n];
        if (verdict.outcome == Outcome::wrong || list) print(seed, kOutcomes[n], verdict.what);
      },
      [&](std::uint64_t seed, bool hung) {
        ++lost;
        print(seed, hung ? "HUNG" : "CRASHED", "");
      });
  if (!forked) return 2;
  std::string told = text(count, " edits: ", lost, " crashed or hung");
  for (std::size_t n = 0; n < kOutcomes.size(); ++n) {
    told += text(", ", outcomes[n], " ", kOutcomes[n]);
  }
  say(told);
  const auto of = [&](Outcome outcome) { return outcomes[static_cast<std::size_t>(outcome)]; };
  return lost > 0 || of(Outcome::wrong) > 0 || 2 * of(Outcome::none) > count;
}
