// SPDX-License-Identifier: MIT
#include "support/quality.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

#include "base/check.h"
#include "base/text.h"
#include "check/verify.h"
#include "contour/contour.h"
#include "io/files/text_scan.h"

namespace deliso {
namespace {

constexpr std::array<std::string_view, 4> kLabels{"build", "volume", "options", "turn"};

std::optional<double> parse(std::string_view field) {
  return field == "-" ? std::numeric_limits<double>::quiet_NaN() : number_in<double>(field);
}

// The faults that have no metric of their own.
std::size_t other_faults(const Verification& v) {
  std::size_t count = v.to_surface.not_found + v.from_surface.given_up;
  for (std::size_t n = 0; n < kFaultKinds; ++n) {
    switch (static_cast<FaultKind>(n)) {
      case FaultKind::self_intersections:
      case FaultKind::missing_components:
      case FaultKind::extra_components:
      case FaultKind::different_components:
      case FaultKind::turned_components:
      case FaultKind::restricted_share:
      case FaultKind::too_far:
        break;
      default:
        count += v.faults.count(static_cast<FaultKind>(n));
    }
  }
  return count;
}

}  // namespace

Measured measure(const TriMesh& mesh, const Volume& volume, double isovalue, const Options& options,
                 int threads) {
  VerifyOptions asked;
  asked.threads = threads;
  asked.limits = resolve(options, volume).refinement;
  asked.limits.shape_floor = 0;
  const Verification v = verify(mesh, volume, geometric_isovalue(volume.type(), isovalue), asked);

  const double voxel = volume.voxel();
  const auto count = [](std::uint64_t n) { return static_cast<double>(n); };
  Measured m;
  m[Metric::vertices] = count(v.vertices);
  m[Metric::needles] = count(v.quality.over_lambda);
  m[Metric::needles_above_r_min] = count(v.quality.over_lambda_above_r_min);
  m[Metric::min_angle] = v.quality.min_angle;
  m[Metric::facets_over] = count(v.over_a_limit);
  // Without a limit on the distance no point is too far.
  if (asked.limits.asks(Criterion::distance)) {
    m[Metric::points_far] = count(v.from_surface.beyond);
  }
  m[Metric::mesh_mean] = v.to_surface.mean / voxel;
  m[Metric::mesh_999] = v.to_surface.quantile_999 / voxel;
  m[Metric::mesh_max] = v.to_surface.max / voxel;
  m[Metric::surface_mean] = v.from_surface.mean / voxel;
  m[Metric::surface_999] = v.from_surface.quantile_999 / voxel;
  m[Metric::surface_max] = v.from_surface.max / voxel;
  if (v.delaunay.measured) m[Metric::restricted] = 100 * v.delaunay.share();
  m[Metric::crossings] = count(v.faults.count(FaultKind::self_intersections));
  m[Metric::exact] = v.mesh.components == v.exact.components &&
                             v.equal_components == v.exact.components &&
                             v.faults.count(FaultKind::turned_components) == 0
                         ? 1
                         : 0;
  m[Metric::other_faults] = count(other_faults(v));
  m[Metric::failed] = 0;
  return m;
}

double reported(std::string_view json, std::string_view key) {
  const std::string name = text("\"", key, "\": ");
  const std::size_t at = json.find(name);
  if (at == std::string_view::npos) return std::numeric_limits<double>::quiet_NaN();
  const std::size_t begin = at + name.size();
  const std::size_t end = std::min(json.find_first_of(",\n}", begin), json.size());
  return parse(std::string(json.substr(begin, end - begin)))
      .value_or(std::numeric_limits<double>::quiet_NaN());
}

std::string header_of_runs() {
  std::string line;
  for (const std::string_view label : kLabels) line.append(label).append("\t");
  for (const MetricRow& row : kMetricTable) line.append(row.key).append("\t");
  line.back() = '\n';
  return line;
}

std::string line_of(const QualityRun& run) {
  std::string line = text(run.build, "\t", run.volume, "\t", run.options, "\t", run.turn);
  for (const double value : run.measured.values) {
    char digits[32] = "-";
    if (value == value) std::snprintf(digits, sizeof digits, "%.9g", value);
    line.append("\t").append(digits);
  }
  return line + "\n";
}

std::vector<QualityRun> read_runs(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw InputError(path + ": cannot be opened");
  std::string first, line;
  std::getline(in, first);
  const std::vector<std::string_view> header = split(first, '\t');
  if (!std::equal(
          kLabels.begin(), kLabels.end(), header.begin(),
          header.begin() + static_cast<std::ptrdiff_t>(std::min(header.size(), kLabels.size())))) {
    throw InputError(path + ": is no file of runs");
  }
  std::vector<QualityRun> runs;
  std::set<std::string> builds;
  for (std::size_t number = 2; std::getline(in, line); ++number) {
    const std::vector<std::string_view> fields = split(line, '\t');
    if (fields.size() != header.size()) {
      throw InputError(text(path, " line ", number, ": has another number of fields"));
    }
    QualityRun run{std::string(fields[0]), std::string(fields[1]), std::string(fields[2]), 0, {}};
    for (std::size_t c = 3; c < fields.size(); ++c) {
      const std::optional<double> value = parse(fields[c]);
      if (!value) {
        throw InputError(text(path, " line ", number, ": '", fields[c], "' is not a number"));
      }
      if (c == 3) run.turn = static_cast<std::uint64_t>(*value);
      const auto row = std::find_if(kMetricTable.begin(), kMetricTable.end(),
                                    [&](const MetricRow& r) { return r.key == header[c]; });
      if (row == kMetricTable.end()) continue;
      run.measured.values[static_cast<std::size_t>(row - kMetricTable.begin())] = *value;
    }
    builds.insert(run.build);
    runs.push_back(std::move(run));
  }
  if (runs.empty()) throw InputError(path + ": has no runs");
  const std::string name = std::filesystem::path(path).filename().string();
  for (QualityRun& run : runs) run.build = builds.size() > 1 ? name + ":" + run.build : name;
  return runs;
}

}  // namespace deliso
