// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/parallel/background_work.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>

namespace arete {
namespace {

/// The result, when it is there.
template <class Value>
Result<Value> waitedFor(BackgroundWork<Value>& work) {
  while (true) {
    if (auto done = work.take()) return std::move(*done);
    std::this_thread::yield();
  }
}

TEST(BackgroundWork, GivesItsResultOnce) {
  BackgroundWork<int> work;
  EXPECT_FALSE(work.isRunning());
  EXPECT_FALSE(work.take());
  work.start([](const RunContext&) -> Result<int> { return 42; });
  EXPECT_TRUE(work.isRunning());
  EXPECT_EQ(waitedFor(work).value(), 42);
  EXPECT_FALSE(work.isRunning());
  EXPECT_FALSE(work.take());
}

TEST(BackgroundWork, SaysHowFarItIsToTheProgramAndToTheContext) {
  std::atomic<bool> mayEnd = false;
  std::atomic<int> reports = 0;
  RunContext context;
  context.progress = [&](std::string_view, double) { ++reports; };
  BackgroundWork<int> work;
  work.start(
      [&](const RunContext& inner) -> Result<int> {
        inner.report("read", 0.5);
        inner.report("build", 0.25);
        while (!mayEnd) std::this_thread::yield();
        return 1;
      },
      context);
  while (reports < 2) std::this_thread::yield();
  EXPECT_EQ(work.progress().stage, "build");
  EXPECT_EQ(work.progress().fraction, 0.25);
  EXPECT_FALSE(work.take()) << "not done yet";
  mayEnd = true;
  EXPECT_TRUE(waitedFor(work));
}

TEST(BackgroundWork, EndsWhenItIsCancelledOrReplacedOrForgotten) {
  std::atomic<int> ended = 0;
  const auto untilCancelled = [&](const RunContext& context) -> Result<int> {
    while (!context.cancelled()) std::this_thread::yield();
    ++ended;
    return failure(ErrorCode::interrupted, "interrupted");
  };
  {
    BackgroundWork<int> work;
    work.start(untilCancelled);
    work.cancel();
    EXPECT_EQ(ended, 1);
    EXPECT_FALSE(work.isRunning());
    work.start(untilCancelled);
    work.start(untilCancelled);
    EXPECT_EQ(ended, 2);
  }
  EXPECT_EQ(ended, 3);
}

TEST(BackgroundWork, AnErrorAndAnExceptionAreItsResult) {
  BackgroundWork<std::string> work;
  work.start(
      [](const RunContext&) -> Result<std::string> { return failure(ErrorCode::corrupt, "is cut short"); });
  EXPECT_EQ(waitedFor(work).error().code, ErrorCode::corrupt);
  work.start([](const RunContext&) -> Result<std::string> { throw std::bad_alloc(); });
  EXPECT_EQ(waitedFor(work).error().code, ErrorCode::outOfMemory);
}

}  // namespace
}  // namespace arete
