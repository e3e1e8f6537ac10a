// SPDX-License-Identifier: MIT
// The progress of a whole run. The program draws one bar on standard error. It appears only in a
// terminal, and disappears at the end.
//
// Every stage has a share of the bar: its typical share of the time. It was measured on ENGINE,
// BABY and LEG, by default and by the paper's way (docs/results.md has the data sets). On other
// volumes the bar may run unevenly. Still:
//   B1  It never goes back, and an unknown stage changes nothing.
//   B2  It reaches 100 % only in the last stage.
//   B3  Every line is narrower than the terminal, so that none wraps.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "app/command_line.h"
#include "base/diagnostics.h"
#include "run/observer.h"

namespace deliso {

struct StageCost {
  std::string_view stage;
  double cost;  // in any unit
  // A stage that stands for this one and those beside it with the same name: a run in blocks has
  // all stages of a block at once.
  std::string_view together = {};
};

// The stages of the mesh command, in order: reading, those of the Observer, check, writing. A run
// in one block has no "weld" and no "seams". One of --shared has the labels' fields, and T_L in
// place of the contour.
std::vector<StageCost> mesh_stages(const CommandLine& line);
// Those of the info command.
std::vector<StageCost> info_stages(const CommandLine& line);

// The share of the run that is done, with B1 and B2.
class ProgressModel {
 public:
  explicit ProgressModel(std::vector<StageCost> stages);
  // Returns the share of the run, in [0, 1], if `share` of the stage is done.
  double at(std::string_view stage, double share);

 private:
  std::vector<StageCost> stages_;
  double total_ = 0, reached_ = 0;
};

// Returns "[####......]  42 %  coarsen  0:07, 0:09 left" or the like, without an end of
// line. The time left is told after some seconds, as if the rest went like what is done. The line
// is at most columns - 1 wide; a narrow terminal has a shorter bar, or none.
std::string progress_line(std::string_view stage, double share, double seconds, int columns,
                          bool colored);

class Progress : public Observer {
 public:
  explicit Progress(std::vector<StageCost> stages);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void stage_begins(const char* stage) override { show(stage, 0); }
  // An estimate: a queue grows during the work, and other queues may follow.
  void steps_done(std::size_t done, std::size_t queued) override {
    const auto steps = static_cast<double>(done);
    show(std::string(stage_), steps / (steps + static_cast<double>(queued)));
  }

  // Shows that `share` of the stage is done, in [0, 1]. Cheap to call often: it calls draw() when a
  // stage begins, and ten times a second.
  void show(std::string_view stage, double share);
  // Begins another run.
  void restart(std::vector<StageCost> stages);
  virtual void clear() {}
  // Shows the warnings that it has not shown yet.
  virtual void tell(const Diagnostics&) {}

 protected:
  // Shows the share of the run that is done. Called by one thread at a time.
  virtual void draw(const std::string& stage, double share_of_run) = 0;
  double seconds() const { return std::chrono::duration<double>(last_ - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;

  ProgressModel model_;
  std::string stage_;
  Clock::time_point start_, last_;
};

class ProgressBar : public Progress {
 public:
  // Shows nothing if `wanted` is false or standard error is no terminal that can redraw a line.
  ProgressBar(std::vector<StageCost> stages, bool wanted);
  ~ProgressBar() override { ProgressBar::clear(); }
  void clear() override;
  // On standard error, even if the bar is not wanted.
  void tell(const Diagnostics& notes) override;

 private:
  void draw(const std::string& stage, double share_of_run) override;

  bool visible_;
  bool colored_;
  bool drawn_ = false;
  Diagnostics told_;
};

}  // namespace deliso
