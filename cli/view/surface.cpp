// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/view/surface.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/surface/camera.h"
#include "cli/view/pictures.h"
#include "io/files/file_writer.h"
#include "io/store/amt/surface_file.h"
#include "viewer/headless/headless.h"
#include "viewer/surface/headless.h"
#include "viewer/surface/surface_window.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

constexpr double kSecondsOfATurn = 8, kFramesPerSecond = 30;

/// The camera of upright space.
Result<Camera> cameraOf(const ViewArguments& a, const ZUpFrame& upright, const ZUpShape& shape, int width,
                        int height) {
  Camera camera;
  camera.widthPixels = width;
  camera.heightPixels = height;
  const CameraSpace space;
  if (a.viewpoint.camera.empty()) return surfaceHome(a.viewpoint.homeView(), shape, camera);
  ARETE_TRY(const SurfaceCameraArgument stated, readSurfaceCamera(a.viewpoint.camera));
  const Vec3 eye = upright.fromFile(stated.camera.eye);
  const Look look = space.lookAlong(upright.fromFile(stated.camera.target) - eye);
  camera = space.at(camera, eye);
  camera.azimuthDegrees = look.azimuthDegrees;
  camera.pitchDegrees = look.pitchDegrees;
  if (stated.statesFieldOfView) camera.verticalFieldOfViewDegrees = stated.camera.verticalFieldOfViewDegrees;
  if (const Result<View> view = uprightView(camera); !view)
    return failure(view.error().code, view.error().message, "--camera " + a.viewpoint.camera);
  return camera;
}

/// As --camera takes it.
Json jsonOf(const Camera& camera, const ZUpFrame& upright, double distance) {
  const CameraSpace space;
  const Vec3 eye = space.position(camera);
  const Vec3 target = eye + distance * space.forward(lookOf(camera));
  const auto list = [&](const Vec3& p) {
    const Vec3 q = upright.toFile(p);
    return Json::array({q.x, q.y, q.z});
  };
  return {{"eye", list(eye)}, {"target", list(target)}, {"fov", camera.verticalFieldOfViewDegrees}};
}

Json jsonOf(const SurfaceFigures& f) {
  return {{"triangles", f.triangles},
          {"pixelError", std::isfinite(f.pixels) ? Json(f.pixels) : Json()},
          {"isComplete", f.isComplete},
          {"showsSurface", f.showsSurface},
          {"cutMilliseconds", f.cutMilliseconds},
          {"drawMilliseconds", f.drawMilliseconds}};
}

std::string accuracyOf(const SurfaceFigures& figures) {
  if (!std::isfinite(figures.pixels)) return "its error around the eye not known";
  return fmt::format("within {:.3g} pixel{}", figures.pixels, figures.pixels == 1 ? "" : "s");
}

class SurfacePictures {
 public:
  SurfacePictures(const ViewArguments& arguments, const SurfaceViewSettings& settings, HeadlessSurface& view,
                  Session& session)
      : a_(arguments), settings_(settings), view_(view), session_(session) {}

  Status takeScreenshot(const Camera& camera, Json& json) {
    ARETE_TRY(const SurfaceFigures figures, draw(camera));
    ARETE_CHECK(savePng(view_.image(), a_.pictures.screenshot));
    if (!figures.showsSurface) session_.warn("the picture shows nothing of the surface");
    if (!figures.isComplete)
      session_.warn(fmt::format("the budget ended the cut: the surface is {}", accuracyOf(figures)));
    session_.say(fmt::format("{}: {}, {}\n", a_.pictures.screenshot,
                             grouped(figures.triangles, "triangle", "triangles"), accuracyOf(figures)));
    json["screenshot"] = {
        {"file", a_.pictures.screenshot},
        {"camera", jsonOf(camera, view_.view().upright(), view_.view().shape().box.diagonal())},
        {"figures", jsonOf(figures)}};
    return {};
  }

  /// One turn around the middle of the surface, from the home view on.
  Status makeTurn(const Camera& first, Json& json) {
    const double rate = a_.pictures.framesPerSecond > 0 ? a_.pictures.framesPerSecond : kFramesPerSecond;
    const auto count = static_cast<std::size_t>(std::max(1.0, std::round(rate * kSecondsOfATurn)));
    std::error_code failed;
    fs::create_directories(a_.pictures.frames, failed);
    if (failed)
      return failure(ErrorCode::unreadable, "the folder cannot be made: " + failed.message(),
                     a_.pictures.frames);
    // The camera turns with its place, so the middle of the surface stays in the middle of each picture.
    const CameraSpace space;
    const Vec3 middle = view_.view().shape().box.centre(), from = space.position(first) - middle;
    Json list = Json::array();
    std::uint64_t triangles = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double turn = 2 * std::numbers::pi * double(i) / double(count);
      const Vec3 at = middle + Vec3{from.x * std::cos(turn) - from.y * std::sin(turn),
                                    from.x * std::sin(turn) + from.y * std::cos(turn), from.z};
      Camera camera = space.at(first, at);
      camera.azimuthDegrees = wrappedAzimuth(first.azimuthDegrees - turn * 180 / std::numbers::pi);
      ARETE_TRY(const SurfaceFigures figures, draw(camera));
      const auto path = fs::path(a_.pictures.frames) / fmt::format("frame_{:05}.png", i);
      ARETE_CHECK(savePng(view_.image(), path));
      Json entry = {{"file", path.string()},
                    {"seconds", double(i) / rate},
                    {"camera", jsonOf(camera, view_.view().upright(), norm(from))}};
      if (a_.pictures.dropsFrames) entry.erase("file");
      entry.update(jsonOf(figures));
      list.push_back(std::move(entry));
      triangles += figures.triangles;
      session_.context().report("draw frames", double(i + 1) / double(count));
    }
    json["frames"] = std::move(list);
    // The figures of all frames go to a file only if one is named; the film is made of the frames in their
    // folder.
    if (!a_.pictures.figures.empty()) {
      ARETE_TRY(auto file, FileWriter::create(a_.pictures.figures));
      file.write(json.dump(1) + "\n");
      ARETE_CHECK(file.finish());
    }
    warnOfFramesBehind(a_.pictures.frames, count, session_);
    if (!a_.pictures.dropsFrames)
      session_.say(fmt::format("{}: {}, {} in the mean\n", a_.pictures.frames,
                               grouped(count, "frame", "frames"),
                               grouped(triangles / count, "triangle", "triangles")));
    if (a_.pictures.film.empty()) return {};
    ARETE_CHECK(makeFilmOf(a_.pictures, count, rate, session_));
    json["film"] = a_.pictures.film;
    return {};
  }

 private:
  /// A budget that is too small is reported under the option that states it.
  Result<SurfaceFigures> draw(const Camera& camera) {
    Result<SurfaceFigures> figures = view_.draw(camera, settings_, session_.context());
    if (!figures && figures.error().culprit == "maxTriangles")
      return failure(figures.error().code, figures.error().message,
                     fmt::format("--max-triangles {}", a_.detail.maxTriangles));
    return figures;
  }

  const ViewArguments& a_;
  const SurfaceViewSettings& settings_;
  HeadlessSurface& view_;
  Session& session_;
};

}  // namespace

Status viewSurface(ViewArguments a, const AmtContainer& file, Session& session) {
  ARETE_TRY(SurfaceViewSettings settings, a.ofSurface());
  ARETE_CHECK(a.check());
  ARETE_TRY(const FramesFolder frames, FramesFolder::of(a.pictures));
  if (a.viewpoint.isRound && a.pictures.frames.empty())
    return failure(ErrorCode::usage, "requires --frames, where the file is of a surface", "--round");
  ARETE_TRY(const auto size, a.pictures.size());
  ARETE_CHECK(checkPictureOutputs(a, {a.model}));
  ARETE_TRY(const SurfaceModel model, loadSurfaceAmt(file, AmtVerify::all, session.context()));
  ARETE_CHECK(a.detail.findBudget(model.mt.finestTriangleCount()));
  settings.maxTriangles = static_cast<std::uint32_t>(a.detail.maxTriangles);
  const ZUpFrame upright(model, a.viewpoint.up);
  ARETE_TRY(const Camera camera, cameraOf(a, upright, uprightShape(model, upright), size.first, size.second));

  if (!a.pictures.isHeadless) {
    SurfaceWindowOptions window{.title = fmt::format("arete - {}", a.model)};
    window.settings = settings;
    window.home = a.viewpoint.homeView();
    if (!a.viewpoint.camera.empty()) window.camera = camera;
    if (!a.pictures.sizeText.empty()) std::tie(window.width, window.height) = size;
    window.samples = a.pictures.samples;
    window.lastPicture = a.pictures.windowScreenshot;
    window.frames = a.pictures.windowFrames;
    return runSurfaceWindow(model, upright, window, session.context());
  }

  ARETE_TRY(HeadlessSurface view,
            HeadlessSurface::create(model, upright, {size.first, size.second, a.pictures.samples}));
  session.warn(view.view().warnings(), a.model);
  Json json = {{"model", a.model}, {"kind", "surface"}, {"renderer", view.description()}};
  a.detail.addBudgetTo(json, model.mt.finestTriangleCount());
  SurfacePictures pictures(a, settings, view, session);
  if (!a.pictures.screenshot.empty()) ARETE_CHECK(pictures.takeScreenshot(camera, json));
  if (!a.pictures.frames.empty()) ARETE_CHECK(pictures.makeTurn(camera, json));
  session.answer(json);
  return {};
}

}  // namespace arete
