// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "viewer/window/viewer_session.h"

namespace arete {

/// What a hand would do in a window, line by line, for tests. Empty lines and those that begin with # are
/// left out:
///
///     halve                    half of the triangles, by hand
///     error E | triangles N    a level by hand
///     save FILE                this cut; says how many triangles it has
///     box X0,Y0,Z0,X1,Y1,Z1    shows the box there
///     crop FILE
///     decimate METHOD N|P% FILE
///     drag X0,Y0,X1,Y1         the left button, between pixels
///     click X,Y
///     open FILE                as a file that is dropped on the window
///     yes | no                 answers a question
///     key, play, around, free  of the flight, and of the camera
///     color INK                an entry of the menu of colours: charts, stretch, error:uv
///     select N                 an object of a scene, from 0
///     frames N                 waits
///     screenshot
///
/// Each waits for the frame after the last, and for what runs in the background. Results are opened by `open`
/// alone. Sentences of the window go to stdout.
class WindowScript {
 public:
  /// Errors: notFound; usage: a line without a known action, with its number.
  static Result<WindowScript> read(const std::string& path);

  /// Before each frame. @return whether the window stays open: not behind the last line.
  bool step(ViewerSession& session);

 private:
  void act(const std::string& verb, const std::vector<std::string>& words, ViewerSession& session);

  std::vector<std::vector<std::string>> lines_;
  std::size_t next_ = 0;
  int wait_ = 2;  // frames: the figures of a cut are there then
  std::string said_;
};

}  // namespace arete
