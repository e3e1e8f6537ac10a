// SPDX-License-Identifier: MIT
// Parts of random volumes (tiny_volume.h) edited by a hostile hand, then joined.
//   stress_hostile_parts [--first-seed N] [--count M] [--list]
// A seed says everything: volume, blocks, encoding, part and edit. The join must refuse the edit
// with one line that leaves no file, or write the bytes that it writes of the parts as they were.
// Exit status 1 where it does neither.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "base/check.h"
#include "io/parts/in_blocks.h"
#include "stress/seeds.h"
#include "stress/tiny_volume.h"

using namespace deliso;
using namespace deliso::stress;
using namespace deliso::test;

namespace {

constexpr std::uint64_t kEditsPerVolume = 20;

enum class Edit : std::uint8_t {
  bytes,         // one to four, anywhere
  header_digit,  // another digit in the header
  header_size,   // a number of the header becomes one that no part has
  header_line,   // a line of the header goes, or comes twice
  header_word,   // a word of the header goes
  coordinate,    // eight bytes of the body become those of another place
  row,           // two runs of bytes of the body change places
  truncated,
  shifted,      // a run of bytes goes, or comes twice
  other_mesh,   // between two passes, the same block by another seed
  other_bytes,  // between two passes, any edit above the last three
};
constexpr std::array<std::string_view, 11> kNames{
    "bytes", "header-digit", "header-size", "header-line", "header-word", "coordinate",
    "row",   "truncated",    "shifted",     "other-mesh",  "other-bytes"};

bool is_between_passes(Edit edit) {
  return edit == Edit::other_mesh || edit == Edit::other_bytes;
}

// Begin and length of a run of characters that `belongs` accepts, chosen at random in `text`.
template <class Belongs>
std::pair<std::size_t, std::size_t> run_in(std::string_view text, Random& random, Belongs belongs) {
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  for (std::size_t n = 0, end; n < text.size(); n = end + 1) {
    for (end = n; end < text.size() && belongs(text[end]);) ++end;
    if (end > n) runs.emplace_back(n, end - n);
  }
  return runs[random.below(static_cast<std::uint32_t>(runs.size()))];
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::string edited(std::string part, Edit edit, Random& random) {
  constexpr std::string_view kEnd = "end_header\n";
  const std::size_t body = part.find(kEnd) + kEnd.size();
  const std::string_view header = std::string_view(part).substr(0, body - 1);
  const auto below = [&](std::size_t n) { return random.below(static_cast<std::uint32_t>(n)); };
  switch (edit) {
    case Edit::bytes:
      for (std::uint32_t n = 1 + below(4); n > 0; --n) {
        part[below(part.size())] = static_cast<char>(random.next());
      }
      break;
    case Edit::header_digit: {
      const auto [at, size] = run_in(header, random, is_digit);
      part[at + below(size)] = static_cast<char>('0' + below(10));
      break;
    }
    case Edit::header_size: {
      constexpr const char* kSizes[] = {
          "0",     "1", "-1", "641", "6700417", "2147483647", "4294967295", "18446744073709551615",
          "1e300", ""};
      const auto [at, size] = run_in(header, random, is_digit);
      part.replace(at, size, kSizes[below(std::size(kSizes))]);
      break;
    }
    case Edit::header_line: {
      const auto [at, size] = run_in(header, random, [](char c) { return c != '\n'; });
      const std::string line = part.substr(at, size + 1);
      below(2) == 0 ? part.erase(at, size + 1) : part.insert(at, line);
      break;
    }
    case Edit::header_word: {
      const auto [at, size] = run_in(header, random, [](char c) { return c > ' '; });
      part.erase(at, size + below(2));
      break;
    }
    case Edit::coordinate: {
      if (part.size() < body + 16) break;
      const std::string from = part.substr(body + below(part.size() - body - 8), 8);
      part.replace(body + below(part.size() - body - 8), 8, from);
      break;
    }
    case Edit::row: {
      const std::size_t size = 1 + below(26);
      if (part.size() < body + 2 * size) break;
      const std::size_t a = body + below(part.size() - body - 2 * size + 1);
      const std::size_t b = a + size + below(part.size() - a - 2 * size + 1);
      for (std::size_t n = 0; n < size; ++n) std::swap(part[a + n], part[b + n]);
      break;
    }
    case Edit::truncated:
      part.resize(below(2) == 0 ? below(part.size()) : part.size() - 1 - below(20));
      break;
    case Edit::shifted: {
      const std::size_t at = below(part.size()), size = 1 + below(40);
      const std::string run = part.substr(at, size);
      below(2) == 0 ? part.erase(at, size) : part.insert(at, run);
      break;
    }
    case Edit::other_mesh:
      break;
    case Edit::other_bytes:
      return edited(part, static_cast<Edit>(below(static_cast<std::size_t>(Edit::truncated))),
                    random);
  }
  return part;
}

// A named pipe in place of a part: every reader of the path gets the bytes of its turn.
class PipeInPlace {
 public:
  // `from`: the first turn, counted from 0, that is given the second bytes.
  PipeInPlace(std::string path, std::string first, std::string second, int from)
      : path_(std::move(path)),
        next_(path_ + ".next"),
        bytes_{std::move(first), std::move(second)},
        from_(from) {
    make();
    feeder_ = std::thread([this] { feed(); });
  }
  ~PipeInPlace() {
    done_ = true;
    // Lets go a feeder that waits for a reader.
    while (!ended_) {
      const int descriptor = ::open(path_.c_str(), O_RDONLY | O_NONBLOCK);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (descriptor >= 0) ::close(descriptor);
    }
    feeder_.join();
  }
  PipeInPlace(const PipeInPlace&) = delete;
  PipeInPlace& operator=(const PipeInPlace&) = delete;

 private:
  void make() {
    if (::mkfifo(next_.c_str(), 0600) != 0 || std::rename(next_.c_str(), path_.c_str()) != 0) {
      std::perror("stress_hostile_parts: no pipe");
      std::exit(2);
    }
  }
  void feed() {
    for (int turn = 0; !done_; ++turn) {
      const int descriptor = ::open(path_.c_str(), O_WRONLY);
      const std::string& bytes = bytes_[turn >= from_];
      for (std::size_t n = 0; n < bytes.size() && !done_;) {
        const ssize_t written = ::write(descriptor, bytes.data() + n, bytes.size() - n);
        if (written <= 0) break;
        n += static_cast<std::size_t>(written);
      }
      make();  // the next reader's, before this one's ends
      ::close(descriptor);
    }
    ended_ = true;
  }

  std::string path_, next_;
  std::array<std::string, 2> bytes_;
  int from_;
  std::atomic<bool> done_ = false, ended_ = false;
  std::thread feeder_;
};

// A random volume's parts, and the whole that they make.
struct Parts {
  explicit Parts(std::uint64_t seed) : tiny(make_tiny_volume(seed, 6, 10)) {
    constexpr Index3 kOf[] = {{2, 1, 1}, {1, 2, 2}, {1, 1, 1}, {2, 2, 2}};
    const Index3 of = kOf[seed % 4];
    how.ascii = seed % 3 == 1;
    how.single_precision = seed % 5 == 2;
    for (const BlockChoice& block : all_blocks(of)) {
      paths.push_back(folder / ("part" + std::to_string(paths.size()) + ".ply"));
      bytes.push_back(made(block, 1, paths.back()));
      others.push_back(made(block, 2, folder / "other.ply"));
    }
    join_parts(paths, folder / "whole.ply", false, false);
    whole = file_bytes(folder / "whole.ply");
  }
  std::string made(const BlockChoice& block, std::uint64_t seed, const std::string& path) const {
    Options options;
    options.seed = seed;
    options.r_min = {0.3, Length::Unit::voxel};
    Report report;
    write_part(tiny.volume, block, tiny.isovalue, options, path, report, how);
    return file_bytes(path);
  }

  TinyVolume tiny;
  MeshWriteOptions how;
  TemporaryFolder folder;
  std::vector<std::string> paths, bytes, others;
  std::string whole;
};

enum class Outcome : std::uint8_t { refused, same, wrong };

// What join makes of the parts as they lie there; `fault` becomes what it says.
Outcome outcome_of(const Parts& parts, std::string& fault) {
  const std::string to = parts.folder / "joined.ply";
  try {
    join_parts(parts.paths, to, false, false);
  } catch (const InputError& error) {
    fault = error.what();
    const bool one_line = !fault.empty() && fault.find('\n') == std::string::npos;
    return one_line && !std::filesystem::exists(to) ? Outcome::refused : Outcome::wrong;
  }
  const bool same = file_bytes(to) == parts.whole;
  std::filesystem::remove(to);
  return same ? Outcome::same : Outcome::wrong;
}

}  // namespace

int main(int argc, char** argv) {
  const auto seeds = parse_seeds(argc, argv, "stress_hostile_parts", 440);
  if (!seeds) return 2;
  const auto [first, count, list] = *seeds;
  std::signal(SIGPIPE, SIG_IGN);
  std::array<std::array<std::uint64_t, 3>, kNames.size()> outcomes{};
  std::uint64_t unchanged = 0;
  std::optional<Parts> parts;
  std::uint64_t of_volume = 0;
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    if (!parts || of_volume != seed / kEditsPerVolume) {
      of_volume = seed / kEditsPerVolume;
      try {
        parts.emplace(1 + of_volume);
      } catch (const InputError&) {
        parts.reset();  // a block that is refused for its seam
      }
    }
    if (!parts) continue;
    Random random(seed);
    const auto edit = static_cast<Edit>(seed % kNames.size());
    const std::size_t p = random.below(static_cast<std::uint32_t>(parts->paths.size()));
    const std::string bytes =
        edit == Edit::other_mesh ? parts->others[p] : edited(parts->bytes[p], edit, random);
    if (bytes == parts->bytes[p]) {
      ++unchanged;
      continue;
    }
    std::string fault;
    Outcome outcome;
    if (is_between_passes(edit)) {
      // The turns: the header, then three passes.
      const PipeInPlace pipe(parts->paths[p], parts->bytes[p], bytes,
                             1 + static_cast<int>(random.below(3)));
      outcome = outcome_of(*parts, fault);
    } else {
      write_bytes(parts->paths[p], bytes);
      outcome = outcome_of(*parts, fault);
    }
    std::filesystem::remove(parts->paths[p]);
    write_bytes(parts->paths[p], parts->bytes[p]);
    ++outcomes[static_cast<std::size_t>(edit)][static_cast<std::size_t>(outcome)];
    if (outcome == Outcome::wrong || list) {
      std::printf("seed %llu, %s: %s %s\n", static_cast<unsigned long long>(seed),
                  std::string(kNames[static_cast<std::size_t>(edit)]).c_str(),
                  outcome == Outcome::wrong  ? "WRONG"
                  : outcome == Outcome::same ? "the same whole"
                                             : "refused:",
                  fault.c_str());
    }
  }
  std::uint64_t all_wrong = 0;
  for (std::size_t n = 0; n < kNames.size(); ++n) {
    const auto [refused, same, wrong] = outcomes[n];
    all_wrong += wrong;
    std::printf("%-13s %5llu refused, %4llu the same whole, %4llu wrong\n",
                std::string(kNames[n]).c_str(), static_cast<unsigned long long>(refused),
                static_cast<unsigned long long>(same), static_cast<unsigned long long>(wrong));
  }
  std::printf("%llu edits, %llu of them without effect; %llu wrong\n",
              static_cast<unsigned long long>(count), static_cast<unsigned long long>(unchanged),
              static_cast<unsigned long long>(all_wrong));
  return all_wrong > 0;
}
