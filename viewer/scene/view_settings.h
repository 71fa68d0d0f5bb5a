// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "engine/criteria/view.h"
#include "viewer/color/terrain_colors.h"

namespace arete {

/// What a model's colours stand for. A model offers some of them (Subject::colorings()).
enum class Coloring { height, slope, aspect, plain, error, material, ink };

/// What computes the cut.
enum class CutPath { device, processor };

/// Where the light comes from, in degrees: clockwise from north and above the horizon.
struct Sun {
  double azimuthDegrees = 315, elevationDegrees = 40;
};

/// Which normals light falls on.
enum class SurfaceShading {
  flat,    ///< the drawn triangles' own
  smooth,  ///< the source's, smooth across edges of less than 45 degrees
  stated   ///< the file's own, of corners or vertices; smooth where it has none
};

/// Which sides of a surface are seen.
enum class SurfaceSides {
  asStated,  ///< as the material says: the inside of what has one side is dark
  both,      ///< alike
  front      ///< what is turned away is not drawn
};

/// What a surface shows, and under what light: each by itself.
struct SurfaceLook {
  bool hasTextures = true, hasMaterialColors = true, hasVertexColors = true;
  SurfaceShading shading = SurfaceShading::stated;
  SurfaceSides sides = SurfaceSides::asStated;
  /// The sun's diffuse light, the sky's, a light at the eye, and what shines in all of them.
  bool hasSun = true, hasSky = true, hasHeadlight = true, hasHighlights = true;

  bool operator==(const SurfaceLook&) const = default;
};

/// What a box keeps of a surface, in the surface's upright space.
struct KeptBox {
  Vec3 low = {}, high = {};
};

/// Colours and light.
struct ViewLook {
  Coloring coloring = Coloring::height;
  bool isShaded = true;
  std::optional<Sun> sun =
      {};                     ///< nothing: as Sun has it; of a surface, from above the viewer's left shoulder
  double hazeKilometres = 0;  ///< distance at which haze hides about two thirds; 0 = none
  bool hasWireframe = false;
  SurfaceLook surface = {};
  /// The error of the hottest colour, in the unit of heights; 0 = as many pixels as the cut allows.
  double heatError = 0;
  std::string ink = {};  ///< of Coloring::ink: which of Subject::inks()
  /// The colours of heights, slopes, aspects and errors of a terrain. Null: the table's, for its heights.
  SharedColors colors = {};
  std::optional<KeptBox> kept = {};  ///< what of a surface lies outside is tinted
};

/// A level of detail that is chosen by hand, whatever the camera sees: one of the two.
struct HandLevel {
  double error = 0;             ///< in the unit of the model's errors
  std::uint32_t triangles = 0;  ///< at most; 0: the error counts

  bool operator==(const HandLevel&) const = default;
};

/// How the models of a scene are drawn. What a model does not know is refused by Subject::check().
struct ViewSettings {
  double pixels = 1;               ///< tolerance of what is drawn, moving or not
  std::uint32_t maxTriangles = 0;  ///< 0 = any number that there is room for
  /// The processor's cut stops after this time and continues in the next frame; 0 = no limit.
  double cutMilliseconds = 0;
  CutPath path = CutPath::device;
  bool isGeomorphed = true;
  bool waits = true;      ///< draw waits for the processor's cut of this frame; else it draws the last one
  double stretch = 1;     ///< vertical exaggeration
  bool isCurved = false;  ///< the Earth curves away (viewer/scene/curved_ground.h): for DEMs with a CRS
  ViewLook look = {};
  /// Depth of the plane that clips what is near, in metric units; 0: the model's own.
  double nearPlane = 0;
  /// A ball about all that a scene draws, for depths in parallel projection; of radius 0: the model's own.
  Vec3 contentsMiddle = {};
  double contentsRadius = 0;
  std::optional<HandLevel> level = {};  ///< instead of the tolerance and the budget
  /// Of a model that is read in pages: bytes that are read before a picture; 0 = as many as it needs.
  std::uint64_t pageBytes = 0;
};

/// What was read of the pages of a model before a picture, and what the picture lacks of them.
struct PageFigures {
  std::uint64_t pages = 0, bytes = 0;                ///< that were read since the picture before
  std::uint64_t missingPages = 0, missingBytes = 0;  ///< that the camera needs and are not in memory
  std::uint64_t residentBytes = 0;                   ///< in memory, packed
  /// Triangles of the picture that are too coarse because what refines them is not there.
  std::uint32_t missingTriangles = 0;
};

/// What a frame took, and what it shows.
struct FrameFigures {
  std::uint32_t triangles = 0;  ///< drawn
  std::uint32_t asked = 0;      ///< of the whole cut at this tolerance
  std::uint32_t moving = 0;     ///< vertices that are being geomorphed
  double pixels = 0;            ///< tolerance of the cut; larger than asked where a budget ended it
  bool isComplete = true;       ///< false: a budget, a deadline or the room ended the cut
  /// The largest jump of this frame that geomorphing leaves, by the processor's cut; NaN by the device's,
  /// which takes the same nodes and does not compute it.
  double jumpPixels = std::numeric_limits<double>::quiet_NaN();
  double cutMilliseconds = 0, drawMilliseconds = 0;
  bool isShown = true;                    ///< false: nothing but the background; of pictures without a window
  std::optional<PageFigures> pages = {};  ///< of a model that is read in pages
};

/// The parameters of a frame of one model: its cut and its projection.
struct FrameView {
  View view;  ///< in metric space, heights multiplied by `stretch`; or in that of a CurvedGround
  bool isMirrored = false;  ///< metric space turns the other way round than the map
  double stretch = 1;       ///< vertical exaggeration, > 0
  double pixels = 1;        ///< tolerance of the cut, for vertices at rest
  double morphPixels = 0;   ///< additional error of moving vertices; 0 = no geomorphing
  Vec2 eyeGround;           ///< x and y of the eye in the flat metric space
  double earthRadius = 0;   ///< metres, on a CurvedGround, whose places are exaggerated already; 0 = flat
  double drawnNear = 0.1;   ///< depth of the near plane that clips what is drawn, metric units, > 0
  double depthReach = 1;  ///< parallel projection draws depths up to this, before the eye and behind it, > 0
};

}  // namespace arete
