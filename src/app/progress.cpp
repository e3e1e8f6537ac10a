// SPDX-License-Identifier: MIT
#include "app/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

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

}  // namespace

Progress::Progress(bool wanted)
    : visible_(wanted && can_redraw()), coloured_(!is_set("NO_COLOR")), last_(Clock::now()) {}

void Progress::show(const char* stage, double share) {
  if (!visible_) return;
  const Clock::time_point now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;

  constexpr int kWidth = 30;
  const int done = static_cast<int>(std::clamp(share, 0.0, 1.0) * kWidth);
  const std::string full(static_cast<std::size_t>(done), '#');
  const std::string rest(static_cast<std::size_t>(kWidth - done), '.');
  std::fprintf(stderr, "\r\033[K%-12s [%s%s%s%s] %3.0f %%", stage, coloured_ ? "\033[32m" : "",
               full.c_str(), coloured_ ? "\033[0m" : "", rest.c_str(),
               100 * std::clamp(share, 0.0, 1.0));
  std::fflush(stderr);
  drawn_ = true;
}

void Progress::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace deliso
