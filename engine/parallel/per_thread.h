// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_group.h>

namespace arete {

/// A value for each thread that uses one: local() is the caller's, made at its first use. Iterating visits
/// all, in no certain order.
template <class Value>
using PerThread = tbb::enumerable_thread_specific<Value>;

/// Tasks that are added while others run, and awaited together: run(task), wait().
using TaskGroup = tbb::task_group;

}  // namespace arete
