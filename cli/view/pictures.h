// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "cli/session/session.h"
#include "cli/view/arguments.h"
#include "engine/base/result.h"
#include "terrain/model/camera.h"
#include "viewer/camera/flight.h"
#include "viewer/headless/headless.h"

namespace arete {

/// Checks the names of the files that are written beside the frames: none is an input, another output, or a
/// frame.
///
/// @param inputs files that must not be overwritten.
/// Errors: usage, naming the option; those of checkOutput().
Status checkPictureOutputs(const ViewArguments& arguments, const std::vector<std::string>& inputs);

/// The folder of the pictures of a flight: the stated one, or a temporary one for a film alone, which is
/// removed with everything in it when this ends.
class FramesFolder {
 public:
  /// Sets `frames` and `dropsFrames` where a film alone is stated. Errors: unreadable: no folder can be made.
  static Result<FramesFolder> of(PictureArguments& pictures);
  FramesFolder(FramesFolder&& other) noexcept : temporary_(std::exchange(other.temporary_, {})) {}
  FramesFolder& operator=(FramesFolder&&) = delete;
  ~FramesFolder();

 private:
  FramesFolder() = default;
  std::string temporary_;  // empty: none
};

/// Draws one picture and writes it; adds "screenshot" to the JSON answer.
///
/// Warns where the picture shows nothing of the model or the cut ended early. Errors: those of
/// HeadlessView::draw() and savePng().
Status takeScreenshot(const ViewArguments& arguments, const Camera& camera, HeadlessView& view,
                      Session& session, Json& json);

/// Draws the frames of a flight, writes their figures and makes the film, as far as the arguments say; adds
/// "frames" and "film" to the JSON answer. Errors: those of drawFilm() and encodeFilm().
Status makeFilm(const ViewArguments& arguments, const Flight& flight, HeadlessView& view, Session& session,
                Json& json);

}  // namespace arete
