// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/calls.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

#include "engine/parallel/guest_work.h"
#include "io/files/text/address_text.h"

namespace arete::python {

namespace py = pybind11;

namespace {

/// Paths need not be UTF-8: what is not is shown as U+FFFD, so that the error itself arrives.
py::str asText(const std::string& text) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace"));
}

}  // namespace

void raise(const Error& error) {
  const py::str text = asText(withoutQueries(error.describe()));
  // Python's own class is raised where one fits; other errors are a RuntimeError.
  switch (error.code) {
    case ErrorCode::usage:
      PyErr_SetObject(PyExc_ValueError, text.ptr());
      break;
    case ErrorCode::notFound:
      PyErr_SetObject(PyExc_FileNotFoundError, text.ptr());
      break;
    case ErrorCode::unreadable:
      PyErr_SetObject(PyExc_OSError, text.ptr());
      break;
    case ErrorCode::outOfMemory:
      PyErr_SetObject(PyExc_MemoryError, text.ptr());
      break;
    case ErrorCode::interrupted:
      PyErr_SetObject(PyExc_KeyboardInterrupt, text.ptr());
      break;
    default:
      PyErr_SetObject(PyExc_RuntimeError, text.ptr());
  }
  throw py::error_already_set();
}

void warn(const Warnings& warnings) {
  if (warnings.empty()) return;
  const py::object category = py::module_::import("arete._warning").attr("AreteWarning");
  const py::object warnPython = py::module_::import("warnings").attr("warn");
  using namespace py::literals;
  // A stack level of 2 names the line that called this module.
  for (const Warning& warning : warnings)
    warnPython(category(asText(withoutQueries(warning.sentence)), nameOf(warning.code)), "stacklevel"_a = 2);
}

Error inPython(Error error) {
  // A culprit of letters in camel case is an option, which Python spells in snake case; others stay as they
  // are.
  const auto isOfName = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  if (error.culprit.empty() || std::isupper(static_cast<unsigned char>(error.culprit.front())) != 0 ||
      !std::ranges::all_of(error.culprit, isOfName))
    return error;
  std::string name;
  for (const char c : error.culprit) {
    if (std::isupper(static_cast<unsigned char>(c)) != 0) name += '_';
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  error.culprit = name;
  return error;
}

void runBeside(const py::object& progress, const std::function<void(const RunContext&)>& body) {
  std::mutex mutex;
  std::condition_variable changed;
  bool isDone = false, hasReport = false;
  std::string stage;
  double fraction = 0;
  std::exception_ptr thrown;
  Status refused;
  std::atomic<bool> stop = false;
  RunContext context;
  context.cancel = &stop;
  if (!progress.is_none())
    context.progress = [&](std::string_view reportedStage, double reported) {
      const std::lock_guard lock(mutex);
      stage = reportedStage;
      fraction = reported;
      hasReport = true;
      changed.notify_one();
    };
  // The body runs on a thread without Python's lock, while this one serves signals and progress.
  std::thread worker([&] {
    try {
      const GuestWork work;
      if (const Status may = work.mayRun(); may)
        body(context);
      else
        refused = may;
    } catch (...) {
      thrown = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    isDone = true;
    changed.notify_one();
  });
  std::exception_ptr raised;
  for (;;) {
    std::string latestStage;
    double latest = 0;
    bool isNew = false, isEnd = false;
    // The wait ends every 50 ms even without a report, so that an interrupt from the keyboard is noticed.
    {
      const py::gil_scoped_release released;
      std::unique_lock lock(mutex);
      changed.wait_for(lock, std::chrono::milliseconds(50), [&] { return isDone || hasReport; });
      isEnd = isDone;
      isNew = std::exchange(hasReport, false);
      latestStage = stage;
      latest = fraction;
    }
    // An exception of Python stops the body, and leaves here only after the thread has ended.
    if (!raised) {
      try {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (isNew) progress(latestStage, latest);
      } catch (...) {
        raised = std::current_exception();
        stop = true;
      }
    }
    if (isEnd) break;
  }
  worker.join();
  if (raised) std::rethrow_exception(raised);
  if (thrown) std::rethrow_exception(thrown);
  if (!refused) raise(refused.error());
}

}  // namespace arete::python
