// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two files are the same where their directories of chunks are: these have the checksums of all that lies in
// the file, or of the directories of checksums of what is read in part.
#include "io/query/parts/lasting_file.h"

#include <algorithm>
#include <span>

#include "engine/base/caught_failure.h"
#include "io/query/extract/model_file.h"

namespace arete {
namespace {

bool haveSameChunks(std::span<const AmtChunk> a, std::span<const AmtChunk> b) {
  return std::ranges::equal(a, b, [](const AmtChunk& one, const AmtChunk& other) {
    return one.tag == other.tag && one.offset == other.offset && one.bytes == other.bytes &&
           one.checksum == other.checksum;
  });
}

AmtOpenOptions optionsOf(const RunContext& context) {
  // Not mapped: another program may truncate the file while this one goes on.
  return {.isCopied = true, .cancel = context.cancel};
}

}  // namespace

LastingFile::LastingFile(AmtContainer file) : path_(file.path()), state_(std::make_unique<State>()) {
  state_->file = std::move(file);
}

Result<LastingFile> LastingFile::open(const std::string& path, const RunContext& context) try {
  ARETE_TRY(AmtContainer file, openModelFile(path, optionsOf(context)));
  return LastingFile(std::move(file));
} catch (...) {
  return caughtFailure(path);
}

Result<AmtContainer> LastingFile::current(const RunContext& context) const try {
  const std::lock_guard lock(state_->mutex);
  if (state_->file.loaded()) return state_->file;
  ARETE_TRY(AmtContainer again, openModelFile(path_, optionsOf(context)));
  if (!haveSameChunks(again.chunks(), state_->file.chunks()))
    return failure(ErrorCode::unreadable, "was replaced since it was opened; open it again", path_);
  state_->file = std::move(again);
  return state_->file;
} catch (...) {
  return caughtFailure(path_);
}

}  // namespace arete
