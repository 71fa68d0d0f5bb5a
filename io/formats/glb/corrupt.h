// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "engine/base/result.h"

namespace arete {

/// A part of a glTF that contradicts the specification or itself.
inline tl::unexpected<Error> corrupt(std::string message) {
  return failure(ErrorCode::corrupt, std::move(message));
}

}  // namespace arete
