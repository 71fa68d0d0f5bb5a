// SPDX-License-Identifier: GPL-3.0-or-later
//
// What `arete view --headless` writes: a screenshot, the frames of a flight, their figures and a film. What
// is wrong with the pictures, though they were drawn, is a warning.
#include "cli/view/pictures.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "engine/base/counted.h"
#include "io/files/file_writer.h"

namespace arete {
namespace {

Json jsonOf(const Camera& c) {
  return {{"x", c.xy.x},
          {"y", c.xy.y},
          {"height", c.height},
          {"azimuth", c.azimuthDegrees},
          {"pitch", c.pitchDegrees},
          {"fov", c.verticalFieldOfViewDegrees}};
}

Json jsonOf(const FrameFigures& f) {
  return {{"triangles", f.triangles},
          {"moving", f.moving},
          {"pixelError", std::isfinite(f.pixels) ? Json(f.pixels) : Json()},
          {"isComplete", f.isComplete},
          {"showsTerrain", f.showsTerrain},
          {"jumpPixels", std::isfinite(f.jumpPixels) ? Json(f.jumpPixels) : Json()},
          {"cutMilliseconds", f.cutMilliseconds},
          {"drawMilliseconds", f.drawMilliseconds}};
}

/// "within 1 pixel".
std::string accuracyOf(const FrameFigures& figures) {
  if (!std::isfinite(figures.pixels)) return "as coarse as it gets, its error around the eye not known";
  return fmt::format("within {:.3g} pixel{}", figures.pixels, figures.pixels == 1 ? "" : "s");
}

/// The nodes around the eye, whose pixels nothing bounds, are in every cut of the device.
bool exceedsBudget(const ViewArguments& a, const FrameFigures& figures) {
  return a.detail.maxTriangles > 0 && figures.triangles > static_cast<std::uint64_t>(a.detail.maxTriangles);
}

}  // namespace

Result<FramesFolder> FramesFolder::of(PictureArguments& pictures) {
  FramesFolder folder;
  if (!pictures.frames.empty() || pictures.film.empty()) return folder;
  std::error_code failed;
  std::string name = (std::filesystem::temp_directory_path(failed) / "arete-film-XXXXXX").string();
  if (failed || mkdtemp(name.data()) == nullptr)
    return failure(ErrorCode::unreadable, "a folder for temporary files cannot be made; --frames names one",
                   "--film " + pictures.film);
  folder.temporary_ = name;
  pictures.frames = name;
  pictures.dropsFrames = true;
  return folder;
}

FramesFolder::~FramesFolder() {
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove_all(temporary_, ignored);
}

Status makeFilmOf(const PictureArguments& pictures, std::size_t frames, double rate, Session& session) {
  Status encoded = encodeFilm(pictures.frames, frames, rate, pictures.film, session.context());
  // Its sentence says that the pictures are there.
  if (!encoded && pictures.dropsFrames)
    encoded.error().message.erase(
        std::min(encoded.error().message.find(';'), encoded.error().message.size()));
  if (encoded) session.say(fmt::format("{}: {}\n", pictures.film, grouped(frames, "frame", "frames")));
  return encoded;
}

void warnOfFramesBehind(const std::string& folder, std::size_t frames, const Session& session) {
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::path(folder) / fmt::format("frame_{:05}.png", frames),
                              ignored))
    session.warn(fmt::format("{} has frames of an earlier, longer flight behind these", folder));
}

/// Files beside the frames: none of the inputs, none of each other, none of the frames.
Status checkPictureOutputs(const ViewArguments& a, const std::vector<std::string>& inputs) {
  namespace fs = std::filesystem;
  std::vector<std::string> outputs;
  for (const auto& [option, path] : {std::pair{"--screenshot", a.pictures.screenshot},
                                     {"--film", a.pictures.film},
                                     {"--figures", a.pictures.figures}}) {
    if (path.empty()) continue;
    // A file that the frames will overwrite is named as an output already, so that the check below refuses
    // it.
    const fs::path file(path), folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    std::error_code ignored;
    const bool isFrame = !a.pictures.frames.empty() && file.filename().string().starts_with("frame_") &&
                         file.extension() == ".png" && fs::equivalent(folder, a.pictures.frames, ignored);
    if (isFrame) outputs.push_back(path);
    ARETE_CHECK(checkOutput(option, path, inputs, outputs));
    outputs.push_back(path);
  }
  return {};
}

// A refused camera is reported under the option that states it. A picture that falls short of what was wanted
// is written all the same, with a warning that says why.
Status takeScreenshot(const ViewArguments& a, const Camera& camera, HeadlessView& view, Session& session,
                      Json& json) {
  const Result<FrameFigures> figures = view.draw(camera);
  if (!figures)
    return failure(figures.error().code, figures.error().message,
                   figures.error().culprit == "camera" && !a.viewpoint.camera.empty()
                       ? "--camera " + a.viewpoint.camera
                       : figures.error().culprit);
  ARETE_CHECK(savePng(view.image(), a.pictures.screenshot));
  if (!figures->showsTerrain) session.warn("the picture shows nothing of the terrain");
  if (!figures->isComplete)
    session.warn(fmt::format("the {} ended the cut: the terrain is {}", a.detail.whatEndsTheCut(),
                             accuracyOf(*figures)));
  if (exceedsBudget(a, *figures))
    session.warn(fmt::format("--max-triangles {}: from there the coarsest cut has {}", a.detail.maxTriangles,
                             grouped(figures->triangles)));
  session.say(fmt::format("{}: {}, {} on the move, {}\n", a.pictures.screenshot,
                          grouped(figures->triangles, "triangle", "triangles"),
                          grouped(figures->moving, "vertex", "vertices"), accuracyOf(*figures)));
  json["screenshot"] = {
      {"file", a.pictures.screenshot}, {"camera", jsonOf(camera)}, {"figures", jsonOf(*figures)}};
  return {};
}

Status makeFilm(const ViewArguments& a, const Flight& flight, const GroundHeights& heights,
                HeadlessView& view, Session& session, Json& json) {
  ARETE_TRY(
      const auto frames,
      drawFilm(view, flight, {.folder = a.pictures.frames, .framesPerSecond = a.pictures.framesPerSecond},
               session.context()));
  // What is wrong is counted over all frames, and each defect is one warning, however long the film is.
  Json list = Json::array();
  std::uint64_t triangles = 0;
  std::size_t unfinished = 0, empty = 0, large = 0, buried = 0;
  for (const FilmFrame& frame : frames) {
    const auto ground = heights.at(frame.camera.xy);
    buried += ground && frame.camera.height < ground->height ? 1 : 0;
    unfinished += frame.figures.isComplete ? 0 : 1;
    empty += frame.figures.showsTerrain ? 0 : 1;
    large += exceedsBudget(a, frame.figures) ? 1 : 0;
  }
  if (empty > 0)
    session.warn(fmt::format("{} of {} nothing of the terrain", empty,
                             grouped(frames.size(), "frame shows", "frames show")));
  if (buried > 0)
    session.warn(fmt::format("the camera stands under the ground in {} of {}", buried,
                             grouped(frames.size(), "frame", "frames")));
  if (unfinished > 0)
    session.warn(fmt::format("the {} ended the cut of {} of {}", a.detail.whatEndsTheCut(), unfinished,
                             grouped(frames.size(), "frame", "frames")));
  if (large > 0)
    session.warn(fmt::format("--max-triangles {}: the coarsest {} of {} of {} more", a.detail.maxTriangles,
                             agreeing(frames.size(), "cut", "cuts"), large,
                             grouped(frames.size(), "frame has", "frames have")));
  warnOfFramesBehind(a.pictures.frames, frames.size(), session);
  // The figures list every frame; they go to a file of their own only if one is named.
  for (const FilmFrame& frame : frames) {
    Json entry = {{"file", frame.file}, {"seconds", frame.seconds}, {"camera", jsonOf(frame.camera)}};
    if (a.pictures.dropsFrames) entry.erase("file");
    entry.update(jsonOf(frame.figures));
    list.push_back(std::move(entry));
    triangles += frame.figures.triangles;
  }
  json["renderer"] = view.description();
  json["frames"] = std::move(list);
  if (!a.pictures.figures.empty()) {
    ARETE_TRY(auto file, FileWriter::create(a.pictures.figures));
    file.write(json.dump(1) + "\n");
    ARETE_CHECK(file.finish());
  }
  if (!a.pictures.dropsFrames)
    session.say(fmt::format("{}: {}, {} in the mean\n", a.pictures.frames,
                            grouped(frames.size(), "frame", "frames"),
                            grouped(triangles / frames.size(), "triangle", "triangles")));
  // The film is encoded from the frames in their folder, at the rate at which they were drawn.
  if (!a.pictures.film.empty()) {
    const double rate =
        a.pictures.framesPerSecond > 0 ? a.pictures.framesPerSecond : flight.plan().framesPerSecond;
    ARETE_CHECK(makeFilmOf(a.pictures, frames.size(), rate, session));
    json["film"] = a.pictures.film;
  }
  return {};
}

}  // namespace arete
