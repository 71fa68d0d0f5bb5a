// SPDX-License-Identifier: GPL-3.0-or-later
//
// Before a fork no new work begins, the running one is awaited, and tbb::finalize() joins oneTBB's workers.
// finalize() waits for every thread that still keeps data in oneTBB, which threads of the program itself may
// do for ever; a watchdog ends that wait by one more reference to the scheduler. The child gets a state of
// its own: in the old one threads may wait that it does not have.
#include "engine/parallel/guest_work.h"

#include <pthread.h>
#include <tbb/global_control.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <new>

namespace arete {
namespace {

// Workers of an idle machine end in milliseconds, of one that is busy with other programs in seconds.
constexpr std::chrono::milliseconds kLongestWork{1000}, kLongestEnd{5000}, kLongestEndAgain{200};

struct State {
  std::mutex mutex;
  std::condition_variable changed;
  int running = 0;
  bool isForking = false;
  bool hasWorkers = false;  // oneTBB may have some
  bool isHeld = false;      // some other thread kept them once
  bool isLost = false;      // this is a child without the threads that worked
};

State* state = new State;

/// @return whether oneTBB has no workers any more
bool endWorkers(std::chrono::milliseconds longest) {
  tbb::task_scheduler_handle handle{tbb::attach{}};
  std::mutex mutex;
  std::condition_variable changed;
  bool hasEnded = false;
  std::thread watchdog([&] {
    std::unique_lock lock(mutex);
    if (changed.wait_for(lock, longest, [&] { return hasEnded; })) return;
    const tbb::task_scheduler_handle another{tbb::attach{}};
    changed.wait(lock, [&] { return hasEnded; });
  });
  const bool isDone = tbb::finalize(handle, std::nothrow);
  {
    const std::lock_guard lock(mutex);
    hasEnded = true;
  }
  changed.notify_one();
  watchdog.join();
  return isDone;
}

void beforeFork() {
  State& s = *state;
  std::unique_lock lock(s.mutex);
  s.isForking = true;
  const bool isIdle = s.changed.wait_for(lock, kLongestWork, [&] { return s.running == 0; });
  if (isIdle && s.hasWorkers) {
    try {
      s.hasWorkers = !endWorkers(s.isHeld ? kLongestEndAgain : kLongestEnd);
      s.isHeld = s.hasWorkers;
    } catch (...) {  // no thread, no memory
    }
  }
  lock.release();  // it stays locked until both go on
}

void inParent() {
  state->isForking = false;
  state->mutex.unlock();
  state->changed.notify_all();
}

void inChild() {
  const bool isLost = state->isLost || state->running > 0 || state->hasWorkers;
  // The old state is left: it cannot be destroyed while threads wait in it.
  state = new State;
  state->isLost = isLost;
}

}  // namespace

GuestWork::GuestWork() {
  [[maybe_unused]] static const int registered = ::pthread_atfork(beforeFork, inParent, inChild);
  std::unique_lock lock(state->mutex);
  state->changed.wait(lock, [] { return !state->isForking; });
  ++state->running;
  state->hasWorkers = true;
}

GuestWork::~GuestWork() {
  const std::lock_guard lock(state->mutex);
  --state->running;
  state->changed.notify_all();
}

Status GuestWork::mayRun() const {
  if (!state->isLost) return {};
  return failure(ErrorCode::unsupported,
                 "this process was forked while threads of Arete were at work, and has none of them: start "
                 "processes by spawning (in Python multiprocessing.get_context(\"spawn\")), or fork while no "
                 "question is being answered");
}

}  // namespace arete
