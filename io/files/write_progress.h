// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// Reports the progress of writing a mesh, record by record, and checks for cancellation.
class WriteProgress {
 public:
  WriteProgress(std::size_t records, std::string path, const RunContext& context)
      : records_(records), path_(std::move(path)), context_(context) {}

  /// Call before each record. @return True if the context is cancelled; return interrupted() then.
  bool shouldStop() {
    if (done_++ % kRecordsPerCheck != 0) return false;
    context_.report("writing the mesh", static_cast<double>(done_) / static_cast<double>(records_));
    return context_.cancelled();
  }
  tl::unexpected<Error> interrupted() const {
    return failure(ErrorCode::interrupted, "writing was interrupted", path_);
  }

 private:
  static constexpr std::size_t kRecordsPerCheck = 1 << 16;

  std::size_t records_, done_ = 0;
  std::string path_;
  const RunContext& context_;
};

}  // namespace arete
