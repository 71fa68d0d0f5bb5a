// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/parallel/guest_work.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>
#include <vector>

namespace arete {
namespace {

using namespace std::chrono_literals;

Result<int> sum() {
  return runAsGuest([]() -> Result<int> {
    std::atomic<int> all = 0;
    tbb::parallel_for(0, 1000, [&](int i) { all += i; });
    return all.load();
  });
}

/// What a child gives back: its exit status; -1 where it does not end.
template <class Body>
int inChild(const Body& body) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(body());
  for (int i = 0; i < 2000; ++i) {
    int status = 0;
    if (::waitpid(child, &status, WNOHANG) == child) return WIFEXITED(status) ? WEXITSTATUS(status) : -2;
    std::this_thread::sleep_for(10ms);
  }
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  return -1;
}

TEST(GuestWork, RunsInTheChildrenOfAProgramWhoseThreadsHaveWorked) {
  for (int round = 0; round < 20; ++round) {
    std::vector<std::thread> threads;
    for (int t = 0; t < 3; ++t) threads.emplace_back([] { EXPECT_EQ(sum(), 499500); });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(inChild([] { return sum() == 499500 ? 7 : 8; }), 7) << "round " << round;
    EXPECT_EQ(sum(), 499500);  // and in the parent again
  }
}

TEST(GuestWork, RunsInTheChildOfAChild) {
  EXPECT_EQ(sum(), 499500);
  EXPECT_EQ(
      inChild([] { return sum() == 499500 && inChild([] { return sum() == 499500 ? 7 : 8; }) == 7 ? 7 : 9; }),
      7);
}

TEST(GuestWork, IsAwaitedByAFork) {
  std::atomic<bool> hasBegun = false, hasEnded = false;
  std::thread thread([&] {
    EXPECT_TRUE(runAsGuest([&]() -> Status {
      hasBegun = true;
      std::this_thread::sleep_for(100ms);
      hasEnded = true;
      return {};
    }));
  });
  while (!hasBegun) std::this_thread::yield();
  EXPECT_EQ(inChild([&] { return hasEnded && sum() == 499500 ? 7 : 8; }), 7);
  thread.join();
}

TEST(GuestWork, IsRefusedInTheChildOfAProgramWhoseWorkGoesOn) {
  std::atomic<bool> hasBegun = false, mayEnd = false;
  std::thread thread([&] {
    EXPECT_TRUE(runAsGuest([&]() -> Status {
      hasBegun = true;
      while (!mayEnd) std::this_thread::sleep_for(1ms);
      return {};
    }));
  });
  while (!hasBegun) std::this_thread::yield();
  EXPECT_EQ(inChild([] {
              const Result<int> answer = sum();
              return !answer && answer.error().message.find("spawn") != std::string::npos ? 7 : 8;
            }),
            7);
  mayEnd = true;
  thread.join();
  EXPECT_EQ(sum(), 499500);
}

}  // namespace
}  // namespace arete
