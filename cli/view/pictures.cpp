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
#include "io/files/written_files.h"

namespace arete {
namespace {

/// As --camera takes it, and key frames of flights.
Json jsonOf(const Camera& c, const Subject& subject) {
  Json json;
  if (subject.isTerrain()) {
    json = {{"x", c.xy.x},
            {"y", c.xy.y},
            {"height", c.height},
            {"azimuth", c.azimuthDegrees},
            {"pitch", c.pitchDegrees},
            {"fov", c.verticalFieldOfViewDegrees}};
    if (c.parallelHeight > 0) json["parallelHeight"] = c.parallelHeight;
    return json;
  }
  const Vec3 eye = subject.space().position(c),
             target = eye + subject.box().diagonal() * subject.space().forward(lookOf(c));
  const auto list = [&](const Vec3& p) {
    const Vec3 q = subject.inFile(p);
    return Json::array({q.x, q.y, q.z});
  };
  json = {{"eye", list(eye)}, {"target", list(target)}, {"fov", c.verticalFieldOfViewDegrees}};
  if (c.parallelHeight > 0) json["parallelHeight"] = c.parallelHeight;
  return json;
}

Json jsonOf(const FrameFigures& f, const Subject& subject) {
  const auto number = [](double n) { return std::isfinite(n) ? Json(n) : Json(); };
  Json json = {{"triangles", f.triangles},
               {"pixelError", number(f.pixels)},
               {"isComplete", f.isComplete},
               {subject.isTerrain() ? "showsTerrain" : "showsSurface", f.isShown},
               {"cutMilliseconds", f.cutMilliseconds},
               {"drawMilliseconds", f.drawMilliseconds},
               {"moving", f.moving},
               {"jumpPixels", number(f.jumpPixels)}};
  if (f.pages)
    json["pages"] = {{"read", f.pages->pages},
                     {"bytes", f.pages->bytes},
                     {"missing", f.pages->missingPages},
                     {"missingBytes", f.pages->missingBytes},
                     {"residentBytes", f.pages->residentBytes},
                     {"missingTriangles", f.pages->missingTriangles}};
  return json;
}

/// Of each object of a scene, after a picture of it.
Json jsonOf(const std::vector<ShownObject>& objects) {
  Json list = Json::array();
  for (const ShownObject& object : objects) {
    const double pixels = object.figures.pixels;
    list.push_back({{"name", object.name},
                    {"isShown", object.isShown},
                    {"triangles", object.isShown ? object.figures.triangles : 0},
                    {"pixelError", object.isShown && std::isfinite(pixels) ? Json(pixels) : Json()}});
  }
  return list;
}

/// "within 1 pixel".
std::string accuracyOf(const FrameFigures& figures) {
  if (!std::isfinite(figures.pixels)) return "of an error around the eye that is not known";
  return fmt::format("within {:.3g} pixel{}", figures.pixels, figures.pixels == 1 ? "" : "s");
}

/// Errors are named as the options that state what is wrong.
tl::unexpected<Error> namedByOption(const Error& error, const ViewArguments& a) {
  std::string culprit = error.culprit;
  if (culprit == "maxTriangles") culprit = fmt::format("--max-triangles {}", a.detail.maxTriangles);
  if (culprit == "camera" && !a.viewpoint.camera.empty()) culprit = "--camera " + a.viewpoint.camera;
  return failure(error.code, error.message, culprit);
}

bool lacksPages(const FrameFigures& figures) {
  return figures.pages && figures.pages->missingTriangles > 0;
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

// A picture that falls short of what was wanted is written all the same, with a warning that says why.
Status takeScreenshot(const ViewArguments& a, const Camera& camera, HeadlessView& view, Session& session,
                      Json& json) {
  const Subject& subject = view.scene().subject();
  const Result<FrameFigures> figures = view.draw(camera, session.context());
  if (!figures) return namedByOption(figures.error(), a);
  // A picture is drawn in one go, so an interruption is noticed behind it.
  if (session.context().cancelled())
    return failure(ErrorCode::interrupted, "the picture was interrupted", a.pictures.screenshot);
  ARETE_TRY(const Image picture, view.picture());
  ARETE_CHECK(savePng(picture, a.pictures.screenshot));
  if (!figures->isShown) session.warn(fmt::format("the picture shows nothing of the {}", subject.kind()));
  if (lacksPages(*figures))
    session.warn(fmt::format("the pages that --page-memory has room for are too few: the {} is {}",
                             subject.kind(), accuracyOf(*figures)));
  else if (!figures->isComplete)
    session.warn(fmt::format("the {} ended the cut: the {} is {}", a.detail.whatEndsTheCut(), subject.kind(),
                             accuracyOf(*figures)));
  if (exceedsBudget(a, *figures))
    session.warn(fmt::format("--max-triangles {}: from there the coarsest cut has {}", a.detail.maxTriangles,
                             grouped(figures->triangles)));
  session.say(fmt::format("{}: {}, {} on the move, {}\n", a.pictures.screenshot,
                          grouped(figures->triangles, "triangle", "triangles"),
                          grouped(figures->moving, "vertex", "vertices"), accuracyOf(*figures)));
  json["screenshot"] = {{"file", a.pictures.screenshot},
                        {"camera", jsonOf(camera, subject)},
                        {"figures", jsonOf(*figures, subject)}};
  if (view.scene().drawables().size() > 1) json["screenshot"]["objects"] = jsonOf(view.scene().objects());
  return {};
}

Status makeFilm(const ViewArguments& a, const Flight& flight, HeadlessView& view, Session& session,
                Json& json) {
  const PictureArguments& p = a.pictures;
  const Subject& subject = view.scene().subject();
  const auto drawn =
      drawFilm(view, flight, {.folder = p.frames, .framesPerSecond = p.framesPerSecond}, session.context());
  if (!drawn) return namedByOption(drawn.error(), a);
  const std::vector<FilmFrame>& frames = *drawn;
  // What is wrong is counted over all frames, and each defect is one warning, however long the film is. The
  // figures list every frame; they go to a file of their own only if one is named.
  Json list = Json::array();
  std::uint64_t triangles = 0;
  std::size_t unfinished = 0, empty = 0, large = 0, buried = 0, late = 0;
  double worst = 0;  // error in pixels of frames whose pages were late
  for (const FilmFrame& frame : frames) {
    // Of a model in pages the ground below the camera may not have been read.
    const auto ground =
        subject.heights() && !frame.figures.pages ? subject.heights()->at(frame.camera.xy) : std::nullopt;
    buried += ground && frame.camera.height < ground->height ? 1 : 0;
    if (lacksPages(frame.figures)) {
      ++late;
      worst = std::max(worst, frame.figures.pixels);
    } else {
      unfinished += frame.figures.isComplete ? 0 : 1;
    }
    empty += frame.figures.isShown ? 0 : 1;
    large += exceedsBudget(a, frame.figures) ? 1 : 0;
    triangles += frame.figures.triangles;
    Json entry = {{"seconds", frame.seconds}, {"camera", jsonOf(frame.camera, subject)}};
    if (p.dropsFrames)
      noteRestored(frame.file);
    else
      entry["file"] = frame.file;
    entry.update(jsonOf(frame.figures, subject));
    list.push_back(std::move(entry));
  }
  const std::string all = grouped(frames.size(), "frame", "frames");
  if (empty > 0)
    session.warn(fmt::format("{} of {} nothing of the {}", empty,
                             grouped(frames.size(), "frame shows", "frames show"), subject.kind()));
  if (buried > 0) session.warn(fmt::format("the camera stands under the ground in {} of {}", buried, all));
  if (unfinished > 0)
    session.warn(fmt::format("the {} ended the cut of {} of {}", a.detail.whatEndsTheCut(), unfinished, all));
  if (late > 0)
    session.warn(fmt::format(
        "pages were missing in {} of {}, which {} up to {} coarse", late, all, late == 1 ? "is" : "are",
        std::isfinite(worst) ? fmt::format("{:.3g} pixels", worst) : "any number of pixels"));
  if (large > 0)
    session.warn(fmt::format("--max-triangles {}: the coarsest {} of {} of {} more", a.detail.maxTriangles,
                             agreeing(frames.size(), "cut", "cuts"), large,
                             grouped(frames.size(), "frame has", "frames have")));
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::path(p.frames) / fmt::format("frame_{:05}.png", frames.size()),
                              ignored))
    session.warn(fmt::format("{} has frames of an earlier, longer flight behind these", p.frames));
  json["frames"] = std::move(list);
  if (!p.figures.empty()) {
    ARETE_TRY(auto file, FileWriter::create(p.figures));
    file.write(json.dump(1) + "\n");
    ARETE_CHECK(file.finish());
  }
  if (!p.dropsFrames)
    session.say(fmt::format("{}: {}, {} in the mean\n", p.frames, all,
                            grouped(triangles / frames.size(), "triangle", "triangles")));
  if (p.film.empty()) return {};
  // The film is encoded from the frames in their folder, at the rate at which they were drawn.
  const double rate = p.framesPerSecond > 0 ? p.framesPerSecond : flight.plan().framesPerSecond;
  Status encoded = encodeFilm(p.frames, frames.size(), rate, p.film, session.context());
  // Its sentence says that the pictures are there.
  if (!encoded && p.dropsFrames) {
    std::string& sentence = encoded.error().message;
    sentence.erase(std::min(sentence.find(';'), sentence.size()));
  }
  ARETE_CHECK(encoded);
  session.say(fmt::format("{}: {}\n", p.film, all));
  json["film"] = p.film;
  return {};
}

}  // namespace arete
