// SPDX-License-Identifier: MIT
#include "stress/drawn_options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "app/option_table.h"
#include "base/text.h"

namespace deliso::stress {
namespace {

// Returns a number in between, more often a small one.
std::string number(Random& random, double lo, double hi) {
  const double u = random.uniform();
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.3g", lo + (hi - lo) * u * u * u);
  return digits;
}

// The same for a count: every third is below lo + (hi - lo) / 200.
std::string whole(Random& random, double lo, double hi) {
  const double u = random.uniform();
  return text(std::floor(lo + (hi - lo) * u * u * u * u * u));
}

Words roi(Random& random, const OptionVolume& v) {
  std::string box;
  for (int axis = 0; axis < 3; ++axis) {
    const int n = v.tiny.volume.dims()[axis];
    const int first = static_cast<int>(random.below(static_cast<std::uint32_t>(n - 1)));
    const int last = first + 2 + static_cast<int>(random.below(static_cast<std::uint32_t>(n)));
    box += text(box.empty() ? "" : ",", first, ":", std::min(last, n));
  }
  return {"--roi=" + box};
}

// A count may be missed, by more than one or 2 %, but not silently.
std::string count_differs(double asked, std::size_t came, const Outcome& with) {
  const auto n = static_cast<double>(came);
  const bool met = n <= asked && n >= std::min(asked - 1, 0.98 * asked);
  if (met || !with.warnings.empty()) return {};
  return text("asked for ", asked, ", ", came, " came, and no warning");
}

std::string components_differ(double, const Outcome& with, const Outcome&) {
  const std::uint64_t came = with.verification.mesh.components;
  if (with.capped ? came <= with.chosen_components : came == with.chosen_components) return {};
  return text(came, " components, chosen were ", with.chosen_components);
}

// True if the option of `word` is among the words.
bool has_word(const Words& words, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  return std::ranges::any_of(
      words, [&](const std::string& other) { return other.substr(0, other.find('=')) == name; });
}

bool is_same_mesh(const TriMesh& a, const TriMesh& b) {
  return std::ranges::equal(a.points, b.points) &&
         std::ranges::equal(a.faces, b.faces, {}, &Face::v, &Face::v);
}

std::string another_mesh(double, const Outcome& with, const Outcome& without) {
  const bool same = !without.refusal.empty() || is_same_mesh(with.mesh, without.mesh);
  return same ? "" : "another mesh";
}

constexpr unsigned kCoarser = kLongerEdges | kLargerDistances;
constexpr unsigned kPapers = kCoarser | kMoreVertices | kPaper | kAlways | kNoParts;

// Returns the option behind --paper, with an end: the published program need not end by itself.
Words of_paper(const std::string& option) {
  return {option, "--paper", "--max-vertices=5000"};
}

constexpr DrawnOption kDrawn[] = {
    {"--label",
     [](Random& r, const OptionVolume& v) {
       return v.labels > 0 ? Words{text("--label=", 1 + r.below(v.labels))} : Words{};
     },
     kOtherField | kUsual | kOfLabels},
    {"--shared",  // its name is that of the volume's file
     [](Random&, const OptionVolume& v) { return v.labels > 0 ? Words{"--shared"} : Words{}; },
     kOtherField | kUsual | kNoParts | kNotPaper | kShared | kOfLabels},
    {"--smooth", [](Random& r, auto&) { return Words{"--smooth=" + number(r, 0.3, 2) + "vox"}; },
     kOtherField},
    {"--median", [](Random& r, auto&) { return Words{text("--median=", 1 + r.below(2))}; },
     kOtherField},
    {"--roi", roi, kOtherField},  // filters see only these samples
    {"--largest", [](Random& r, auto&) { return Words{text("--largest=", 1 + r.below(5))}; },
     kNotPaper | kNotShared, components_differ},
    {"--min-component",
     [](Random& r, auto&) { return Words{"--min-component=" + number(r, 0.5, 12)}; },
     kNotPaper | kNotShared, components_differ},
    {"--cap", [](Random&, auto&) { return Words{"--cap"}; }, kNotPaper},
    {"--vertices", [](Random& r, auto&) { return Words{"--vertices=" + whole(r, 4, 2000)}; },
     kCoarser | kMoreVertices | kAlways | kNoParts | kNotPaper,
     [](double asked, const Outcome& with, auto&) {
       return count_differs(asked, with.vertices, with);
     }},
    {"--triangles", [](Random& r, auto&) { return Words{"--triangles=" + whole(r, 8, 4000)}; },
     kCoarser | kMoreVertices | kAlways | kNoParts | kNotPaper,
     [](double asked, const Outcome& with, auto&) {
       return count_differs(asked, with.triangles, with);
     }},
    {"--max-vertices",
     [](Random& r, auto&) { return Words{"--max-vertices=" + whole(r, 20, 4000)}; }, 0,
     [](double asked, const Outcome& with, auto&) {
       return static_cast<double>(with.vertices) > asked ? text(with.vertices, " vertices")
                                                         : std::string();
     }},
    {"--max-distance",
     [](Random& r, auto&) { return Words{"--max-distance=" + number(r, 0.02, 2) + "vox"}; },
     kCoarser | kMoreVertices | kNotPaper},
    {"--lambda", [](Random& r, auto&) { return Words{"--lambda=" + number(r, 1, 5)}; },
     kMoreVertices},
    {"--eps1", [](Random& r, auto&) { return Words{"--eps1=" + number(r, 0.05, 1)}; },
     kCoarser | kMoreVertices},
    {"--max-radius",
     [](Random& r, auto&) { return Words{"--max-radius=" + number(r, 0.3, 4) + "vox"}; },
     kMoreVertices | kNotPaper},
    {"--rmin", [](Random& r, auto&) { return Words{"--rmin=" + number(r, 0.1, 40) + "vox"}; },
     kCoarser | kMoreVertices},
    {"--paper", [](Random& r, auto&) { return of_paper("--rmin=" + number(r, 0.2, 1) + "vox"); },
     kPapers},
    {"--certified", [](Random&, auto&) { return of_paper("--certified"); }, kPapers | kCertified},
    {"--eps", [](Random& r, auto&) { return of_paper("--eps=" + number(r, 0.05, 1)); }, kPapers},
    {"--eps2", [](Random& r, auto&) { return of_paper("--eps2=" + number(r, 0.1, 1)); }, kPapers},
    {"--lines", [](Random& r, auto&) { return of_paper("--lines=" + whole(r, 0, 500)); }, kPapers},
    {"--seed", [](Random& r, auto&) { return of_paper(text("--seed=", r.below(1000))); }, kPapers},
    {"--facet-cycles", [](Random&, auto&) { return of_paper("--facet-cycles"); },
     kPapers | kNotCertified},
    {"--solver", [](Random&, auto&) { return of_paper("--solver=isolation"); }, kPapers},
    {"--stop-after", [](Random&, auto&) { return Words{"--stop-after=stage1"}; },
     kCoarser | kAlways},
    {"--block-side", [](Random& r, auto&) { return Words{text("--block-side=", 4 + r.below(9))}; },
     kCoarser | kMoreVertices | kNotPaper},
    {"--part", [](Random& r, auto&) { return Words{text("--part=1/", 1 + r.below(9))}; },
     kNoParts | kNotPaper | kNotShared, another_mesh},
    {"--threads", [](Random& r, auto&) { return Words{text("--threads=", 2 + r.below(3))}; }, 0,
     another_mesh},
    // Not among those that are picked, so the other draws stay as they were.
    {"--space",
     [](Random& r, auto&) { return Words{text("--space=", r.below(2) > 0 ? "LPS" : "RAS")}; },
     kBeside, another_mesh},
    {"--quiet", [](Random&, auto&) { return Words{"--quiet"}; }, kBeside | kReport, another_mesh},
    {"--json", [](Random&, auto&) { return Words{"--json=v.json"}; }, kBeside | kReport,
     another_mesh},
    {"--coordinates",  // their file lies beside the volume's
     [](Random& r, auto&) { return r.below(2) > 0 ? Words{"--coordinates"} : Words{}; }, kBeside},
    {"--inside", [](Random&, auto&) { return Words{"--inside=below"}; },
     kBeside | kOtherField | kNotLabels},
    {"--free-vertices",  // it needs a number
     [](Random& r, auto&) {
       if (r.below(4) > 0) return Words{};
       return Words{"--free-vertices=" + number(r, 0.01, 2) + "vox",
                    "--triangles=" + whole(r, 8, 4000)};
     },
     kBeside | kCoarser | kMoreVertices | kAlways | kNoParts | kNotPaper | kNotShared},
};

// Options about files, formats and reports; --iso is always given.
constexpr std::string_view kNotDrawn[] = {
    "--iso",        "--output",  "--format", "--ply-ascii",  "--float",       "--double",
    "--attributes", "--verbose", "--check",  "--restricted", "--allow-empty", "--array",
    "--series",     "--channel", "--time",   "--origin",     "--nan",         "--dims",
    "--type",       "--spacing", "--endian", "--skip",       "--help",        "--version"};

}  // namespace

double Outcome::distance() const {
  return std::max(verification.to_surface.max, verification.from_surface.max) / voxel;
}

std::span<const DrawnOption> drawn_options() {
  return kDrawn;
}

Draw draw_options(std::uint64_t seed, const OptionVolume& volume, const DrawnOption* first,
                  unsigned exclude) {
  Random random(seed * 104729);
  const auto table = drawn_options();
  Draw draw;
  std::vector<const DrawnOption*> drawn;
  const auto add = [&](const DrawnOption& option) {
    if (std::ranges::find(drawn, &option) != drawn.end()) return;
    const bool is_first = drawn.empty();
    if (!is_first && (option.exempt & exclude) != 0) return;
    const auto excludes = [&](const DrawnOption* other) {
      const auto are = [&](unsigned both) {
        return ((option.exempt | other->exempt) & both) == both;
      };
      return are(kPaper | kNotPaper) || are(kCertified | kNotCertified) ||
             are(kShared | kNotShared) || are(kOfLabels | kNotLabels);
    };
    if (std::ranges::any_of(drawn, excludes)) return;
    const Words words = option.draw(random, volume);
    if (words.empty()) return;
    drawn.push_back(&option);
    Words& to = is_first ? draw.first_words : draw.other_words;
    std::ranges::copy_if(words, std::back_inserter(to), [&](const std::string& word) {
      return !has_word(draw.first_words, word) && !has_word(draw.other_words, word);
    });
    if (is_first || (option.exempt & kAlways) != 0) draw.exempt |= option.exempt;
  };
  if (first) {
    add(*first);
    if (drawn.empty()) return draw;
  }
  const std::size_t wanted = 1 + random.below(4);
  const auto is_beside = [](const DrawnOption& option) { return (option.exempt & kBeside) != 0; };
  const auto beside = std::ranges::find_if(table, is_beside);  // these are the last
  const auto picked = static_cast<std::uint32_t>(beside - table.begin());
  while (drawn.size() < wanted) add(table[random.below(picked)]);
  for (const DrawnOption& option : table) {
    if ((option.exempt & kUsual) != 0 && random.below(4) > 0) add(option);
    if (is_beside(option) && random.below(2) > 0) add(option);
  }
  draw.first = drawn.front();
  return draw;
}

Words command_words(const std::string& file, double isovalue, const Words& drawn) {
  Words options = drawn;
  for (std::string& word : options) {
    if (word == "--coordinates") word += "=" + file + ".xyz";
  }
  const bool is_label =
      std::ranges::any_of(options, [](const auto& word) { return word.starts_with("--label"); });
  const bool has_threads =
      std::ranges::any_of(options, [](const auto& word) { return word.starts_with("--threads"); });
  Words words{file};
  if (std::ranges::count(options, "--shared") > 0) {
    for (const std::string& word : options) {
      if (word != "--shared" && !word.starts_with("--label")) words.push_back(word);
    }
    for (const char* word : {"--label=all", "--shared", "--ply-ascii", "--double"}) {
      words.emplace_back(word);
      if (words.back() == "--shared") words.push_back(file + ".ply");
    }
    return words;
  }
  if (!is_label) words.push_back(text("--iso=", isovalue));
  if (!has_threads) words.emplace_back("--threads=1");
  words.insert(words.end(), options.begin(), options.end());
  const bool is_part =
      std::ranges::any_of(options, [](const auto& word) { return word.starts_with("--part"); });
  if (is_part) {
    take_report_options(words);
    words.emplace_back("--output=v.part");
  }
  return words;
}

Words take_report_options(Words& words) {
  Words taken;
  const auto is_of_report = [&](const std::string& word) {
    return std::ranges::any_of(kDrawn, [&](const DrawnOption& option) {
      return (option.exempt & kReport) != 0 && has_word({word}, std::string(option.name));
    });
  };
  std::ranges::copy_if(words, std::back_inserter(taken), is_of_report);
  std::erase_if(words, is_of_report);
  return taken;
}

std::string_view undrawn_option() {
  for (const OptionSpec& spec : option_table()) {
    if (!has_option(Command::mesh, spec)) continue;
    const bool is_drawn =
        std::ranges::find(kDrawn, spec.name, &DrawnOption::name) != std::ranges::end(kDrawn);
    if (!is_drawn && std::ranges::find(kNotDrawn, spec.name) == std::ranges::end(kNotDrawn)) {
      return spec.name;
    }
  }
  return {};
}

}  // namespace deliso::stress
