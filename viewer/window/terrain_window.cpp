// SPDX-License-Identifier: GPL-3.0-or-later
//
// A frame: input, camera, cut, terrain into a picture beside (float depths, samples), lines, a copy into the
// window, the panel over it. The frame's time is taken up to where the device has finished, before the wait
// for the screen.
#include "viewer/window/terrain_window.h"

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
#include <vector>

#include "engine/base/counted.h"
#include "viewer/gl/frame_target.h"
#include "viewer/headless/headless.h"
#include "viewer/panel/panel_context.h"
#include "viewer/picture/picture.h"
#include "viewer/window/glfw_window.h"
#include "viewer/window/memory_use.h"
#include "viewer/window/panel.h"

namespace arete {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

using LineEnd = TerrainPainter::LineEnd;

void addLine(std::vector<LineEnd>& lines, const Vec3& from, const Vec3& to,
             std::array<std::uint8_t, 4> color) {
  for (const Vec3& p : {from, to}) lines.push_back({{float(p.x), float(p.y), float(p.z)}, color});
}

/// What is drawn in space, with the terrain in front of it.
std::vector<LineEnd> linesOf(const ViewerSession& s) {
  std::vector<LineEnd> lines;
  if (s.sight) {
    const SightVerdict verdict = s.sight->answer.sight.verdict;
    for (const SightPiece& piece : piecesOf(*s.sight)) {
      addLine(lines, piece.from, piece.to,
              verdict == SightVerdict::visible ? std::array<std::uint8_t, 4>{60, 235, 60, 255}
              : verdict == SightVerdict::blocked
                  ? (piece.isBefore ? std::array<std::uint8_t, 4>{255, 50, 40, 255}
                                    : std::array<std::uint8_t, 4>{150, 40, 40, 255})
                  : std::array<std::uint8_t, 4>{190, 190, 190, 255});
    }
  }
  // The way of the flight, key by key.
  const auto& keys = s.deck.plan().keys;
  for (std::size_t i = 1; i < keys.size() && !s.deck.isPlaying(); ++i)
    addLine(lines, s.picker.space().position(keys[i - 1]), s.picker.space().position(keys[i]),
            {250, 200, 60, 255});
  if (s.frozen && s.showsFrustum)
    for (const auto& edge :
         frustumEdges(s.picker.space(), *s.frozen, s.picker.box().diagonal() / 2, s.settings.stretch))
      addLine(lines, edge[0], edge[1], {255, 255, 255, 255});
  return lines;
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
    std::filesystem::create_directories(s.framesFolder, error);
    if (error) return failure(ErrorCode::unreadable, error.message(), s.framesFolder.string());
    count_ = flight->frameCount();
    return flight->at(double(frame_) / flight->plan().framesPerSecond);
  }
  /// True when that was the last.
  Result<bool> save(const ViewerSession& s, const Image& image) {
    const auto path = s.framesFolder / fmt::format("frame_{:05}.png", frame_);
    ARETE_CHECK(savePng(image, path));
    return ++frame_ >= count_;
  }
  std::uint64_t done() const { return frame_; }
  std::uint64_t count() const { return count_; }

 private:
  std::uint64_t frame_ = 0, count_ = 0;
};

/// The loop of the window. The window owns the context of OpenGL and is destroyed after what uses it.
class WindowLoop {
 public:
  WindowLoop(const TerrainModel& model, const WindowOptions& options, GlfwWindow window, TerrainView view)
      : options_(options),
        window_(std::move(window)),
        panelContext_(window_.handle(), window_.contentScale()),
        view_(std::move(view)),
        session_(model, options.start) {
    session_.renderer = window_.description();
    session_.deviceRefusal = view_.deviceRefusal();
    if (!session_.deviceRefusal.empty()) session_.settings.path = CutPath::processor;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &session_.mostOverlayPixels);
  }

  // A window of no size, as one that is minimized, is not drawn; the loop sleeps instead of spinning.
  Status run(const RunContext& context) {
    if (options_.onReady) ARETE_CHECK(options_.onReady(view_));
    window_.show();
    for (int frame = 0; !window_.isClosing(); ++frame) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "interrupted");
      if (options_.frames > 0 && frame >= options_.frames) break;
      if (options_.onFrame && !options_.onFrame(session_, frame)) break;
      if (window_.widthPixels() == 0 || window_.heightPixels() == 0) {
        window_.wait(0.1);
        continue;
      }
      ARETE_CHECK(drawFrame());
    }
    if (options_.lastPicture.empty() || shown_.width == 0) return {};
    return savePng(shown_, options_.lastPicture);
  }

 private:
  Status drawFrame() {
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
    session_.rig.setPicture(width, height);
    for (const Action action : events.actions) session_.apply(action);
    if (events.click) session_.click(*events.click);
    session_.step(events.input);
    ARETE_CHECK(placeFrameFile());

    panelContext_.beginFrame();
    panel_.draw(session_, window_.pixelsPerUnit());
    ImGui::Render();

    ARETE_CHECK(drawTerrain());
    // Pictures are saved before the panel is drawn over the terrain. The time is taken before the swap, which
    // waits for the screen.
    ARETE_CHECK(savePictures());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    target_->copyTo(0);
    panelContext_.drawFrame();
    if (!options_.lastPicture.empty()) shown_ = windowImage(width, height);
    glFinish();
    const double work = millisecondsSince(start);
    glfwSwapBuffers(window_.handle());
    session_.history.add(work, millisecondsSince(lastFrame_));
    lastFrame_ = Clock::now();
    if (millisecondsSince(lastMemory_) > 1000) {
      session_.residentBytes = residentBytes();
      session_.deviceBytes = deviceBytes();
      lastMemory_ = Clock::now();
    }
    return {};
  }

  /// Ends of lines are those of the flat map.
  void bend(std::vector<LineEnd>& lines, const ViewSettings& settings) {
    const CameraSpace& space = session_.picker.space();
    for (LineEnd& end : lines) {
      const Vec3 flat{end.position[0], end.position[1], end.position[2]};
      const Result<Vec3> p = view_.drawnPosition(space.xy(flat), space.height(flat), settings);
      if (p) end.position = {float(p->x), float(p->y), float(p->z)};
    }
  }

  /// To what could be drawn, from what cannot: a camera beyond the CRS of a curved Earth, for instance.
  void goBack(const Error& why) {
    ViewerSession& s = session_;
    s.say(why.describe());
    s.deck.stop();
    s.wantsFrames = false;
    files_.reset();
    s.settings.isCurved = drawn_->isCurved;
    s.settings.stretch = drawn_->stretch;
    s.rig.setStretch(drawn_->stretch);
    s.rig.place(drawn_->camera);
  }

  Status drawTerrain() {
    ViewerSession& s = session_;
    if (s.isOverlayNew) {
      if (s.overlay)
        view_.painter().setOverlay(s.overlay->width, s.overlay->height, s.overlay->rgba, s.overlay->scale,
                                   s.overlay->shift);
      else
        view_.painter().setOverlay(0, 0, {}, {}, {});
      s.isOverlayNew = false;
    }
    ViewSettings settings = s.settings;
    // A film has every frame as it should be.
    settings.waits = settings.waits || files_.has_value();
    if (!s.isFrozen || !hasCut_) {
      Result<FrameFigures> figures = view_.cut(s.rig.camera(), settings);
      // A setting that cannot be cut or drawn is taken back, and the last one that was drawn is used; only if
      // that fails too the window ends.
      if (!figures && drawn_) {
        goBack(figures.error());
        settings = s.settings;
        figures = view_.cut(s.rig.camera(), settings);
      }
      if (!figures) return tl::unexpected(figures.error());
      s.figures = *figures;
      hasCut_ = true;
    }
    target_->begin();
    const auto start = Clock::now();
    Status drawn = view_.draw(s.rig.camera(), settings);
    if (!drawn && drawn_) {
      goBack(drawn.error());
      settings = s.settings;
      drawn = view_.draw(s.rig.camera(), settings);
    }
    if (!drawn) return drawn;
    drawn_ = {s.rig.camera(), s.settings.isCurved, s.settings.stretch};
    std::vector<LineEnd> lines = linesOf(s);
    if (settings.isCurved) bend(lines, settings);
    if (!files_) view_.painter().drawLines(lines);
    glFinish();
    s.figures.drawMilliseconds = millisecondsSince(start);
    return {};
  }

  /// While frames are written, the flight places the camera, and the user's input does not move it.
  Status placeFrameFile() {
    ViewerSession& s = session_;
    if (!s.wantsFrames) {
      files_.reset();
      return {};
    }
    if (!files_) files_.emplace();
    const Result<Camera> camera = files_->next(s);
    if (camera) {
      s.rig.place(*camera);
      s.say(fmt::format("{}: frame {} of {}", s.framesFolder.string(), files_->done() + 1, files_->count()));
    } else {
      s.say(camera.error().describe());
      s.wantsFrames = false;
      files_.reset();
    }
    return {};
  }

  // The writing of frames ends after the last frame or the first failure; the window says either and goes on.
  Status savePictures() {
    ViewerSession& s = session_;
    if (files_) {
      const Result<bool> isLast = files_->save(s, target_->image());
      if (!isLast || *isLast) {
        s.say(isLast ? fmt::format("{} frames in {}", files_->count(), s.framesFolder.string())
                     : isLast.error().describe());
        s.wantsFrames = false;
      }
    }
    if (s.wantsScreenshot) {
      s.wantsScreenshot = false;
      const std::string name = nameOfNow();
      const Status saved = savePng(target_->image(), name);
      s.say(saved ? "saved " + name : saved.error().describe());
    }
    return {};
  }

  const WindowOptions& options_;
  GlfwWindow window_;
  PanelContext panelContext_;
  TerrainView view_;
  ViewerSession session_;
  Panel panel_;
  std::optional<FrameTarget> target_;
  std::optional<FrameFiles> files_;
  Image shown_;
  bool hasCut_ = false;
  struct Drawn {
    Camera camera;
    bool isCurved = false;
    double stretch = 1;
  };
  std::optional<Drawn> drawn_;  // last
  Clock::time_point lastFrame_ = Clock::now(), lastMemory_{};
};

}  // namespace

Status runWindow(const TerrainModel& model, const WindowOptions& options, const RunContext& context) {
  ARETE_TRY(GlfwWindow window,
            GlfwWindow::open(options.title, options.width, options.height, options.waitsForScreen));
  ARETE_TRY(
      TerrainView view,
      TerrainView::create(
          model, {.path = options.start.settings.path, .mostTriangles = options.mostTriangles}, context));
  WindowLoop loop(model, options, std::move(window), std::move(view));
  return loop.run(context);
}

}  // namespace arete
