// SPDX-License-Identifier: GPL-3.0-or-later
//
// A frame: input, camera, cut, scene into a picture beside (float depths, samples), a copy into the window,
// the panel over it. The frame's time is taken up to where the device has finished, before the wait for the
// screen.
#include "viewer/window/window.h"

#include <epoxy/gl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <imgui.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <optional>
#include <system_error>
#include <utility>

#include "viewer/gl/frame_target.h"
#include "viewer/headless/headless.h"
#include "viewer/overlay/decoration_overlay.h"
#include "viewer/panel/memory_use.h"
#include "viewer/panel/panel_context.h"
#include "viewer/picture/picture.h"
#include "viewer/window/glfw_window.h"
#include "viewer/window/panel.h"

namespace arete {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::string nameOfNow() {
  return fmt::format("arete-{:%Y%m%d-%H%M%S}.png", fmt::localtime(std::time(nullptr)));
}

/// The flight, frame by frame, into a folder.
class FrameFiles {
 public:
  Result<Camera> next(ViewerSession& s) {
    ARETE_TRY(const auto flight, s.deck.flight());
    std::error_code error;
    std::filesystem::create_directories(s.files.framesFolder, error);
    if (error) return failure(ErrorCode::unreadable, error.message(), s.files.framesFolder.string());
    count_ = flight->frameCount();
    return flight->at(double(frame_) / flight->plan().framesPerSecond);
  }
  /// True when that was the last.
  Result<bool> save(const ViewerSession& s, const Image& image) {
    const auto path = s.files.framesFolder / fmt::format("frame_{:05}.png", frame_);
    ARETE_CHECK(savePng(image, path));
    return ++frame_ >= count_;
  }
  std::uint64_t done() const { return frame_; }
  std::uint64_t count() const { return count_; }

 private:
  std::uint64_t frame_ = 0, count_ = 0;
};

/// A home view is found for the picture that the window has.
ViewerSession::Start startOf(const WindowOptions& options, const GlfwWindow& window) {
  ViewerSession::Start start = options.start;
  start.picture.widthPixels = std::max(window.widthPixels(), 1);
  start.picture.heightPixels = std::max(window.heightPixels(), 1);
  return start;
}

/// The loop of the window, which has the context of OpenGL and outlives it.
class WindowLoop {
 public:
  WindowLoop(const WindowOptions& options, GlfwWindow& window, Scene scene)
      : options_(options),
        window_(window),
        panelContext_(window_.handle(), window_.contentScale()),
        scene_(std::move(scene)),
        heights_(options.heightsOfContours),
        session_(scene_.subject(), scene_.layers, startOf(options, window_)) {
    session_.objects.emplace(scene_);
    session_.desk.emplace(options.desk, *session_.objects, session_.layers, session_.question);
    session_.device.renderer = window_.description();
    session_.device.refusal = scene_.deviceRefusal();
    if (!session_.device.refusal.empty()) session_.settings.path = CutPath::processor;
    if (session_.tools) glGetIntegerv(GL_MAX_TEXTURE_SIZE, &session_.tools->mostOverlayPixels);
    session_.say(options.message.empty()
                     ? "drag: turn   wheel: nearer and farther   H: the whole model   F1: all keys"
                     : options.message);
    for (const Warning& warning : scene_.warnings()) session_.say(warning);
  }

  // A window of no size, as one that is minimized, is not drawn; the loop sleeps instead of spinning.
  Result<WindowEnd> run(const RunContext& context) {
    ARETE_TRY(DecorationOverlay overlay, DecorationOverlay::create(scene_));
    overlay_.emplace(std::move(overlay));
    window_.show();
    for (int frame = 0; !window_.isClosing(); ++frame) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "interrupted");
      if (options_.frames > 0 && frame >= options_.frames) break;
      if (options_.onFrame && !options_.onFrame(session_, frame)) break;
      if (window_.widthPixels() == 0 || window_.heightPixels() == 0) {
        window_.wait(0.1);
        continue;
      }
      ARETE_CHECK(drawFrame(context));
      if (!session_.files.next.empty()) break;
    }
    WindowEnd end{session_.files.next, session_.rig.camera()};
    if (end.next.empty() && !options_.lastPicture.empty() && shown_.width > 0)
      ARETE_CHECK(savePng(shown_, options_.lastPicture));
    return end;
  }

 private:
  Status drawFrame(const RunContext& context) {
    const auto start = Clock::now();
    const int width = window_.widthPixels(), height = window_.heightPixels();
    if (!target_ || target_->width() != width || target_->height() != height) {
      ARETE_TRY(FrameTarget target, FrameTarget::create(width, height, options_.samples));
      target_.emplace(std::move(target));
    }
    // Input to the panel does not reach the camera. All input is applied before the frame is drawn, so that
    // the picture shows it.
    const ImGuiIO& io = ImGui::GetIO();
    GlfwWindow::Events events = window_.poll(io.WantCaptureMouse, io.WantCaptureKeyboard);
    const double pane = double(width) / scene_.panes();
    session_.rig.setPicture(pane, height);
    // One camera for all panes: a mouse in one is at the same place of each.
    if (pane < width) {
      events.input.mouse.x = std::fmod(events.input.mouse.x, pane);
      if (events.click) events.click->x = std::fmod(events.click->x, pane);
    }
    for (const Action action : events.actions) session_.apply(action);
    if (events.click) session_.click(*events.click);
    if (!events.dropped.empty()) session_.files.next = events.dropped.front();
    session_.step(events.input);
    placeFrameFile();

    panelContext_.beginFrame();
    panel_.draw(session_, window_.pixelsPerUnit());
    ImGui::Render();

    ARETE_CHECK(heights_.follow(scene_.layers, ImGui::IsAnyItemActive()));
    ARETE_CHECK(drawScene(context));
    // Pictures are saved before the panel is drawn over the terrain. The time is taken before the swap, which
    // waits for the screen.
    savePictures();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    target_->copyTo(0);
    if (session_.shows.decorations)
      ARETE_CHECK(overlay_->draw(*target_, session_.rig.camera(), session_.settings));
    panelContext_.drawFrame();
    if (!options_.lastPicture.empty()) shown_ = windowImage(width, height);
    glFinish();
    const double work = millisecondsSince(start);
    glfwSwapBuffers(window_.handle());
    session_.history.add(work, millisecondsSince(lastFrame_));
    lastFrame_ = Clock::now();
    if (millisecondsSince(lastMemory_) > 1000) {
      session_.device.residentBytes = residentBytes();
      session_.device.deviceBytes = deviceBytes();
      lastMemory_ = Clock::now();
    }
    return {};
  }

  /// To what could be drawn, from what cannot: a camera beyond the CRS of a curved Earth, for instance.
  void goBack(const Error& why) {
    ViewerSession& s = session_;
    s.say(why.describe());
    s.deck.stop();
    s.files.wantsFrames = false;
    files_.reset();
    s.settings = drawn_->settings;
    s.rig.setStretch(s.settings.stretch);
    s.rig.place(drawn_->camera);
  }

  Status drawScene(const RunContext& context) {
    ViewerSession& s = session_;
    // A film has every frame as it should be, without the marks of a hand at work.
    const bool isFilming = files_.has_value();
    const Layers laid = isFilming ? scene_.layers : Layers();
    if (isFilming) {
      for (const char* mark : ViewerSession::kMarks) scene_.layers.remove(mark);
      for (ShownObject& object : scene_.objects()) object.kept.reset();
    }
    // A setting that cannot be cut or drawn is taken back, and the last one that was drawn is used; only if
    // that fails too the window ends.
    Status drawn = drawOnce(context);
    if (!drawn && drawn_ && drawn.error().code != ErrorCode::interrupted) {
      goBack(drawn.error());
      drawn = drawOnce(context);
    }
    if (drawn) drawn_ = {s.rig.camera(), s.settings};
    if (isFilming) scene_.layers = laid;
    return drawn;
  }

  Status drawOnce(const RunContext& context) {
    ViewerSession& s = session_;
    ViewSettings settings = s.settings;
    settings.waits = settings.waits || files_.has_value();
    if (!s.isFrozen || !hasCut_) {
      ARETE_CHECK(scene_.advance(s.rig.camera(), settings, context));
      ARETE_TRY(s.figures, scene_.cut(s.rig.camera(), settings, context));
      s.cutSettings = settings;
      hasCut_ = true;
    }
    target_->begin();
    const auto start = Clock::now();
    Status drawn = scene_.draw(s.rig.camera(), settings);
    glFinish();
    s.figures.drawMilliseconds = millisecondsSince(start);
    return drawn;
  }

  /// While frames are written, the flight places the camera, and the user's input does not move it.
  void placeFrameFile() {
    ViewerSession& s = session_;
    if (!s.files.wantsFrames) return files_.reset();
    if (!files_) files_.emplace();
    const Result<Camera> camera = files_->next(s);
    if (camera) {
      s.rig.place(*camera);
      s.say(fmt::format("{}: frame {} of {}", s.files.framesFolder.string(), files_->done() + 1,
                        files_->count()));
    } else {
      s.say(camera.error().describe());
      s.files.wantsFrames = false;
      files_.reset();
    }
  }

  /// As the window shows it, without the panel.
  Result<Image> picture() const {
    if (!session_.shows.decorations) return target_->image();
    return overlay_->picture(*target_, session_.rig.camera(), session_.settings);
  }
  Status savePicture(const std::string& name) const {
    ARETE_TRY(const Image image, picture());
    return savePng(image, name);
  }
  Result<bool> saveFrame() {
    ARETE_TRY(const Image image, picture());
    return files_->save(session_, image);
  }

  // The writing of frames ends after the last frame or the first failure; the window says either and goes on.
  void savePictures() {
    ViewerSession& s = session_;
    if (files_) {
      const Result<bool> isLast = saveFrame();
      if (!isLast || *isLast) {
        s.say(isLast ? fmt::format("{} frames in {}", files_->count(), s.files.framesFolder.string())
                     : isLast.error().describe());
        s.files.wantsFrames = false;
      }
    }
    if (std::exchange(s.files.wantsScreenshot, false)) {
      // Two pictures of one second are two files.
      const std::string name = freePath(nameOfNow()).string();
      const Status saved = savePicture(name);
      s.say(saved ? "saved " + name : saved.error().describe());
    }
  }

  const WindowOptions& options_;
  GlfwWindow& window_;
  PanelContext panelContext_;
  Scene scene_;
  HeightsOfContours heights_;
  std::optional<DecorationOverlay> overlay_;  // once the loop runs
  ViewerSession session_;
  Panel panel_;
  std::optional<FrameTarget> target_;
  std::optional<FrameFiles> files_;
  Image shown_;
  bool hasCut_ = false;
  struct Drawn {
    Camera camera;
    ViewSettings settings;
  };
  std::optional<Drawn> drawn_;  // last
  Clock::time_point lastFrame_ = Clock::now(), lastMemory_{};
};

}  // namespace

Status runWindow(const FillScene& fill, const WindowOptions& options, const RunContext& context) {
  ARETE_TRY(GlfwWindow window,
            GlfwWindow::open(options.title, options.width, options.height, options.waitsForScreen));
  ARETE_TRY([[maybe_unused]] const WindowEnd end, showIn(window, fill, options, context));
  return {};
}

Result<WindowEnd> showIn(GlfwWindow& window, const FillScene& fill, const WindowOptions& options,
                         const RunContext& context) {
  ARETE_TRY(Scene scene, Scene::create());
  ARETE_CHECK(fill(scene));
  WindowLoop loop(options, window, std::move(scene));
  return loop.run(context);
}

}  // namespace arete
