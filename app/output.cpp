// SPDX-License-Identifier: MIT
#include "app/output.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>

#include "base/check.h"
#include "io/files/atomic_file.h"
#include "io/files/text_scan.h"

namespace deliso {
namespace {

namespace fs = std::filesystem;

// The identity of a file: device and inode if it exists, else its path.
struct FileName {
  dev_t device = 0;
  ino_t inode = 0;
  std::string missing;
  friend bool operator==(const FileName&, const FileName&) = default;
};

// Returns the regular file, existing or future, at `path`; nullopt for devices, pipes and built-in
// fields. `stream`: the descriptor of `-`.
std::optional<FileName> file_named(const std::string& path, int stream) {
  if (path.empty() || path.starts_with("builtin:")) return std::nullopt;
  struct stat status {};
  const bool exists = path == "-" ? fstat(stream, &status) == 0 : stat(path.c_str(), &status) == 0;
  if (exists) {
    if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) return std::nullopt;
    return FileName{status.st_dev, status.st_ino, {}};
  }
  if (path == "-") return std::nullopt;
  std::error_code error;
  const fs::path place = fs::weakly_canonical(fs::absolute(follow_links(path), error), error);
  return FileName{0, 0, error ? path : place.string()};
}

}  // namespace

void print(std::string_view text) {
  write_text("-", text);
}

void print_report(std::string_view text, bool stdout_taken) {
  if (!stdout_taken) return print(text);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void print_warnings(const Diagnostics& notes) {
  for (const Diagnostic& item : notes) {
    if (item.severity != Severity::warning) continue;
    std::fprintf(stderr, "deliso: warning: %s\n", text_of(item).c_str());
  }
}

void write_text(const std::string& path, std::string_view text) {
  AtomicFile out(path);
  out.write(text);
  out.commit();
}

void require_outputs(std::span<const std::string> outputs, std::span<const std::string> inputs) {
  for (std::size_t n = 0; n < outputs.size(); ++n) {
    const std::optional<FileName> output = file_named(outputs[n], STDOUT_FILENO);
    if (!output) continue;
    const auto refuse = [&](const char* what, const std::string& other) {
      throw InputError("cannot write ", quote(outputs[n]), ": this run ", what, " that file as ",
                       quote(other));
    };
    for (const std::string& input : inputs) {
      if (file_named(input, STDIN_FILENO) == output) refuse("reads", input);
    }
    for (const std::string& earlier : outputs.first(n)) {
      if (file_named(earlier, STDOUT_FILENO) == output) refuse("writes", earlier);
    }
    // Opens it as the run will, without effect on the target.
    if (outputs[n] != "-") const AtomicFile probe(outputs[n]);
  }
}

}  // namespace deliso
