// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/opening.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <imgui.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

#include "engine/base/stopwatch.h"
#include "engine/parallel/background_work.h"
#include "viewer/panel/panel_context.h"

namespace arete {
namespace {

constexpr double kSecondsBetweenFrames = 0.05, kSecondsToHint = 4;

using Work = BackgroundWork<bool>;

/// @return whether the user wants no more of it.
bool drawBar(const OpeningText& text, const Work::Progress& progress, bool isHinted) {
  const ImGuiIO& io = ImGui::GetIO();
  const float em = ImGui::GetFontSize(), width = std::min(30 * em, io.DisplaySize.x - 2 * em);
  ImGui::SetNextWindowPos({io.DisplaySize.x / 2, io.DisplaySize.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({width, 0}, {width, io.DisplaySize.y});
  ImGui::Begin("opening", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings);
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.name.c_str());
  const std::string stage =
      progress.stage.empty() ? "" : fmt::format("{} {:.0f} %", progress.stage, 100 * progress.fraction);
  ImGui::ProgressBar(float(progress.fraction), {-1, 0}, stage.c_str());
  if (isHinted) ImGui::TextUnformatted(text.hint.c_str());
  ImGui::PopTextWrapPos();
  const bool isCancelled =
      ImGui::Button("cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
  ImGui::End();
  return isCancelled;
}

}  // namespace

Result<bool> showWhile(GlfwWindow& window, const OpeningText& text,
                       std::function<Status(const RunContext&)> work, const RunContext& context) {
  const Stopwatch since;
  PanelContext panel(window.handle(), window.contentScale());
  Work running;
  running.start(
      [work = std::move(work)](const RunContext& inner) -> Result<bool> {
        ARETE_CHECK(work(inner));
        return true;
      },
      context);
  window.show();
  while (true) {
    if (auto done = running.take()) return std::move(*done);
    if (context.cancelled()) return failure(ErrorCode::interrupted, "interrupted");
    window.poll(true, true);
    if (window.isClosing()) return false;
    if (window.widthPixels() > 0 && window.heightPixels() > 0) {
      panel.beginFrame();
      const bool isCancelled =
          drawBar(text, running.progress(), !text.hint.empty() && since.seconds() > kSecondsToHint);
      ImGui::Render();
      glBindFramebuffer(GL_FRAMEBUFFER, 0);
      glViewport(0, 0, window.widthPixels(), window.heightPixels());
      glClearColor(0.62f, 0.69f, 0.76f, 1);
      glClear(GL_COLOR_BUFFER_BIT);
      panel.drawFrame();
      glfwSwapBuffers(window.handle());
      if (isCancelled) return false;
    }
    window.wait(kSecondsBetweenFrames);
  }
}

}  // namespace arete
