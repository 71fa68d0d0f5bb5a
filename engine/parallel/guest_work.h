// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <optional>
#include <thread>

#include "engine/base/result.h"

namespace arete {

/// A piece of work of ours in a program that is not ours and may fork() at any moment. A child has the thread
/// that forked and no other one; oneTBB would wait for its workers, and for a thread that held one of its
/// locks. So fork() waits for our work, but for a second at most, and then lets the workers end; parent and
/// child start new ones. Where the machine is busy that takes seconds. In a child of a program whose work did
/// not end so soon, or whose own threads keep oneTBB's workers, no work may run any more.
class GuestWork {
 public:
  /// Waits while the program forks.
  GuestWork();
  ~GuestWork();
  GuestWork(const GuestWork&) = delete;
  GuestWork& operator=(const GuestWork&) = delete;

  /// Errors: unsupported: this is such a child.
  Status mayRun() const;
};

/// Runs body() on a thread of its own as guest work: oneTBB keeps data for every thread that used it, as long
/// as that thread lives, and its workers cannot end before. What the body throws is thrown here.
/// @param body returns a Result or a Status
template <class Body>
auto runAsGuest(const Body& body) -> decltype(body()) {
  std::optional<decltype(body())> answer;
  std::exception_ptr thrown;
  std::thread([&] {
    try {
      const GuestWork work;
      if (const Status may = work.mayRun(); !may)
        answer.emplace(tl::unexpected(may.error()));
      else
        answer.emplace(body());
    } catch (...) {
      thrown = std::current_exception();
    }
  }).join();
  if (thrown) std::rethrow_exception(thrown);
  return std::move(*answer);
}

}  // namespace arete
