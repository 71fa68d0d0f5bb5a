// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "engine/base/result.h"

namespace arete {

/// Sees to it that parts of a file are in memory before they are used. All of them are asked for at once, so
/// that what lies on a server takes few requests. Null: all of the file is in memory.
using LoadParts = std::function<Status(std::span<const std::span<const std::byte>>)>;

}  // namespace arete
