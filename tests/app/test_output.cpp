// SPDX-License-Identifier: MIT
#include "app/output.h"

#include <doctest/doctest.h>

#include <csignal>

#include "base/check.h"

using namespace deliso;

namespace {

volatile std::sig_atomic_t signals_seen = 0;

void count_signal(int) {
  signals_seen = signals_seen + 1;
}

}  // namespace

TEST_CASE("signals wait until writing is done, and then arrive") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto before = std::signal(signal, count_signal);
    signals_seen = 0;
    {
      const DeferSignals defer;
      std::raise(signal);
      CHECK(signals_seen == 0);
    }
    CHECK(signals_seen == 1);
    std::raise(signal);
    CHECK(signals_seen == 2);
    std::signal(signal, before);
  }
}

TEST_CASE("what cannot be written is known before the work") {
  CHECK_NOTHROW(require_writable("-"));
  CHECK_NOTHROW(require_writable("/dev/null"));
  CHECK_NOTHROW(require_writable("mesh-of-the-test.ply"));
  CHECK_THROWS_AS(require_writable("/no/such/folder/mesh.ply"), InputError);
  CHECK_THROWS_AS(require_writable("/"), InputError);
  CHECK_THROWS_AS(require_writable("."), InputError);
}
