// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "viewer/gl/terrain_view.h"
#include "viewer/scene/tolerance_control.h"
#include "viewer/window/camera_rig.h"
#include "viewer/window/flight_deck.h"
#include "viewer/window/frame_history.h"
#include "viewer/window/key_bindings.h"
#include "viewer/window/place_text.h"
#include "viewer/window/sight_tool.h"
#include "viewer/window/viewshed_job.h"

namespace arete {

/// The state of the window and its changes by keys, mouse and panel: without OpenGL, so that tests can use
/// it. Members are live: the panel changes them in place. Not movable.
class ViewerSession {
 public:
  struct Start {
    std::optional<Camera> camera = {};  ///< nothing: a home view
    ViewSettings settings = {};
    double frameMilliseconds = 0;  ///< 0: the tolerance is not adapted to time
    std::optional<FlightPlan> flight = {};
    bool hasDrape = false;  ///< the window's onReady sets one
    std::filesystem::path flightPath = "flight.json";
  };
  /// Precondition: the model outlives this. O(vertices).
  ViewerSession(const TerrainModel& model, const Start& start);
  ViewerSession(const ViewerSession&) = delete;
  ViewerSession& operator=(const ViewerSession&) = delete;

  /// One frame: moves the camera by hand or along the flight, takes in what other threads have done, and
  /// decides on the tolerance of the frame.
  void step(const InputState& input);
  void apply(Action action);
  /// A click on the terrain: the next pick. The first of two begins anew.
  void click(Vec2 pixel);
  /// Where the picture has a metric point, heights as they are; nothing where it is not in front.
  std::optional<Vec2> pixelOf(const Vec3& metric) const;
  void clearPicks();
  /// From the last pick.
  void startViewshed();
  void home(HomeView view);
  /// Moves to a typed place; message() says why it cannot.
  void goTo(const std::string& text, bool isLonLat);
  /// Shows a message for a few seconds.
  void say(std::string sentence);

  const TerrainModel& model;
  Profiles profiles;
  TerrainPicker picker;
  CameraRig rig;
  FlightDeck deck;
  PlaceText places;
  SightTool sights;

  ViewSettings settings;            ///< of the next frame; pixels are ToleranceControl's
  ToleranceControl::Wanted wanted;  ///< the user's settings
  FrameFigures figures;             ///< of the last frame
  FrameHistory history;
  std::uint64_t residentBytes = 0, deviceBytes = 0;
  std::string renderer;       ///< its name and version of OpenGL
  std::string deviceRefusal;  ///< why the device cannot compute cuts, or empty

  std::vector<TerrainPick> picks;             ///< none, one or two
  std::optional<SightPicture> sight;          ///< between two
  double observerAbove = 2, targetAbove = 2;  ///< above the terrain, in the DEM's vertical unit
  /// Again, after a height above the terrain has changed.
  void updateSight();
  ViewshedJob viewshed;
  bool hasDrape = false;
  bool canBeCurved = false;                ///< the DEM has a CRS
  std::optional<ViewshedOverlay> overlay;  ///< laid over the terrain
  bool isOverlayNew = false;               ///< the window has not drawn with it yet

  bool isFrozen = false;         ///< the cut stays while the camera flies on
  std::optional<Camera> frozen;  ///< the camera that it was taken for
  bool showsFrustum = true;
  bool showsPanel = true, showsHelp = false;
  bool wantsScreenshot = false;  ///< the window writes one and resets this
  std::filesystem::path flightPath;
  std::filesystem::path framesFolder;
  bool wantsFrames = false;  ///< the window renders the flight into the folder
  int mostOverlayPixels = 8192;

  const std::string& message() const { return message_; }

 private:
  /// Null on a flat map, and if the CRS has no ellipsoid.
  const CurvedGround* curvedGround();

  std::optional<CurvedGround> ground_;  // made at its first use
  std::string message_;
  double messageSeconds_ = 0;
  std::size_t nextHome_ = 0;
  ToleranceControl control_;
};

/// The edges of what a camera sees, up to a depth in metres, as pairs of ends in metric space, heights as
/// they are.
std::vector<std::array<Vec3, 2>> frustumEdges(const CameraSpace& space, const Camera& camera, double depth,
                                              double stretch);

/// An interval for contour lines that gives about a dozen over a range of heights: 1, 2 or 5 times a power of
/// ten.
double usualContourInterval(double heightRange);

}  // namespace arete
