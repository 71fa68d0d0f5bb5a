// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tests that open a window run again, each by itself, on a virtual screen.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace arete::test {

inline bool isUnderXvfb() {
  return std::getenv("ARETE_TEST_UNDER_XVFB") != nullptr;
}

/// Runs the test that calls it in a process of its own under xvfb-run; `environment`: "NAME=value ...". The
/// exit code, or nothing where there is no xvfb-run.
inline std::optional<int> runUnderXvfb(const std::string& environment = {}) {
  if (std::system("command -v xvfb-run > /dev/null 2>&1") != 0) return std::nullopt;
  const auto* self = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command = "ARETE_TEST_UNDER_XVFB=1 LIBGL_ALWAYS_SOFTWARE=1 " + environment +
                              " xvfb-run -a -s '-screen 0 1280x800x24' '" + program +
                              "' --gtest_filter=" + self->test_suite_name() + "." + self->name();
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace arete::test

/// At the head of a test: what follows runs under Xvfb.
#define ARETE_UNDER_XVFB(environment)                                                        \
  if (!arete::test::isUnderXvfb()) {                                                         \
    const auto code = arete::test::runUnderXvfb(environment);                                \
    if (!code) GTEST_SKIP() << "there is no xvfb-run to open a window under (Debian: xvfb)"; \
    EXPECT_EQ(*code, 0);                                                                     \
    return;                                                                                  \
  }
