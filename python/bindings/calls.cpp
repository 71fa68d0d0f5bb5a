// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/calls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

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

namespace {

/// Fields whose argument has another name.
constexpr std::array kNamesInPython = {
    std::pair{"creaseAngleDegrees", "crease_angle"},
    std::pair{"deadlineMilliseconds", "deadline"},
    std::pair{"featureCount", "features"},
    std::pair{"fieldOfView", "fov"},
    std::pair{"fixedVertices", "fixed"},
    std::pair{"growth", "error_growth"},
    std::pair{"isDepth", "positive"},
    std::pair{"isLonLat", "lonlat"},
    std::pair{"lonLat", "lonlat"},
    std::pair{"minimumAspect", "min_aspect"},
    std::pair{"thresholdRatio", "ratio"},
};

/// "max_triangles" of "maxTriangles"; a text that does not look like a field stays.
std::string argumentOf(const std::string& field) {
  const auto isOfName = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  if (field.empty() || std::isupper(static_cast<unsigned char>(field.front())) != 0 ||
      !std::ranges::all_of(field, isOfName))
    return field;
  for (const auto& [known, argument] : kNamesInPython)
    if (field == known) return argument;
  std::string name;
  for (const char c : field) {
    if (std::isupper(static_cast<unsigned char>(c)) != 0) name += '_';
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

/// A sentence whose fields, in backquotes, are named as arguments; other words in backquotes stay.
std::string sentenceInPython(std::string sentence) {
  for (std::size_t at = 0; (at = sentence.find('`', at)) != std::string::npos;) {
    const std::size_t behind = sentence.find('`', at + 1);
    if (behind == std::string::npos) break;
    const std::string field = sentence.substr(at + 1, behind - at - 1);
    const bool isField = !field.empty() && std::ranges::all_of(field, [](char c) {
      return std::isalpha(static_cast<unsigned char>(c)) != 0;
    });
    const std::string name = isField ? argumentOf(field) : fmt::format("`{}`", field);
    sentence.replace(at, behind + 1 - at, name);
    at += name.size();
  }
  return sentence;
}

}  // namespace

void raise(const Error& error) {
  const py::str text = asText(withoutQueries(error.describe()));
  // Python's own class is raised where one fits; other errors are a RuntimeError.
  switch (error.code) {
    case ErrorCode::usage:
    case ErrorCode::unsupported:
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
    warnPython(category(asText(withoutQueries(sentenceInPython(warning.sentence))), nameOf(warning.code)),
               "stacklevel"_a = 2);
}

Error ofArgument(Error error) {
  if (error.code == ErrorCode::invalidData || error.code == ErrorCode::degenerate)
    error.code = ErrorCode::usage;
  return error;
}

Error inPython(Error error) {
  // "maxTriangles 5": a field and its value. The name of a file may look like one.
  const std::size_t end = error.code == ErrorCode::usage ? error.culprit.find(' ') : error.culprit.npos;
  const std::string value = end == error.culprit.npos ? "" : error.culprit.substr(end);
  error.culprit = argumentOf(error.culprit.substr(0, end)) + value;
  error.message = sentenceInPython(error.message);
  return error;
}

void runBeside(const py::object& progress, const std::function<void(const RunContext&)>& body) {
  if (!progress.is_none() && PyCallable_Check(progress.ptr()) == 0)
    throw py::type_error("progress is a function of a stage and a fraction");
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
