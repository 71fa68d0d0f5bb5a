// SPDX-License-Identifier: GPL-3.0-or-later
//
// A frame: input, camera, cut, surface into a picture beside (float depths, samples), a copy into the window,
// the panel over it.
#include "viewer/surface/surface_window.h"

#include <epoxy/gl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <imgui.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <ctime>
#include <utility>

#include "engine/base/stopwatch.h"
#include "viewer/gl/frame_target.h"
#include "viewer/headless/headless.h"
#include "viewer/panel/panel_context.h"
#include "viewer/panel/widgets.h"
#include "viewer/surface/surface_session.h"
#include "viewer/window/frame_history.h"
#include "viewer/window/glfw_window.h"

namespace arete {
namespace {

using widget::row;

constexpr std::array<std::pair<const char*, const char*>, 12> kKeys = {{
    {"left drag, arrows", "turn"},
    {"right drag, W A S D", "move"},
    {"wheel, E Q", "nearer and farther"},
    {"H", "home views, one after the other"},
    {"L", "wireframe"},
    {"Z", "freeze the cut"},
    {"1", "materials"},
    {"4", "one colour"},
    {"5", "error heat map"},
    {"F12", "picture of the surface as PNG"},
    {"F2", "show or hide the panel"},
    {"F1", "this help"},
}};

// The window owns the context of OpenGL. It stands before the members that use the context, so that it is
// destroyed after them.
class SurfaceWindow {
 public:
  SurfaceWindow(const SurfaceWindowOptions& options, GlfwWindow window, SurfaceView view,
                const Camera& camera)
      : options_(options),
        window_(std::move(window)),
        panel_(window_.handle(), window_.contentScale()),
        view_(std::move(view)),
        session_(view_.shape(), camera, options.settings) {
    session_.homeView = options.home;
    if (!view_.warnings().empty()) session_.message = view_.warnings().front();
  }

  Status run(const RunContext& context) {
    window_.show();
    for (int frame = 0; !window_.isClosing(); ++frame) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "interrupted");
      if (options_.frames > 0 && frame >= options_.frames) break;
      if (window_.widthPixels() == 0 || window_.heightPixels() == 0) {
        window_.wait(0.1);
        continue;
      }
      ARETE_CHECK(drawFrame(context));
    }
    if (options_.lastPicture.empty() || shown_.width == 0) return {};
    return savePng(shown_, options_.lastPicture);
  }

 private:
  // The target follows the size of the window. The panel is drawn into the window and not into the target, so
  // that a screenshot shows the surface alone.
  Status drawFrame(const RunContext& context) {
    const Stopwatch work;
    SurfaceSession& s = session_;
    const int width = window_.widthPixels(), height = window_.heightPixels();
    if (!target_ || target_->width() != width || target_->height() != height) {
      ARETE_TRY(FrameTarget target, FrameTarget::create(width, height, options_.samples));
      target_.emplace(std::move(target));
    }
    const ImGuiIO& io = ImGui::GetIO();
    const GlfwWindow::Events events = window_.poll(io.WantCaptureMouse, io.WantCaptureKeyboard);
    s.setPicture(width, height);
    for (const Action action : events.actions) s.apply(action);
    s.step(events.input);

    panel_.beginFrame();
    drawPanel();
    ImGui::Render();

    // A frozen cut stays as it is, but there has to be one.
    if (!s.isFrozen || !hasCut_) {
      ARETE_TRY(const SurfaceFigures figures, view_.cut(s.camera(), s.settings, context));
      s.figures = figures;
      hasCut_ = true;
    }
    const Stopwatch drawing;
    target_->begin();
    ARETE_CHECK(view_.draw(s.camera(), s.settings));
    glFinish();
    s.figures.drawMilliseconds = drawing.milliseconds();
    if (std::exchange(s.wantsScreenshot, false)) {
      const std::string name = fmt::format("arete-{:%Y%m%d-%H%M%S}.png", fmt::localtime(std::time(nullptr)));
      const Status saved = savePng(target_->image(), name);
      s.message = saved ? "saved " + name : saved.error().describe();
    }
    // The picture goes into the window only after a screenshot was taken of it. The time stops before the
    // swap, which waits for the screen.
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    target_->copyTo(0);
    panel_.drawFrame();
    if (!options_.lastPicture.empty()) shown_ = windowImage(width, height);
    glFinish();
    const double worked = work.milliseconds();
    glfwSwapBuffers(window_.handle());
    history_.add(worked, sinceLastFrame_.milliseconds());
    sinceLastFrame_ = {};
    return {};
  }

  // The panel changes the settings directly; the next cut and the next picture follow them.
  void drawPanel() {
    SurfaceSession& s = session_;
    if (s.showsHelp) drawHelp();
    if (!s.message.empty()) widget::showMessage(s.message);
    if (!s.showsPanel) return;
    widget::beginColumn("figures", false);
    if (widget::section("Frame")) {
      row("time",
          fmt::format("{:.1f} ms   {:.0f} frames/s", history_.lastWork(), history_.framesPerSecond()));
      row("triangles", widget::grouped(s.figures.triangles));
      row("tolerance", fmt::format("{:.2f} px asked, {:.2f} {}", s.settings.pixels, s.figures.pixels,
                                   s.figures.isComplete ? "kept" : "not kept"));
      row("cut, draw",
          fmt::format("{:.1f} ms, {:.1f} ms", s.figures.cutMilliseconds, s.figures.drawMilliseconds));
      widget::dim(window_.description());
    }
    if (widget::section("Detail")) {
      widget::slider("tolerance", s.settings.pixels, 0.25, 64, "%.2f px", true);
      widget::tip("How far the source may be from what is drawn, on the screen.");
      ImGui::Checkbox("freeze cut", &s.isFrozen);
      widget::tip("The cut stays as it is while the camera moves on.");
    }
    if (widget::section("Look")) {
      SurfaceLook& look = s.settings.look;
      int coloring = int(look.coloring);
      if (ImGui::Combo("colour by", &coloring, "material\0nothing\0error\0"))
        look.coloring = SurfaceColoring(coloring);
      ImGui::Checkbox("shading", &look.isShaded);
      ImGui::Checkbox("wireframe", &look.hasWireframe);
    }
    if (widget::section("Camera")) {
      for (const HomeView view : kHomeViews) {
        if (view != HomeView::overview) ImGui::SameLine(0, 3);
        const std::string name = view == HomeView::overview ? "home" : std::string(toString(view));
        if (ImGui::SmallButton(name.c_str())) s.home(view);
      }
      const Vec3 eye = view_.upright().toFile(CameraSpace().position(s.camera()));
      row("eye", fmt::format("{:.5g}, {:.5g}, {:.5g}", eye.x, eye.y, eye.z));
    }
    widget::endColumn();
  }

  // The help is a window in the middle, which its own cross or the key closes.
  void drawHelp() {
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos({io.DisplaySize.x / 2, io.DisplaySize.y / 2}, ImGuiCond_Appearing, {0.5f, 0.5f});
    ImGui::Begin(
        "Keys and mouse", &session_.showsHelp,
        ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse);
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_BordersInnerH)) {
      for (const auto& [key, what] : kKeys) {
        ImGui::TableNextColumn();
        widget::line(key);
        ImGui::TableNextColumn();
        widget::line(what);
      }
      ImGui::EndTable();
    }
    ImGui::End();
  }

  const SurfaceWindowOptions& options_;
  GlfwWindow window_;
  PanelContext panel_;
  SurfaceView view_;
  SurfaceSession session_;
  FrameHistory history_;
  std::optional<FrameTarget> target_;
  Image shown_;
  bool hasCut_ = false;
  Stopwatch sinceLastFrame_;
};

}  // namespace

Status runSurfaceWindow(const SurfaceModel& model, const ZUpFrame& upright,
                        const SurfaceWindowOptions& options, const RunContext& context) {
  ARETE_TRY(GlfwWindow window, GlfwWindow::open(options.title, options.width, options.height, true));
  ARETE_TRY(SurfaceView view, SurfaceView::create(model, upright));
  Camera picture;
  picture.widthPixels = std::max(window.widthPixels(), 1);
  picture.heightPixels = std::max(window.heightPixels(), 1);
  const Camera camera = options.camera.value_or(surfaceHome(options.home, view.shape(), picture));
  SurfaceWindow shown(options, std::move(window), std::move(view), camera);
  return shown.run(context);
}

}  // namespace arete
