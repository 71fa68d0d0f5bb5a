// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/isolated.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace arete {
namespace {

constexpr IsolationLimits kRoomy{.memoryBytes = std::uint64_t{512} << 20, .answerBytes = 10'000'000};

TEST(Isolated, GivesWhatTheWorkReturns) {
  const std::string big(5'000'000, 'x');
  const Result<std::string> answer = runIsolated([&] { return Result<std::string>(big); }, kRoomy);
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_EQ(*answer, big);
  EXPECT_EQ(runIsolated([] { return Result<std::string>(""); }, kRoomy).value_or("no answer"), "");
}

TEST(Isolated, GivesTheErrorOfTheWork) {
  const auto answer = runIsolated(
      []() -> Result<std::string> { return failure(ErrorCode::unsupported, "is of another kind"); }, kRoomy);
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().code, ErrorCode::unsupported);
  EXPECT_EQ(answer.error().message, "is of another kind");
}

TEST(Isolated, OutlivesACrashAnExceptionAndALongAnswer) {
  const std::vector<std::function<Result<std::string>()>> works = {
      []() -> Result<std::string> {
        std::raise(SIGSEGV);
        return "";
      },
      []() -> Result<std::string> { throw std::runtime_error("no"); },
      []() -> Result<std::string> { return std::string(20'000'000, 'x'); },
  };
  for (std::size_t i = 0; i < works.size(); ++i) {
    const auto answer = runIsolated(works[i], kRoomy);
    ASSERT_FALSE(answer) << i;
    EXPECT_NE(answer.error().code, ErrorCode::outOfMemory) << i;
  }
}

TEST(Isolated, StopsWorkThatTakesTooMuchMemory) {
  const auto answer = runIsolated(
      []() -> Result<std::string> {
        std::vector<std::unique_ptr<std::string>> blocks;
        for (int i = 0; i < 4096; ++i) blocks.push_back(std::make_unique<std::string>(1 << 20, 'x'));
        return std::to_string(blocks.size());
      },
      {.memoryBytes = std::uint64_t{64} << 20, .answerBytes = 1000});
  EXPECT_FALSE(answer);
}

TEST(Isolated, StopsWhenItIsCancelled) {
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const auto begin = std::chrono::steady_clock::now();
  const auto answer = runIsolated(
      []() -> Result<std::string> {
        for (;;) std::this_thread::sleep_for(std::chrono::milliseconds(10));
      },
      kRoomy, context);
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().code, ErrorCode::interrupted);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

}  // namespace
}  // namespace arete
