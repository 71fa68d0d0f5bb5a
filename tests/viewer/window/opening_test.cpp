// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/opening.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "viewer/under_xvfb.h"

namespace arete {
namespace {

Result<GlfwWindow> smallWindow() {
  return GlfwWindow::open("test", 320, 240, false);
}

TEST(Opening, ShowsItsWindowWhileTheWorkRunsAndHandsItsReportsOn) {
  ARETE_UNDER_XVFB("");
  auto window = smallWindow();
  ASSERT_TRUE(window) << window.error().describe();
  std::atomic<bool> wasShown = false;
  std::atomic<int> reports = 0;
  RunContext context;
  context.progress = [&](std::string_view, double) { ++reports; };
  const auto done = showWhile(
      *window, {"dem.tif", "a hint"},
      [&](const RunContext& inner) -> Status {
        for (int i = 0; i < 40 && !wasShown; ++i) {
          inner.report("build", i / 40.0);
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
          wasShown = glfwGetWindowAttrib(window->handle(), GLFW_VISIBLE) != 0;
        }
        return {};
      },
      context);
  ASSERT_TRUE(done) << done.error().describe();
  EXPECT_TRUE(*done);
  EXPECT_TRUE(wasShown) << "before the work is done";
  EXPECT_GT(reports, 0);
}

TEST(Opening, ClosingTheWindowCancelsTheWorkAndIsNoError) {
  ARETE_UNDER_XVFB("");
  auto window = smallWindow();
  ASSERT_TRUE(window) << window.error().describe();
  std::atomic<bool> isCancelled = false;
  const auto done = showWhile(*window, {"dem.tif", ""}, [&](const RunContext& inner) -> Status {
    glfwSetWindowShouldClose(window->handle(), GLFW_TRUE);
    while (!inner.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    isCancelled = true;
    return failure(ErrorCode::interrupted, "interrupted");
  });
  ASSERT_TRUE(done) << done.error().describe();
  EXPECT_FALSE(*done);
  EXPECT_TRUE(isCancelled);
}

TEST(Opening, AnErrorOfTheWorkAndAnInterruptionEndIt) {
  ARETE_UNDER_XVFB("");
  auto window = smallWindow();
  ASSERT_TRUE(window) << window.error().describe();
  const auto wrong = showWhile(*window, {"dem.tif", ""}, [](const RunContext&) -> Status {
    return failure(ErrorCode::corrupt, "is cut short", "dem.tif");
  });
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().describe(), "dem.tif: is cut short");
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const auto ended = showWhile(
      *window, {"dem.tif", ""},
      [](const RunContext& inner) -> Status {
        while (!inner.cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return {};
      },
      context);
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace arete
