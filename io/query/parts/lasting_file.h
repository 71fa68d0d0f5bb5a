// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/store/amt/container.h"

namespace arete {

/// An .amt file that stays open while questions are asked of it. An open file keeps its first problem: after
/// a request that failed, or was stopped, nothing more is read of it. What ended one question is not to end
/// the next, or one of another thread: then the file is opened again, and has to be the same file.
///
/// Thread-safe.
class LastingFile {
 public:
  /// Opens a file as openModelFile() does; it is not mapped. Errors: as openModelFile().
  static Result<LastingFile> open(const std::string& path, const RunContext& context = {});

  /// The file, opened again where it has a problem. Errors: unreadable: it holds something else meanwhile;
  /// as openModelFile(). O(1), or O(chunks) where it is opened again.
  Result<AmtContainer> current(const RunContext& context = {}) const;

  /// The answer to a question: body(container), a Result. It is called again where the reading for another
  /// thread's question was stopped, which ends the requests for all of them.
  template <class Body>
  auto ask(const RunContext& context, const Body& body) const
      -> decltype(body(std::declval<const AmtContainer&>())) {
    for (int left = kTries;; --left) {
      ARETE_TRY(const AmtContainer file, current(context));
      auto answer = body(file);
      if (answer || answer.error().code != ErrorCode::interrupted || context.cancelled() || left == 0)
        return answer;
    }
  }

 private:
  static constexpr int kTries = 8;

  struct State {
    std::mutex mutex;
    AmtContainer file;
  };
  explicit LastingFile(AmtContainer file);

  std::string path_;
  std::unique_ptr<State> state_;
};

}  // namespace arete
