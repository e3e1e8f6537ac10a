// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "base/check.h"

namespace deliso::test {

// Returns the message of the InputError that the call throws; empty if it throws none.
template <class Call>
std::string refusal_by(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace deliso::test
