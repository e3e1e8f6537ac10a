// SPDX-License-Identifier: MIT
// Random volumes (option_volume.h) meshed with random options (drawn_options.h), by one process and
// in parts, which are written, read and joined in some order as the program does it.
//   stress_parts [--first-seed N] [--count M] [--list]
// Each option of the table is the first one of every N-th seed, N the number of rows. A seed says
// everything: the volume, the options, how many parts there are (1, 4, 7 or 64), and whether the
// samples are in memory or read box by box. The join alone has the options of reports. It runs in a
// child process, and a crash costs that one seed. Exit status 1 when a join has another mesh than
// one process, or a refusal that one process has not, or counts other close places; when an option
// that excludes --part is not refused; or when the join of some option was never tested, after
// eight more seeds of those that gave no mesh. A seam between parts may be refused; that is
// counted.
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/command_line.h"
#include "app/input.h"
#include "app/mesh_run.h"
#include "app/parsed_line.h"
#include "app/progress.h"
#include "base/check.h"
#include "base/random.h"
#include "base/text.h"
#include "mesh/meshes.h"
#include "stress/drawn_options.h"
#include "stress/in_child.h"
#include "stress/joined_parts.h"
#include "stress/option_volume.h"
#include "stress/see_seed.h"
#include "stress/seeds.h"

using namespace deliso;
using namespace deliso::stress;

namespace {

constexpr std::string_view kProgram = "stress_parts";
constexpr int kParts[] = {4, 7, 64, 1};
constexpr unsigned kMostSeconds = 60;
constexpr std::uint64_t kMoreRounds = 8;

const DrawnOption& first_option(std::uint64_t seed) {
  return drawn_options()[seed % drawn_options().size()];
}

struct Case {
  OptionVolume volume;
  Words words;  // of the mesh command
};

// Draws volumes until the first option means something.
Case make_case(std::uint64_t seed, const std::string& file) {
  constexpr std::uint64_t kVolumesPerSeed = 64;
  for (std::uint64_t number = seed * kVolumesPerSeed;; ++number) {
    OptionVolume volume = make_option_volume(number, 8);
    const Draw draw = draw_options(number, volume, &first_option(seed), kNoParts);
    if (!draw.first) continue;
    Words words = command_words(file, volume.tiny.isovalue, [&] {
      Words all = draw.first_words;
      all.insert(all.end(), draw.other_words.begin(), draw.other_words.end());
      return all;
    }());
    const auto excludes_side = [](const std::string& word) {
      return word.starts_with("--block-side") || word == "--paper";
    };
    if (std::ranges::none_of(words, excludes_side)) {
      words.push_back(text("--block-side=", 4 + number % 5));
    }
    return {std::move(volume), std::move(words)};
  }
}

// What one process or a join made.
struct Made {
  std::string refusal;
  TriMesh mesh;
  Report report;
  bool is_measured = false;  // for a report, which has the counts below
  TopologyCounts counts;
  ClosePlaces close;
  std::optional<Volume> field;

  void take(const MeshRun& run, const TriMesh& of_run) {
    make_reports(run);
    mesh = of_run;
    report = run.report;
    is_measured = !run.line.quiet || !run.line.json.empty();
    counts = run.found.topology;
    close = run.found.close;
    field = run.input.volume();
  }
};

Made made_by_one(const Words& words) {
  Made made;
  try {
    const CommandLine line = test::parse_words(words);
    const Input input = read_input(line);
    MeshRun run(line, input);
    ProgressBar none(mesh_stages(line), false);
    const TriMesh mesh = mesh_input(run, none);
    made.take(run, mesh);
  } catch (const InputError& error) {
    made.refusal = error.what();
  }
  return made;
}

// Makes the parts, some by boxes, and joins them in a random order.
Made made_by_join(const CommandLine& of_part, const Words& of_join, std::uint64_t seed) {
  Made made;
  try {
    std::vector<std::string> bytes = make_parts(of_part, seed % 2 == 0);
    Random random(seed);
    for (std::size_t n = bytes.size(); n > 1; --n) {
      std::swap(bytes[n - 1], bytes[random.below(static_cast<std::uint32_t>(n))]);
    }
    const auto joined = join_parts(bytes, of_part.input, of_join);
    made.take(joined->run, joined->mesh);
  } catch (const InputError& error) {
    made.refusal = error.what();
  }
  return made;
}

// POD, so that it can go through a pipe.
struct Verdict {
  enum Outcome { joined, excluded, refused, nothing, refused_seam, fault } outcome = fault;
  char what[400] = "";
};
constexpr std::array<std::string_view, 6> kOutcomes{"joined",
                                                    "with an option that excludes parts",
                                                    "refused in the same words",
                                                    "with nothing",
                                                    "with a refused seam",
                                                    "with a fault"};

std::string difference(const Made& joined, const Made& whole) {
  if (!test::same_mesh(joined.mesh, whole.mesh)) return "another mesh";
  if (joined.report.exact != whole.report.exact) return "another exact topology";
  if (joined.report.counters != whole.report.counters) return "other counts";
  if (joined.report.cap.failure != whole.report.cap.failure) return "another fault of the caps";
  if (!joined.is_measured) return {};
  if (joined.counts != whole.counts) return "another topology in the report";
  const ClosePlaces &a = joined.close, &b = whole.close;
  if (a.needles != b.needles || a.folds != b.folds || a.near != b.near) return "other close places";
  return {};
}

Verdict run_seed(std::uint64_t seed, const std::string& file) {
  const Case drawn = make_case(seed, file);
  write_files(drawn.volume, file);
  const int of = kParts[seed / drawn_options().size() % std::size(kParts)];
  Verdict verdict;
  const auto end = [&](Verdict::Outcome outcome, const std::string& what) {
    verdict.outcome = outcome;
    what.copy(verdict.what, sizeof verdict.what - 1);
    return verdict;
  };
  CommandLine of_part;
  Words words = drawn.words;
  const Words of_join = take_report_options(words);
  try {
    Words more = words;
    more.insert(more.end(), {text("--part=1/", of), "--output=v.part"});
    of_part = test::parse_words(more);
  } catch (const InputError& error) {
    const bool is_excluded = (first_option(seed).exempt & kNoParts) != 0;
    return end(is_excluded ? Verdict::excluded : Verdict::fault, error.what());
  }
  if ((first_option(seed).exempt & kNoParts) != 0) {
    return end(Verdict::fault, "the option is not refused with --part");
  }
  const Made whole = made_by_one(words);
  const Made joined = made_by_join(of_part, of_join, seed);
  if (joined.refusal.find("too fine for the seam") != std::string::npos) {
    return end(Verdict::refused_seam, joined.refusal);
  }
  if (joined.refusal.empty() != whole.refusal.empty()) {
    return end(Verdict::fault,
               text("one process: '", whole.refusal, "', the join: '", joined.refusal, "'"));
  }
  if (!whole.refusal.empty()) {
    const bool is_same = joined.refusal == whole.refusal;
    return end(is_same ? Verdict::refused : Verdict::nothing, whole.refusal);
  }
  const std::string fault = difference(joined, whole);
  if (!fault.empty()) {
    see_seed(kProgram, seed, *whole.field, whole.report.kappa_effective, joined.mesh, {},
             {{"whole", whole.mesh}});
  }
  return end(fault.empty() ? Verdict::joined : Verdict::fault, fault);
}

void list(std::uint64_t seed, std::string_view what) {
  const std::string file = file_of_seed(kProgram, seed, make_case(seed, "").volume.tiny.volume);
  std::string line = text("seed ", seed, ": ", what, "\n  deliso");
  for (const std::string& word : make_case(seed, file).words) line += " " + word;
  say(line);
}

int run_all(std::uint64_t first, std::uint64_t count, bool listed) {
  const std::string file =
      (std::filesystem::temp_directory_path() / text("stress_parts-", getpid(), ".nrrd")).string();
  std::array<std::uint64_t, kOutcomes.size()> outcomes{};
  std::uint64_t crashed = 0;
  std::set<std::string_view> tested;
  const auto run = [&](std::uint64_t begin, std::uint64_t end) {
    return run_in_children<Verdict>(
        begin, end, kMostSeconds, [&](std::uint64_t seed) { return run_seed(seed, file); },
        [&](std::uint64_t seed, const Verdict& verdict) {
          ++outcomes[verdict.outcome];
          if (verdict.outcome <= Verdict::refused) tested.insert(first_option(seed).name);
          if (listed && verdict.outcome == Verdict::fault) list(seed, verdict.what);
        },
        [&](std::uint64_t seed, bool hung) {
          ++crashed;
          list(seed, hung ? "hung" : "crashed");
        });
  };
  bool forked = run(first, first + count);
  // Where a filter has removed the surface, the option gets another seed, of the next rounds.
  const std::size_t rows = drawn_options().size();
  const std::uint64_t last = first + (count < rows ? 0 : count + kMoreRounds * rows);
  for (std::uint64_t seed = first + count; seed < last && tested.size() < rows; ++seed) {
    if (tested.count(first_option(seed).name) == 0) forked &= run(seed, seed + 1);
  }
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  if (!forked) return 2;
  std::string told = text(count, " seeds");
  for (std::size_t n = 0; n < kOutcomes.size(); ++n) {
    told += text(", ", outcomes[n], " ", kOutcomes[n]);
  }
  say(told, ", ", crashed, " crashed or hung");
  bool all_tested = true;
  for (const DrawnOption& option : drawn_options()) {
    if (count < rows || tested.count(option.name) > 0) continue;
    say("never tested: ", option.name);
    all_tested = false;
  }
  const bool faulty = outcomes[Verdict::fault] > 0 || crashed > 0;
  if (faulty) tell_next_step(kProgram);
  return faulty || !all_tested;
}

}  // namespace

int main(int argc, char** argv) {
  if (const std::string_view name = undrawn_option(); !name.empty()) {
    std::fprintf(stderr, "stress_parts: %s has no row in drawn_options.cpp\n",
                 std::string(name).c_str());
    return 1;
  }
  const auto seeds = parse_seeds(argc, argv, "stress_parts", 2 * drawn_options().size());
  if (!seeds) return 2;
  try {
    return run_all(seeds->first, seeds->count, seeds->list);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stress_parts: %s\n", error.what());
    return 2;
  }
}
