// SPDX-License-Identifier: MIT
#include "support/run_program.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "base/check.h"

namespace deliso {
namespace {

constexpr int kNotRun = 127;  // as a shell has it

[[noreturn]] void fail(const std::string& program) {
  throw InputError(program + ": " + std::generic_category().message(errno));
}

}  // namespace

Ended run_program(const std::vector<std::string>& words, unsigned limit) {
  const std::string& program = words.front();
  if (access(program.c_str(), X_OK) != 0) fail(program);
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

  const pid_t child = fork();
  if (child < 0) fail(program);
  if (child == 0) {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(nowhere, STDOUT_FILENO);
    const rlimit cpu{limit, limit};
    setrlimit(RLIMIT_CPU, &cpu);
    execv(program.c_str(), arguments.data());
    _exit(kNotRun);
  }
  int status = 0;
  rusage used{};
  while (wait4(child, &status, 0, &used) < 0) {
    if (errno != EINTR) fail(program);
  }
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          seconds(used.ru_utime) + seconds(used.ru_stime)};
}

}  // namespace deliso
