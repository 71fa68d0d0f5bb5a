// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/camera.h"
#include "viewer/camera/flight.h"
#include "viewer/gl/terrain_view.h"
#include "viewer/picture/picture.h"

namespace arete {

struct HeadlessOptions {
  int widthPixels = 1280, heightPixels = 720;
  int samples = 4;  ///< of each pixel, to smooth edges
  ViewSettings settings;
};

/// Pictures of a terrain without a screen: an off-screen OpenGL context, which is current on the thread that
/// made it.
class HeadlessView {
 public:
  /// The model stays alive as long as this. Errors: unsupported (no OpenGL 4.5, a terrain too large for the
  /// device), usage (a size of picture that the device cannot draw).
  static Result<HeadlessView> create(const TerrainModel& model, const HeadlessOptions& options,
                                     const RunContext& context = {});
  HeadlessView(HeadlessView&&) noexcept;
  HeadlessView& operator=(HeadlessView&&) noexcept;
  ~HeadlessView();

  /// The terrain as the camera sees it. The picture's size is that of the options, whatever the camera says.
  /// With a budget the tolerance grows until the cut keeps it. Errors: usage, of the camera.
  Result<FrameFigures> draw(const Camera& camera);
  /// What was drawn last.
  Image image() const;

  TerrainView& view();
  /// What draws: the renderer's name and the version of OpenGL.
  const std::string& description() const;
  /// What the settings asked for and the device cannot, as sentences.
  const std::vector<std::string>& warnings() const;

 private:
  struct State;
  explicit HeadlessView(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

struct FilmOptions {
  std::filesystem::path folder;  ///< of frame_00000.png ...; made where it is not there
  double framesPerSecond = 0;    ///< 0 = the flight's
};

struct FilmFrame {
  std::string file;
  double seconds = 0;
  Camera camera;
  FrameFigures figures;
};

/// How many pictures a flight is, the flight's a second where it is 0. Errors: usage, more than a million.
Result<std::uint64_t> filmFrames(const Flight& flight, double framesPerSecond);

/// A flight's frames as PNGs, rising. Errors: usage (more than a million); those of drawing and writing;
/// interrupted, which leaves whole frames only. What goes wrong with a frame names it.
Result<std::vector<FilmFrame>> drawFilm(HeadlessView& view, const Flight& flight, const FilmOptions& options,
                                        const RunContext& context = {});

/// Whether encodeFilm() may be able to make a film of that name. Errors: usage (an ending of nothing that
/// holds H.264), unsupported (no ffmpeg on this machine).
Status canEncodeFilm(const std::filesystem::path& film);

/// The first frames of a folder as an H.264 film, by the ffmpeg of the machine. Errors: unsupported when
/// there is none; unreadable when it fails; interrupted. Then there is no film.
Status encodeFilm(const std::filesystem::path& folder, std::size_t frames, double framesPerSecond,
                  const std::filesystem::path& film, const RunContext& context = {});

Status savePng(const Image& image, const std::filesystem::path& path);

}  // namespace arete
