// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "viewer/marks/space_marks.h"
#include "viewer/objects/distance_picks.h"
#include "viewer/objects/object_list.h"
#include "viewer/panel/frame_history.h"
#include "viewer/panel/overwrite_question.h"
#include "viewer/scene/layer.h"
#include "viewer/scene/subject.h"
#include "viewer/scene/tolerance_control.h"
#include "viewer/tools/surface_desk.h"
#include "viewer/window/camera_rig.h"
#include "viewer/window/cursor.h"
#include "viewer/window/flight_deck.h"
#include "viewer/window/key_bindings.h"
#include "viewer/window/terrain_tools.h"

namespace arete {

/// The state of the window of a scene and its changes by keys, mouse and panel: without OpenGL, so that tests
/// can use it. What is for terrain alone (tools; some actions) is refused by name with a surface. Members are
/// live: the panel changes them in place. Not movable.
class ViewerSession {
 public:
  struct Start {
    std::optional<Camera> camera = {};  ///< nothing: a home view
    HomeView home = HomeView::overview;
    Camera picture = {};  ///< size of the window, for the home view
    ViewSettings settings = {};
    double frameMilliseconds = 0;  ///< 0: the tolerance is not adapted to time
    bool showsDecorations = true;
    SpaceMarks marks = {};
    std::optional<FlightPlan> flight = {};
    std::filesystem::path flightPath = "flight.json";
  };
  /// Preconditions: subject and layers outlive this. O(vertices).
  ViewerSession(const Subject& subject, Layers& layers, const Start& start);
  ViewerSession(const ViewerSession&) = delete;
  ViewerSession& operator=(const ViewerSession&) = delete;

  /// One frame: moves the camera by hand or along the flight, takes in what other threads have done, lays the
  /// lines of the flight and of a frozen camera, and decides on the tolerance of the frame.
  void step(const InputState& input);
  void apply(Action action);
  /// A click on the model: the next pick. The first of two begins anew.
  void click(Vec2 pixel);
  void home(HomeView view);
  /// Moves to a typed place of a terrain; message() says why it cannot.
  void goTo(const std::string& text, bool isLonLat);
  /// Writes frames of the flight, or ends that. Asks before frames are overwritten.
  void toggleFrames();
  /// The answer to the question.
  void answer(bool isYes);
  /// A flight around the model instead of the one at hand.
  void flyAround();
  /// Colours the model by one of Subject::inks(). @return why not, empty where it does.
  std::string colorByInk(const std::string& ink);
  /// Shows a message for a few seconds; nothing for an empty one.
  void say(std::string sentence);
  const std::string& message() const { return message_; }

  /// The layers that this window lays for its own hand, which no film has.
  static constexpr std::array kMarks = {"line of sight",       "flight",        "frozen camera",
                                        DistancePicks::kLayer, CropBox::kLayer, SpaceMarks::kOrbit};

  const Subject& subject;
  Layers& layers;
  CameraRig rig;
  FlightDeck deck;
  std::optional<TerrainTools> tools;  ///< nothing without a terrain
  DistancePicks distance;             ///< of surfaces without a terrain
  std::optional<ObjectList> objects;  ///< of the scene; nothing in a session without one
  Cursor cursor{subject, tools};
  OverwriteQuestion question;       ///< waits for answer() before a file is overwritten
  std::optional<SurfaceDesk> desk;  ///< of the surface that is selected; nothing without objects
  /// What the panel covers of the picture. A home view fills the rest, and again when that changes.
  CoveredEdges covered;

  ViewSettings settings;            ///< of the next frame; pixels are ToleranceControl's
  ToleranceControl::Wanted wanted;  ///< the user's settings
  FrameFigures figures;             ///< of the last frame
  ViewSettings cutSettings;         ///< that its cut was taken with
  FrameHistory history;
  bool isFrozen = false;         ///< the cut stays while the camera flies on
  std::optional<Camera> frozen;  ///< the camera that it was taken for

  struct Device {
    std::string renderer;  ///< its name and version of OpenGL
    std::string refusal;   ///< why it cannot compute cuts, or empty
    std::uint64_t residentBytes = 0, deviceBytes = 0;
  } device;
  struct Shows {
    bool panel = true, help = false, frustum = true;
    bool decorations = true;  ///< legend, scale bar, north arrow and graticule
    SpaceMarks marks;         ///< axes, ground grid and the centre of the orbit
  } shows;
  struct Files {
    std::filesystem::path flight, framesFolder = "frames";
    bool wantsScreenshot = false;  ///< the window writes one and resets this
    bool wantsFrames = false;      ///< the window renders the flight into the folder
    std::string next = {};         ///< a file to show instead; empty: none
  } files;

 private:
  void layMarks();
  void saveFlight(const std::filesystem::path& path);
  void moveCamera(const InputState& input);
  InputState withoutBoxDrag(const InputState& input);
  void readCursor(const InputState& input);
  Georeference georeference() const;

  bool wasLeftButton_ = false;
  std::string message_;
  double messageSeconds_ = 0;
  std::size_t nextHome_ = 0;
  /// The last home view, and what it was found for.
  struct Home {
    HomeView view = HomeView::overview;
    Camera camera;
    CoveredEdges covered;
    double stretch = 1;
    bool isCurved = false;
  };
  Home homeNow(HomeView view) const;
  std::optional<Home> home_;
  /// How long the camera has been at rest, and how the tolerance was controlled when it came to rest.
  double restSeconds_ = 0;
  std::optional<Camera> restCamera_;
  ToleranceControl control_, movingControl_;
  ToleranceControl::Wanted wantedNow(const InputState& input);
};

}  // namespace arete
