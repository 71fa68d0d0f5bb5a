// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/base/result.h"

namespace arete {

// The memory budget of the process: this is the one place that knows it. What takes memory in bulk asks here
// first, and says what would take less.

/// Sets how many bytes the process may take beyond those that it has now, or beyond 52 MiB if that is more:
/// the program itself is not counted. Memory that is allocated without a question is limited too: a little
/// above the budget allocations fail. Call it once, before threads are started.
///
/// @param bytes  0: as many as the machine has (the default).
void setMemoryBudget(std::uint64_t bytes) noexcept;
/// What setMemoryBudget() was given; 0 without a budget.
std::uint64_t memoryBudget() noexcept;

/// The bytes in physical memory beyond those that setMemoryBudget() leaves out, pages of mapped files
/// included. O(1), a call of the system. Thread-safe.
std::uint64_t memoryInUse() noexcept;

/// Whether `bytes` more fit into what is left of the budget, or, without one, into the memory of the machine.
/// Thread-safe. What is reserved and not yet written counts as free.
///
/// @param wayOut  what needs less memory, as an advice: "ask for a smaller region".
/// Errors: outOfMemory: a sentence with the bytes needed, those left, the budget (the field `memory`) and the
/// way out.
Status checkBudget(std::uint64_t bytes, std::string_view wayOut = {});

/// The same for code that returns no status. Call it before an array whose size is a number in a file, too:
/// the system may grant memory that the machine lacks, and end the program when it is touched.
/// @throw MemoryRefusal with the sentence of checkBudget(); std::bad_alloc where `bytes` are more than the
/// machine's memory.
void requireMemory(std::uint64_t bytes, std::string_view wayOut = {});

/// Says that address space is reserved which will mostly stay untouched. The limit on allocations grows by
/// it. Call it before the reservation.
void allowReserved(std::uint64_t bytes) noexcept;

}  // namespace arete
