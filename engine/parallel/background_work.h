// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/base/result.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// Work on a thread of its own, for a program that draws meanwhile: it asks how far the work is, ends it, and
/// takes its result. One processor is left for the program. Its functions are called on one thread.
template <class Value>
class BackgroundWork {
 public:
  struct Progress {
    std::string stage;
    double fraction = 0;  ///< of the stage, 0 to 1
  };

  BackgroundWork() = default;
  BackgroundWork(const BackgroundWork&) = delete;
  BackgroundWork& operator=(const BackgroundWork&) = delete;
  ~BackgroundWork() { cancel(); }

  /// Begins; what was begun before is cancelled. A report of progress is handed to `context.progress` too, on
  /// the thread of the work. An exception that leaves the work is an error, as caughtFailure() has it.
  void start(std::function<Result<Value>(const RunContext&)> work, const RunContext& context = {}) {
    cancel();
    state_ = std::make_unique<State>();
    thread_ = std::thread([state = state_.get(), work = std::move(work), context] {
      RunContext inner = context;
      inner.cancel = &state->cancel;
      inner.threads = std::max(1, int(std::thread::hardware_concurrency()) - 1);
      inner.progress = [state, &context](std::string_view stage, double fraction) {
        {
          const std::lock_guard lock(state->mutex);
          state->progress = {std::string(stage), fraction};
        }
        context.report(stage, fraction);
      };
      state->result = [&]() -> Result<Value> {
        try {
          return work(inner);
        } catch (...) {
          return caughtFailure();
        }
      }();
      state->isDone = true;
    });
  }

  /// From start() until its result is taken, or until cancel().
  bool isRunning() const { return state_ != nullptr; }
  Progress progress() const {
    if (!state_) return {};
    const std::lock_guard lock(state_->mutex);
    return state_->progress;
  }
  /// Ends the work and waits for it; nothing is left to take.
  void cancel() {
    if (!state_) return;
    state_->cancel = true;
    thread_.join();
    state_.reset();
  }
  /// The result, once it is there.
  std::optional<Result<Value>> take() {
    if (!state_ || !state_->isDone) return std::nullopt;
    thread_.join();
    std::optional<Result<Value>> result = std::move(state_->result);
    state_.reset();
    return result;
  }

 private:
  struct State {
    std::atomic<bool> cancel = false, isDone = false;
    mutable std::mutex mutex;  // of the progress
    Progress progress;
    std::optional<Result<Value>> result;  // read after isDone is set
  };
  std::unique_ptr<State> state_;
  std::thread thread_;
};

}  // namespace arete
