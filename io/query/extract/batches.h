// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"

namespace arete {

/// Answers some questions, named by their numbers in rising order. May be called again with the same ones
/// after an error.
using AnswerBatch = std::function<Status(std::span<const std::uint32_t> questions)>;

/// Answers questions about places within the memory budget (engine/memory/required_memory.h): all of them at
/// once, as without a budget; if that takes more memory than is left, in batches of places near each other,
/// each half as large as one that was refused.
///
/// @param places  one for each question, where most of what it needs lies; any coordinates, NaN is allowed
/// Errors: as `answer`, or the exception of memory that it throws (outOfMemory), for a single question.
/// O(n log n) and, within a budget, O(batches) calls.
Status answerInBatches(std::span<const Vec2> places, const AnswerBatch& answer);

}  // namespace arete
