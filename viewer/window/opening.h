// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "viewer/window/glfw_window.h"

namespace arete {

struct OpeningText {
  std::string name;  ///< of what is opened: "dem.tif"
  std::string hint;  ///< a sentence that is shown where it takes longer than some seconds; empty: none
};

/// Shows a window with a bar while work runs on another thread, until that is done or the user closes the
/// window, which cancels the work.
///
/// @param work reports its progress and ends when its context is cancelled.
/// @param context its reports go there as well, on the thread of the work.
/// @return whether the work is done; false: the window was closed. On the thread of main(). Errors: those of
/// the work; interrupted, when the context is cancelled.
Result<bool> showWhile(GlfwWindow& window, const OpeningText& text,
                       std::function<Status(const RunContext&)> work, const RunContext& context = {});

}  // namespace arete
