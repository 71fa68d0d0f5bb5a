// SPDX-License-Identifier: GPL-3.0-or-later
//
// Draws into an off-screen framebuffer. With a budget, the tolerance is adapted by repeated cuts until the
// triangles fit. A film is PNG files that ffmpeg encodes.
#include "viewer/headless/headless.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <system_error>

#include "engine/base/stopwatch.h"
#include "io/files/text_scan.h"
#include "io/files/written_files.h"
#include "viewer/gl/terrain_drawable.h"
#include "viewer/overlay/picture_of_scene.h"

extern char** environ;

namespace arete {
namespace {

using namespace std::string_literals;

constexpr std::uint64_t kMostFrames = 1'000'000;

}  // namespace

Result<HeadlessView> HeadlessView::create(const HeadlessOptions& options, const FillScene& fill) {
  ARETE_TRY(OffscreenContext gl, OffscreenContext::create());
  ARETE_TRY(FrameTarget target,
            FrameTarget::create(options.widthPixels, options.heightPixels, options.samples));
  ARETE_TRY(Scene scene, Scene::create());
  HeadlessView view(std::move(gl), std::move(target), std::move(scene), options);
  ARETE_CHECK(fill(view.scene_));
  view.warnings_ = view.scene_.warnings();
  const std::string refusal = view.scene_.deviceRefusal();
  if (options.settings.path == CutPath::device && !refusal.empty()) {
    view.warnings_.push_back({WarningCode::display, "the processor takes the cuts: " + refusal});
    view.settings_.path = CutPath::processor;
  }
  return view;
}

Result<HeadlessView> HeadlessView::create(const TerrainModel& model, const HeadlessOptions& options,
                                          const RunContext& context) {
  return create(options, [&](Scene& scene) -> Status {
    ARETE_TRY(TerrainDrawable made, TerrainDrawable::create(model, {.path = options.settings.path}, context));
    return scene.add(std::make_unique<TerrainDrawable>(std::move(made)));
  });
}

Result<FrameFigures> HeadlessView::draw(const Camera& stated, const RunContext& context) {
  Camera camera = stated;
  camera.widthPixels = double(target_.width()) / scene_.panes();
  camera.heightPixels = target_.height();
  ViewSettings settings = settings_;
  settings.waits = true;
  ARETE_CHECK(scene_.advance(camera, settings, context));
  Result<FrameFigures> figures = scene_.cut(camera, settings, context);
  if (!figures) return figures;
  // The device's cut knows its number of triangles beforehand, but not which tolerance has fewer: doubled
  // until there are few enough, halved between (on a logarithmic scale) until nearly all of the budget is
  // used.
  // The room on the device is of one terrain; what other models have they make room for.
  const std::uint32_t room = scene_.drawables().size() == 1 ? scene_.capacity() : 0;
  const std::uint32_t most = settings.maxTriangles > 0 ? settings.maxTriangles : room;
  const auto fits = [&] { return figures->isComplete && (most == 0 || figures->asked <= most); };
  if (!scene_.keepsBudget(settings) && !fits()) {
    const auto cutAt = [&](double pixels) -> Status {
      settings.pixels = pixels;
      figures = scene_.cut(camera, settings, context);
      return figures ? Status() : tl::unexpected(figures.error());
    };
    constexpr int kDoublings = 60, kHalvings = 12;
    constexpr double kUsed = 0.99;
    double tooFine = settings.pixels, coarse = tooFine;
    for (int i = 0; i < kDoublings && !fits(); ++i) {
      tooFine = coarse;
      coarse *= 2;
      ARETE_CHECK(cutAt(coarse));
    }
    const bool canFit = fits();  // else the root alone is beyond the budget
    for (int i = 0; i < kHalvings && canFit && figures->asked < kUsed * most; ++i) {
      const double middle = std::sqrt(tooFine * coarse);
      ARETE_CHECK(cutAt(middle));
      (fits() ? coarse : tooFine) = middle;
    }
    if (canFit && !fits()) ARETE_CHECK(cutAt(coarse));
    figures->isComplete = false;
  }
  // A missing page does not call for a coarser cut, so it counts only now.
  if (figures->pages && figures->pages->missingTriangles > 0) figures->isComplete = false;
  // The time of drawing ends when the device has finished, and not when the last call returns.
  const Stopwatch watch;
  target_.begin();
  camera_ = camera;
  ARETE_CHECK(scene_.draw(camera, settings));
  glFinish();
  figures->isShown = scene_.isShown();
  // Levels by hand are no tolerance of the scene; where there is nothing else, theirs is what the picture
  // keeps.
  const auto& objects = scene_.objects();
  if (std::ranges::all_of(objects, [](const ShownObject& o) { return o.level || !o.isShown; }))
    for (const ShownObject& object : objects)
      if (object.isShown) figures->pixels = std::max(figures->pixels, object.figures.pixels);
  figures->drawMilliseconds = watch.milliseconds();
  return figures;
}

Result<Image> HeadlessView::picture() {
  Image image = target_.image();
  if (!decorations_.any()) return image;
  ARETE_TRY(const PictureGround ground, groundOfPicture(scene_, target_, camera_, settings_));
  if (!legends_) legends_.emplace(scene_.subject());
  return decorated(image, ground, legends_->of(settings_, scene_.layers.list()), decorations_);
}

/// A flight of too many frames is refused before the first one is drawn.
Result<std::uint64_t> filmFrames(const Flight& flight, double framesPerSecond) {
  const std::uint64_t count = flight.frameCount(framesPerSecond);
  if (count <= kMostFrames) return count;
  return failure(
      ErrorCode::usage,
      fmt::format("{:.6g} seconds of flight are more than {} frames", flight.duration(), kMostFrames),
      "flight");
}

// Frames are drawn at exact times of the flight, and each waits for its full detail, so that a film does not
// depend on the speed of the machine.
Result<std::vector<FilmFrame>> drawFilm(HeadlessView& view, const Flight& flight, const FilmOptions& options,
                                        const RunContext& context) {
  const double rate = options.framesPerSecond > 0 ? options.framesPerSecond : flight.plan().framesPerSecond;
  ARETE_TRY(const std::uint64_t count, filmFrames(flight, rate));
  std::error_code failed;
  std::filesystem::create_directories(options.folder, failed);
  if (failed)
    return failure(ErrorCode::unreadable, "the folder cannot be made: " + failed.message(),
                   options.folder.string());
  std::vector<FilmFrame> frames;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (context.cancelled())
      return failure(ErrorCode::interrupted, "the film was interrupted", options.folder.string());
    FilmFrame frame;
    frame.seconds = double(i) / rate;
    frame.camera = flight.at(frame.seconds);
    const auto path = options.folder / fmt::format("frame_{:05}.png", i);
    const Result<FrameFigures> figures = view.draw(frame.camera, context);
    if (!figures)
      return failure(figures.error().code, figures.error().message,
                     fmt::format("{}, {}", path.string(), figures.error().culprit));
    frame.figures = *figures;
    ARETE_TRY(const Image image, view.picture());
    ARETE_CHECK(savePng(image, path));
    frame.file = path.string();
    frames.push_back(std::move(frame));
    context.report("draw frames", double(i + 1) / double(count));
  }
  return frames;
}

// Everything that can be known to fail is checked before the frames are drawn, which can take minutes.
Status canEncodeFilm(const std::filesystem::path& film) {
  constexpr std::array kEndings = {"mp4", "m4v", "mov", "mkv", "avi"};
  if (std::ranges::find(kEndings, text::lowerExtension(film.string())) == kEndings.end())
    return failure(ErrorCode::usage, "a film ends in .mp4, .m4v, .mov, .mkv or .avi", film.string());
  // As posix_spawnp() looks for it.
  const char* listed = std::getenv("PATH");
  const std::string folders = listed ? listed : "/bin:/usr/bin";
  for (std::size_t at = 0; at <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', at), folders.size());
    if (::access((std::filesystem::path(folders.substr(at, end - at)) / "ffmpeg").c_str(), X_OK) == 0)
      return {};
    at = end + 1;
  }
  return failure(
      ErrorCode::unsupported,
      "a film needs ffmpeg, which is not installed (Debian: ffmpeg); `frames` alone does not need it",
      film.string());
}

Status encodeFilm(const std::filesystem::path& folder, std::size_t frames, double framesPerSecond,
                  const std::filesystem::path& film, const RunContext& context) {
  // Under another name until it is whole; the ending says the format.
  const std::filesystem::path part =
      film.parent_path() / fmt::format(".{}.part{}", film.stem().string(), film.extension().string());
  const std::string rate = fmt::format("{}", framesPerSecond), count = std::to_string(frames),
                    pattern = (folder / "frame_%05d.png").string(), output = part.string();
  // Only the frames of this flight; sides of the picture rounded to even numbers, which H.264 needs.
  std::vector<std::string> words = {"ffmpeg", "-v", "error", "-nostdin", "-y", "-framerate", rate};
  for (const std::string& more :
       {"-start_number"s, "0"s, "-i"s, pattern, "-vf"s, "pad=ceil(iw/2)*2:ceil(ih/2)*2"s, "-frames:v"s, count,
        "-c:v"s, "libx264"s, "-pix_fmt"s, "yuv420p"s, "-movflags"s, "+faststart"s, output})
    words.push_back(more);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = 0;
  if (const int error = posix_spawnp(&child, "ffmpeg", nullptr, nullptr, arguments.data(), environ);
      error != 0)
    return failure(
        ErrorCode::unsupported,
        "a film needs ffmpeg, which this machine does not have (Debian: ffmpeg); the frames are there",
        film.string());
  int status = 0;
  while (waitpid(child, &status, 0) == -1 && errno == EINTR) {
  }
  std::error_code error;
  if (status == 0 && !context.cancelled()) {
    const auto sizeOf = [](const std::filesystem::path& file) -> std::optional<std::uint64_t> {
      std::error_code none;
      const auto bytes = std::filesystem::file_size(file, none);
      return none ? std::nullopt : std::optional<std::uint64_t>(bytes);
    };
    const auto older = sizeOf(film);
    std::filesystem::rename(part, film, error);
    if (!error) {
      noteWritten({.path = film.string(), .bytes = sizeOf(film).value_or(0), .olderBytes = older});
      return {};
    }
  }
  std::filesystem::remove(part, error);
  if (context.cancelled())
    return failure(ErrorCode::interrupted, "the film was interrupted; the frames are there", film.string());
  return failure(ErrorCode::unreadable, "ffmpeg did not make it; the frames are there", film.string());
}

Status savePng(const Image& image, const std::filesystem::path& path) {
  ARETE_TRY(Canvas canvas, Canvas::create(image.width, image.height));
  canvas.image(image, 0, 0);
  return canvas.savePng(path);
}

}  // namespace arete
