// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "viewer/camera/free_camera.h"
#include "viewer/camera/ground_following.h"
#include "viewer/camera/orbit_camera.h"
#include "viewer/scene/subject.h"
#include "viewer/window/camera_motion.h"

namespace arete {

/// The camera of the window, moved by input: an orbit, free flight, and, where there is ground, a lowest
/// height above it for both. Around a model without ground, an orbit is moved in the plane of the picture.
///
/// With vertical exaggeration it moves in the space that is drawn: an orbit stays centred, and flying ahead
/// goes where the picture's middle is. camera() has heights without exaggeration. Keeps references.
class CameraRig {
 public:
  /// Precondition: the subject outlives this. The camera begins as an orbit of what it looks at.
  CameraRig(const Subject& subject, const Camera& start);

  const Camera& camera() const { return camera_; }
  CameraMode mode() const { return mode_; }

  /// Moves the camera for one frame, never below the floor.
  ///
  /// @return whether the input moves it.
  bool step(const InputState& input);

  /// What an orbit turns about, in metric space with heights as they are, and how far away it is.
  Vec3 orbitCentre() const {
    const Vec3& target = orbit_.orbit().target;
    return {target.x, target.y, target.z / stretch_};
  }
  double orbitRadius() const { return orbit_.orbit().radius; }

  /// Changes between orbit and free flight; the picture stays.
  void setMode(CameraMode mode);
  /// Sets the camera, as a flight or a key frame does. Picture size and exaggeration stay.
  void place(const Camera& camera);
  /// A view of the whole model in what is free of the picture, on the curved Earth if it is shown.
  void home(HomeView view, bool isCurved = false, const CoveredEdges& covered = {});
  /// Orbits a place of the model, from where the camera looks now, at `metres` from it (0 = as far as now).
  void lookAt(const Vec3& metric, double metres = 0);

  void setPicture(double widthPixels, double heightPixels);
  void setFieldOfView(double degrees);
  /// To parallel projection and back; what is orbited stays as large in the picture.
  void setParallel(bool isParallel);
  /// The height of the parallel picture in metres. Precondition: above 0.
  void setParallelHeight(double metres);
  void setStretch(double stretch);

  /// Keeps the height above the ground in free flight. Without ground: nothing.
  void follow(bool isOn);
  bool follows() const { return follows_; }
  /// The lowest height above the ground in metres; 0 = no limit.
  double floorMetres() const { return floorMetres_; }
  void setFloorMetres(double metres);
  /// Of free flight, metres per second.
  double metresPerSecond() const { return metresPerSecond_; }
  void setMetresPerSecond(double speed);
  /// Its speed in the last frame, in metres per second.
  double lastMetresPerSecond() const { return lastSpeed_; }
  /// Height above the ground in metres; nothing where there is none.
  std::optional<double> metresAboveGround() const;

 private:
  Camera shown(Camera camera) const;
  Camera asIs(Camera camera) const;
  double reach() const;
  void enter(const Camera& camera);
  Camera aboveFloor(const Camera& camera);

  const Subject& subject_;
  CameraSpace space_;
  CameraMode mode_ = CameraMode::orbit;
  Camera camera_;
  double stretch_ = 1;
  double floorMetres_ = 2;  // before ground_, which is made with it
  OrbitCamera orbit_;
  FreeCamera free_;
  std::optional<GroundFollowing> ground_;  // nothing without ground
  bool follows_ = false;
  double metresPerSecond_, lastSpeed_ = 0;
};

}  // namespace arete
