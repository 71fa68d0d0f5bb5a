// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/fronts/cut_worker.h"

#include <algorithm>
#include <utility>

namespace arete {

std::shared_ptr<CutWorker> CutWorker::shared() {
  static std::mutex mutex;
  static std::weak_ptr<CutWorker> last;
  const std::lock_guard lock(mutex);
  std::shared_ptr<CutWorker> worker = last.lock();
  if (!worker) last = worker = std::make_shared<CutWorker>();
  return worker;
}

// The thread starts when all that it uses is there.
CutWorker::CutWorker() : thread_([this] { run(); }) {}

CutWorker::~CutWorker() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void CutWorker::post(const void* owner, std::function<void()> job) {
  {
    const std::lock_guard lock(mutex_);
    const auto same = std::ranges::find(waiting_, owner, &Job::owner);
    if (same != waiting_.end())
      same->work = std::move(job);
    else
      waiting_.push_back({owner, std::move(job)});
  }
  wake_.notify_all();
}

void CutWorker::stop(const void* owner) {
  std::unique_lock lock(mutex_);
  std::erase_if(waiting_, [&](const Job& job) { return job.owner == owner; });
  finished_.wait(lock, [&] { return running_ != owner; });
}

void CutWorker::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [&] { return ends_ || !waiting_.empty(); });
    if (ends_) return;
    const Job job = std::move(waiting_.front());
    waiting_.pop_front();
    running_ = job.owner;
    lock.unlock();
    job.work();
    lock.lock();
    running_ = nullptr;
    finished_.notify_all();
  }
}

}  // namespace arete
