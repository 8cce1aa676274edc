// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <gmock/gmock.h>

#include "orb/error.h"

namespace corvo::test {

/// Returns the message of the corvo::Error that `action` throws. Fails the test if it throws none.
template <typename Action>
std::string ErrorOf(Action&& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "expected a corvo::Error";
  return "";
}

}  // namespace corvo::test
