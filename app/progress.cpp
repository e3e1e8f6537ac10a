// SPDX-License-Identifier: MIT
#include "app/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "app/output.h"
#include "io/files/append_format.h"

namespace deliso {
namespace {

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

bool can_redraw() {
  const char* terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && terminal != nullptr && std::string_view(terminal) != "dumb";
}

int terminal_columns() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

// "0:07", "1:02:03".
std::string time_text(double seconds) {
  const auto all = static_cast<unsigned long>(std::max(0.0, seconds));
  std::string text;
  if (all >= 3600) {
    append_format(text, "%lu:%02lu:%02lu", all / 3600, all / 60 % 60, all % 60);
  } else {
    append_format(text, "%lu:%02lu", all / 60, all % 60);
  }
  return text;
}

}  // namespace

std::vector<StageCost> mesh_stages(const CommandLine& line) {
  const Options& options = line.options;
  const bool exact = !line.paper, shared = !line.mesh.shared.empty();
  const bool refines = !options.stop_after_stage1;
  const bool examined = !line.quiet || line.mesh.check || !line.json.empty();
  const std::pair<bool, StageCost> all[] = {
      {true, {"reading", 1}},
      {shared, {"fields", 15}},
      {shared, {"labels", 4, "blocks"}},
      {(exact && !shared) || line.certified, {"contour", 4, "blocks"}},
      {exact && !shared, {"cutting", 2, "blocks"}},
      {exact, {"coarsen", 45, "blocks"}},
      {!exact, {"initial", 3}},
      {!exact, {"recover", 20}},
      {!exact && refines, {"poles", 2}},
      {refines, {"refine", exact ? 22.0 : 45.0, "blocks"}},
      {exact, {"weld", 1}},
      {refines && exact, {"seams", 6}},
      {refines && by_count(options), {"thin", 40}},
      {options.cap && !shared, {"cap", 3}},
      {examined, {"check", line.mesh.check ? 150.0 : 6.0}},
      {shared || !line.output.empty(), {"writing", 1}}};
  std::vector<StageCost> stages;
  for (const auto& [is_run, stage] : all) {
    if (is_run) stages.push_back(stage);
  }
  return stages;
}

std::vector<StageCost> info_stages(const CommandLine& line) {
  std::vector<StageCost> stages{{"reading", 2}, {"histogram", 1}, {"thresholds", 5}, {"tries", 2}};
  if (line.isovalue || line.field.of_labels()) stages.push_back({"contour", 8});
  if (!line.output.empty()) stages.push_back({"slices", 1});
  return stages;
}

ProgressModel::ProgressModel(std::vector<StageCost> stages) : stages_(std::move(stages)) {
  for (const StageCost& stage : stages_) total_ += stage.cost;
}

double ProgressModel::at(std::string_view stage, double share) {
  const auto is_meant = [&](const StageCost& s) {
    return s.stage == stage || (!s.together.empty() && s.together == stage);
  };
  const auto first = std::ranges::find_if(stages_, is_meant);
  if (first == stages_.end()) return reached_;
  double cost = 0;
  for (const StageCost& s : stages_) cost += is_meant(s) ? s.cost : 0;
  const double before = std::accumulate(
      stages_.begin(), first, 0.0, [](double sum, const StageCost& s) { return sum + s.cost; });
  // A share that is no number counts as 0.
  const double done = share > 0 ? std::min(share, 1.0) : 0;
  return reached_ = std::max(reached_, std::min(1.0, (before + cost * done) / total_));
}

std::string progress_line(std::string_view stage, double share, double seconds, int columns,
                          bool colored) {
  constexpr int kWidest = 30, kNarrowest = 5;
  constexpr double kEstimateFrom = 5, kEstimateShare = 0.05;  // seconds; of the run
  const double done = std::clamp(share, 0.0, 1.0);
  std::string text;
  // Rounded down: 100 % is the end.
  append_format(text, "%3.0f %%  %-8s %s", std::floor(100 * done), std::string(stage).c_str(),
                time_text(seconds).c_str());
  if (seconds >= kEstimateFrom && done >= kEstimateShare && done < 1) {
    append_format(text, ", %s left", time_text(seconds * (1 - done) / done).c_str());
  }
  const auto room = static_cast<std::size_t>(std::max(columns - 1, 0));
  constexpr std::string_view kBefore = "[", kAfter = "] ";
  const int width = std::min(
      kWidest, columns - 1 - static_cast<int>(kBefore.size() + kAfter.size() + text.size()));
  if (width < kNarrowest) return text.substr(0, room);
  const auto full = static_cast<std::size_t>(done * width);
  std::string line(kBefore);
  if (colored) line += "\033[32m";
  line.append(full, '#');
  if (colored) line += "\033[0m";
  line.append(static_cast<std::size_t>(width) - full, '.');
  return line.append(kAfter) + text;
}

Progress::Progress(std::vector<StageCost> stages)
    : model_(std::move(stages)), start_(Clock::now()), last_(start_) {}

void Progress::restart(std::vector<StageCost> stages) {
  model_ = ProgressModel(std::move(stages));
  stage_.clear();
  start_ = last_ = Clock::now();
}

void Progress::show(std::string_view stage, double share) {
  const double of_all = model_.at(stage, share);
  const Clock::time_point now = Clock::now();
  if (stage == stage_ && now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  stage_ = stage;
  draw(stage_, of_all);
}

ProgressBar::ProgressBar(std::vector<StageCost> stages, bool wanted)
    : Progress(std::move(stages)),
      visible_(wanted && can_redraw()),
      colored_(!is_set("NO_COLOR")) {}

void ProgressBar::draw(const std::string& stage, double share_of_run) {
  if (!visible_) return;
  const std::string line =
      progress_line(stage, share_of_run, seconds(), terminal_columns(), colored_);
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::tell(const Diagnostics& notes) {
  for (const Diagnostic& item : notes) {
    if (item.severity != Severity::warning) continue;
    const std::size_t known = told_.size();
    add_to(told_, item);
    if (told_.size() == known) continue;
    clear();
    print_warnings({item});
  }
}

void ProgressBar::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace deliso
