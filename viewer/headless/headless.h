// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/camera.h"
#include "viewer/camera/flight.h"
#include "viewer/decoration/decorations.h"
#include "viewer/decoration/scene_legends.h"
#include "viewer/gl/frame_target.h"
#include "viewer/gl/offscreen.h"
#include "viewer/gl/scene.h"
#include "viewer/picture/picture.h"

namespace arete {

struct HeadlessOptions {
  int widthPixels = 1280, heightPixels = 720;
  int samples = 4;  ///< of each pixel, to smooth edges
  ViewSettings settings;
  Decorations decorations = Decorations::none();  ///< of picture(), and so of films
};

/// Draws pictures of a scene without a screen, in an off-screen OpenGL context that is current on the thread
/// that created it.
class HeadlessView {
 public:
  /// Errors: unsupported (no OpenGL 4.5), usage (a size of picture that the device cannot draw); those of
  /// `fill`.
  static Result<HeadlessView> create(const HeadlessOptions& options, const FillScene& fill);
  /// Of a terrain alone, which stays alive as long as this. Errors: also unsupported, a terrain too large for
  /// the device.
  static Result<HeadlessView> create(const TerrainModel& model, const HeadlessOptions& options,
                                     const RunContext& context = {});
  /// The scene as the camera sees it. The size of the picture is that of the options, not of the camera. With
  /// a budget, the tolerance grows until the cut fits. Errors: as Scene.
  Result<FrameFigures> draw(const Camera& camera, const RunContext& context = {});
  /// The picture that was drawn last.
  Image image() const { return target_.image(); }
  /// The same with legends, scale bar, north arrow and graticule, as the options say. Precondition: draw()
  /// for the scene as it is. Errors: as Canvas::create().
  Result<Image> picture();

  /// From the next picture on: ViewSettings::pageBytes.
  void setPageBytes(std::uint64_t bytes) { settings_.pageBytes = bytes; }

  Scene& scene() { return scene_; }
  /// The renderer's name and the version of OpenGL.
  const std::string& description() const { return context_.description(); }
  /// What is not shown, and settings that the device does not support, as sentences.
  const Warnings& warnings() const { return warnings_; }

 private:
  HeadlessView(OffscreenContext context, FrameTarget target, Scene scene, const HeadlessOptions& options)
      : context_(std::move(context)),
        target_(std::move(target)),
        scene_(std::move(scene)),
        settings_(options.settings),
        decorations_(options.decorations) {}

  OffscreenContext context_;  // the last to go
  FrameTarget target_;
  Scene scene_;
  ViewSettings settings_;
  Decorations decorations_;
  Camera camera_;  // of the last picture
  std::optional<SceneLegends> legends_;
  Warnings warnings_;
};

struct FilmOptions {
  std::filesystem::path folder;  ///< of frame_00000.png ...; created if missing
  double framesPerSecond = 0;    ///< 0 = the flight's
};

struct FilmFrame {
  std::string file;
  double seconds = 0;
  Camera camera;
  FrameFigures figures;
};

/// The number of frames of a flight.
///
/// @param framesPerSecond 0 = the flight's.
/// Errors: usage: more than a million.
Result<std::uint64_t> filmFrames(const Flight& flight, double framesPerSecond);

/// Draws the frames of a flight in order and writes them as PNG. Errors: usage: more than a million frames;
/// those of drawing and writing, naming the frame; interrupted, which leaves complete frames only.
Result<std::vector<FilmFrame>> drawFilm(HeadlessView& view, const Flight& flight, const FilmOptions& options,
                                        const RunContext& context = {});

/// Checks whether encodeFilm() can make a film. Errors: usage: an extension of a format without H.264;
/// unsupported: ffmpeg is not installed.
Status canEncodeFilm(const std::filesystem::path& film);

/// Encodes the first frames of a folder as an H.264 film with the installed ffmpeg. Errors: unsupported:
/// it is not installed; unreadable: it fails; interrupted. No film is left after an error.
Status encodeFilm(const std::filesystem::path& folder, std::size_t frames, double framesPerSecond,
                  const std::filesystem::path& film, const RunContext& context = {});

Status savePng(const Image& image, const std::filesystem::path& path);

}  // namespace arete
