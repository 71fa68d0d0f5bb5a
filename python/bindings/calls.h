// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"

namespace arete::python {

/// Raises an error as Python's own: ValueError (usage, and files of a kind that is not meant),
/// FileNotFoundError, OSError, MemoryError, KeyboardInterrupt, and RuntimeError for files whose content is
/// damaged or invalid.
[[noreturn]] void raise(const Error& error);

/// Raises each as an AreteWarning of the caller, with its code. Errors: what Python makes of it where
/// warnings are errors.
void warn(const Warnings& warnings);

/// An error whose culprit is a field of ours, named as the argument that it comes from: maxTriangles as
/// max_triangles.
Error inPython(Error error);

/// Runs a body on a thread of its own as guest work (engine/parallel/guest_work.h), without the interpreter's
/// lock, while the calling thread serves
/// Python: it calls progress(stage, fraction) with the latest report, and notices Ctrl-C. What the callback
/// or the signal raises ends the body and is raised here.
/// @param progress a callable, or None
void runBeside(const pybind11::object& progress, const std::function<void(const RunContext&)>& body);

/// An error about numbers that the caller gave, which are a wrong argument and no bad file.
Error ofArgument(Error error);

/// The result of body(context), or its error raised.
/// @param isArgument  what the body works on is an argument, and no file
template <class Body>
auto callOn(bool isArgument, const pybind11::object& progress, const Body& body) {
  using Answer = decltype(body(std::declval<const RunContext&>()));
  std::optional<Answer> answer;
  runBeside(progress, [&](const RunContext& context) { answer.emplace(body(context)); });
  if (!*answer) raise(inPython(isArgument ? ofArgument(answer->error()) : answer->error()));
  if constexpr (!std::is_same_v<Answer, Status>) return std::move(**answer);
}

/// The same of files.
template <class Body>
auto call(const pybind11::object& progress, const Body& body) {
  return callOn(false, progress, body);
}

}  // namespace arete::python
