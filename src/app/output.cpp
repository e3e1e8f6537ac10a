// SPDX-License-Identifier: MIT
#include "app/output.h"

#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "base/check.h"
#include "files/atomic_file.h"

namespace deliso {

void print(std::string_view text) {
  write_text("-", text);
}

void write_text(const std::string& path, std::string_view text) {
  AtomicFile out(path);
  out.write(text);
  out.commit();
}

void require_writable(const std::string& path) {
  if (path == "-") return;
  const auto fail = [&](int error) {
    throw InputError("cannot write '" + path + "': " + std::generic_category().message(error));
  };
  struct stat status;
  if (stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) fail(EISDIR);
    if (!S_ISREG(status.st_mode)) return;
  }
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0) fail(errno);
}

DeferSignals::DeferSignals() {
  sigset_t deferred;
  sigemptyset(&deferred);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&deferred, signal);
  pthread_sigmask(SIG_BLOCK, &deferred, &before_);
}

DeferSignals::~DeferSignals() {
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace deliso
