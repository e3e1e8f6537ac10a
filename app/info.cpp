// SPDX-License-Identifier: MIT
#include "app/info.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "app/text.h"
#include "app/topology.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "io/files/append_format.h"
#include "io/filter/looks_like_labels.h"

namespace deliso {
namespace {

constexpr int kBins = 256;
constexpr int kRows = 16;
// Limit for counting the surface's components: a second or two.
constexpr std::size_t kSamples = std::size_t{1} << 25;
constexpr double kCrossings = 1 << 22;

Suggestion suggestion_of(const Threshold& threshold, const Volume& volume,
                         const CommandLine& line) {
  const SurfaceEstimate surface = estimate_surface(volume, threshold.isovalue);
  Suggestion s{threshold, expected_vertices(surface, volume, line.options), std::nullopt};
  if (volume.sample_count() <= kSamples && surface.crossings <= kCrossings) {
    s.components = summarize_contour(volume, threshold.isovalue).components.size();
  }
  return s;
}

std::string percent(double share) {
  return rounded(100 * share, 3) + " %";
}

// Proposes the largest label but 0, and all of them where there are several.
std::string labels_text(const std::vector<LabelSamples>& labels) {
  if (labels.empty()) return "";
  const LabelSamples* largest = nullptr;
  for (const LabelSamples& one : labels) {
    if (one.label != 0 && (!largest || one.samples > largest->samples)) largest = &one;
  }
  std::string text = "samples   look like a segmentation: " + grouped(labels.size()) +
                     " whole numbers in flat pieces\n";
  append_format(text, "try       --label %-8s  %s\n", std::to_string(largest->label).c_str(),
                counted(largest->samples, "sample").c_str());
  if (labels.size() > 2) {
    append_format(
        text, "          --label %-8s  a mesh for each label but 0, with -o part-%%d.ply\n", "all");
  }
  return text;
}

// Returns "about 71,000 vertices, 24 components" or the like; two digits are enough for an
// estimate.
std::string size_text(const Suggestion& s) {
  const double digit = std::pow(10, std::floor(std::log10(std::max(s.vertices, 10.0))) - 1);
  const double about = std::round(s.vertices / digit) * digit;
  std::string text = "about " + grouped(static_cast<std::uint64_t>(about)) + " vertices";
  if (s.components) text += ", " + counted(*s.components, "component");
  return text;
}

std::string suggestions_text(const Info& info) {
  std::string lines;
  for (const Padding& p : info.padding) {
    lines += text(lines.empty() ? "padding   " : "          ", p.value, ", ", percent(p.share),
                  " of the samples: left out of what follows\n");
  }
  lines += labels_text(info.labels);
  const char* heading = info.labels.empty() ? "try     " : "or      ";
  for (const Suggestion& s : info.suggestions) {
    const Threshold& v = s.threshold;
    append_format(lines, "%s  --iso %-10s  %s\n", heading, text(v.isovalue).c_str(),
                  size_text(s).c_str());
    lines += text("                            ", percent(v.below), " of the samples below, ",
                  percent(1 - v.below), " above, between means of ", rounded(v.mean_below), " and ",
                  rounded(v.mean_above), "\n");
    heading = "        ";
  }
  return lines;
}

}  // namespace

Input read_to_inform(const CommandLine& line) {
  try {
    return read_input(line);
  } catch (const SeveralVolumes& several) {
    if (!line.output.empty()) throw;
    CommandLine first = line;
    first.read.channel = line.read.channel.value_or(1);
    first.read.time = line.read.time.value_or(1);
    Input input = read_input(first);
    add_note(input.log.notes, "first-of-several", line.input, several.words, "; this is the first")
        .with("channels", static_cast<double>(several.counts.channels))
        .with("times", static_cast<double>(several.counts.times));
    return input;
  }
}

Info find_info(const Input& input, const CommandLine& line, Progress& progress) {
  const Volume field = input.volume(), volume = input.samples();
  progress.show("histogram", 0);
  const bool of_ids = !input.log.ids.empty() && !input.field.label;
  const ValueRange range = of_ids ? value_range(volume) : *input.range;
  Info info{input, make_histogram(volume, range, kBins), {}, {}, {}, 0, {}, 0, {}, 0};
  progress.show("thresholds", 0);
  const Stopwatch to_suggest;
  if (of_ids || (!input.field.is_filtered() && looks_like_labels(volume))) {
    info.labels = find_labels({volume, input.log.ids}, input.name, line.options.threads);
  }
  if (!input.field.label && !of_ids) {  // a label's isovalue is known
    const Thresholds found = find_thresholds(volume, *input.range);
    info.padding = found.padding;
    for (const Threshold& threshold : found.levels) {
      progress.show("tries", static_cast<double>(info.suggestions.size()) /
                                 static_cast<double>(found.levels.size()));
      info.suggestions.push_back(suggestion_of(threshold, volume, line));
    }
  }
  info.seconds_suggestions = to_suggest.seconds();
  info.isovalue = input.isovalue;
  if (input.isovalue) {
    progress.show("contour", 0);
    const Stopwatch watch;
    const double level = geometric_isovalue(field.type(), input.level());
    info.effective = input.field.mirrored(level);
    info.contour = summarize_contour(field, level);
    info.seconds_contour = watch.seconds();
  }
  return info;
}

std::string info_text(const Info& info) {
  std::string lines =
      text(input_text(info.input), "\n",
           info.input.field.is_filtered() ? "samples of the filtered field:\n" : "",
           info.input.log.ids.empty() ? histogram_text(info.histogram, kRows) + "\n" : "",
           suggestions_text(info), "read      ", fixed(info.input.seconds, 3),
           " s, isovalues to try ", fixed(info.seconds_suggestions, 3), " s\n");
  if (info.isovalue) {
    lines += text("\nisovalue  ", isovalue_text(*info.isovalue, info.effective), "\nsurface   ",
                  topology_text(info.contour.topology()), "\n          in ",
                  info.contour.active_voxels, " voxels, found in ", fixed(info.seconds_contour, 3),
                  " s\n", components_text(info.contour));
  }
  return lines;
}

void add_info(ReportWriter& out, const Info& info) {
  add_input(out, info.input);
  out.add_objects("padding",
                  "a value that fills what was not measured, left out of the suggestions",
                  info.padding, [&](const Padding& p) {
                    out.add("value", p.value, "exactly this");
                    out.add("share", p.share, "of all samples");
                  });
  out.add("looks_like_labels", !info.labels.empty(),
          "the samples are few whole numbers in flat pieces, as in a segmentation: for --label");
  out.add_objects("suggestions", "an isovalue to try, the lower first", info.suggestions,
                  [&](const Suggestion& s) {
                    out.add("isovalue", s.threshold.isovalue, "for --iso");
                    out.add("share_below", s.threshold.below,
                            "of the samples that are neither padding nor outliers");
                    out.add("share_above", 1 - s.threshold.below, "of the same");
                    out.add("mean_below", s.threshold.mean_below, "of the class of samples below");
                    out.add("mean_above", s.threshold.mean_above, "of the class above");
                    out.add("expected_vertices", static_cast<std::uint64_t>(std::round(s.vertices)),
                            "of a mesh by the options given");
                    out.optional(s.components.has_value())
                        .add("components", s.components.value_or(0),
                             "of the exact surface; left out where the volume is large");
                  });
  add_diagnostics(out, info.input.log.notes);
  out.add_seconds("seconds_read", info.input.seconds, "reading, and looking at every sample once");
  out.add_seconds("seconds_suggestions", info.seconds_suggestions, "finding the suggestions");
  if (!out.if_any(info.isovalue.has_value())) return;
  out.open("surface", "with --iso: the exact surface");
  out.add("isovalue", info.isovalue.value_or(0), "as given");
  out.add("isovalue_effective", info.effective,
          "as used: a hair further out where samples or saddles equal it");
  add_inside(out, info.input);
  add_topology(out, "topology", info.contour.topology(), "of the surface");
  out.add("active_voxels", info.contour.active_voxels, "voxels that it meets");
  add_components(out, info.contour);
  out.add_seconds("seconds_contour", info.seconds_contour, "finding it");
  out.close();
}

std::string info_json(const Info& info) {
  ReportWriter out("info");
  add_info(out, info);
  return out.finish();
}

std::string series_text(const std::string& folder, const std::vector<FoundSeries>& series) {
  std::string list = text(one_line(folder), ": ", series.size(), " series; --series N takes one\n");
  for (std::size_t n = 0; n < series.size(); ++n) {
    list += text(n < 9 ? "  " : " ", n + 1, "  ", text_of(series[n]), "\n");
  }
  return list;
}

void add_series(ReportWriter& out, const std::string& folder,
                const std::vector<FoundSeries>& series) {
  out.add("input", folder, "as it was given");
  out.add_objects("series", "a series, or what of it may be one volume: for --series, from 1 on",
                  series, [&](const FoundSeries& found) {
                    out.add("description", found.description, "of the series (SeriesDescription)");
                    out.add("images", found.images, "slices and frames", Rule::not_negative);
                    out.add("columns", found.columns, "of an image", Rule::not_negative);
                    out.add("rows", found.rows, "of an image", Rule::not_negative);
                    out.add("doubt", found.doubt, "why the images may be no volume; empty: none");
                    out.add("file", found.file, "the first, within the folder");
                  });
  Diagnostics notes;
  add_note(notes, "several-series", folder, "holds ", series.size(),
           " series, of which --series N takes one")
      .with("series", static_cast<double>(series.size()));
  add_diagnostics(out, notes);
}

std::string series_json(const std::string& folder, const std::vector<FoundSeries>& series) {
  ReportWriter out("info");
  add_series(out, folder, series);
  return out.finish();
}

}  // namespace deliso
