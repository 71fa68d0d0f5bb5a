// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace arete {

/// One thread that takes the cuts of all objects while pictures are drawn. Thread-safe.
class CutWorker {
 public:
  /// The one of the process, which ends with its last owner.
  static std::shared_ptr<CutWorker> shared();
  CutWorker();
  ~CutWorker();
  CutWorker(const CutWorker&) = delete;
  CutWorker& operator=(const CutWorker&) = delete;

  /// Does a job of an owner after those that wait. It replaces the owner's job that waits, in its place.
  void post(const void* owner, std::function<void()> job);
  /// Drops the owner's job that waits, and returns when none of its jobs runs.
  void stop(const void* owner);

 private:
  struct Job {
    const void* owner;
    std::function<void()> work;
  };
  void run();

  std::mutex mutex_;
  std::condition_variable wake_, finished_;
  std::deque<Job> waiting_;
  const void* running_ = nullptr;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace arete
