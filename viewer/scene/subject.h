// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/box3.h"
#include "engine/base/result.h"
#include "engine/mt/multitriangulation.h"
#include "terrain/locate/ground_height.h"
#include "viewer/camera/camera_space.h"
#include "viewer/camera/flight.h"
#include "viewer/camera/home_view.h"
#include "viewer/scene/layer.h"
#include "viewer/scene/triangle_ink.h"
#include "viewer/scene/view_settings.h"

namespace arete {

class TerrainSubject;

/// A place of a model that was picked with the mouse.
struct Pick {
  Vec2 plan;                  ///< plan coordinates of the model
  Vec2 xy;                    ///< source coordinates
  double height = 0;          ///< of the model at full resolution, in the source's vertical unit
  Vec3 metric;                ///< heights as they are, not exaggerated
  double metres = 0;          ///< from the eye, in a straight line
  double depth = 0;           ///< of the place as it is drawn, along the view: what is less is nearer
  std::string material = {};  ///< of a surface; empty: none
  Vec3 inObject = {};         ///< coordinates of its own file; of a terrain: xy and height
  std::size_t object = 0;     ///< of a scene: which
  std::string parts = {};     ///< of a surface: its object, group and labels in the file; empty: none
  /// The stored error of the triangle of the drawn cut there, in the unit of the model's errors; nothing: not
  /// known.
  std::optional<double> drawnError = {};
  /// Of a part of a surface: the error of its finest triangle there, where the whole has finer ones.
  double finestError = 0;
};

/// What a model is made of, at full resolution.
struct SubjectFacts {
  std::uint64_t vertices = 0, triangles = 0;
  std::size_t materials = 0;
  double largestError = 0;  ///< of the coarsest triangles, in the unit of its errors
};

/// What a camera looks at and moves around: a model without its graphics, at full resolution. Its metric
/// space (CameraSpace) has cameras, layers and picks too. What is of one kind of model alone is nothing,
/// or is refused by name, with the other.
class Subject {
 public:
  virtual ~Subject() = default;

  /// "terrain" or "surface".
  virtual std::string_view kind() const = 0;
  bool isTerrain() const { return kind() == "terrain"; }
  /// Whether it has a place among other models.
  virtual bool isPlaced() const { return isTerrain(); }
  const CameraSpace& space() const { return space_; }
  /// Holds all of the model, in metric space.
  virtual MetricBox box() const { return box_; }

  /// What a camera sees, in the space that is drawn with these settings. Errors: usage, culprit "camera";
  /// those of CurvedGround.
  virtual Result<View> viewOf(const Camera& camera, const ViewSettings& settings) const = 0;
  /// Where a place of metric space is drawn, heights exaggerated; not finite where a CRS does not reach.
  virtual Vec3 drawn(const Vec3& metric, const ViewSettings& settings) const = 0;
  /// The nearest camera of a direction that has the whole model in what is free of its picture. `picture`:
  /// its size and field of view.
  virtual Camera home(HomeView view, const Camera& picture, const ViewSettings& settings,
                      const CoveredEdges& covered = {}) const = 0;
  /// The place of the model at a pixel of a camera, whichever cut is drawn; nothing where there is none.
  virtual std::optional<Pick> pick(const Camera& camera, Vec2 pixel, const ViewSettings& settings) const = 0;
  /// Whether the ray of a pixel goes down through all heights of the model and meets none of it: there is
  /// NODATA.
  virtual bool isVoid(const Camera&, Vec2, const ViewSettings&) const { return false; }
  /// How far a cut may be from the model at a place that was picked, if the triangle of the cut there has at
  /// most an error of `allowed`, as the model stores it: of terrain vertically and between samples too, of a
  /// surface in any direction. In the source's vertical unit. O(depth * degree).
  virtual double boundAt(const Pick& pick, double allowed) const = 0;
  virtual SubjectFacts facts() const = 0;
  /// The unit of heights; empty: not known.
  virtual std::string heightUnit() const = 0;
  /// A closed flight around the model. `from`: a camera that has it in its picture. Errors: usage.
  virtual Result<FlightPlan> round(const Camera& from) const = 0;
  /// Of a place of metric space: what its file calls it, x, y and height.
  virtual Vec3 inFile(const Vec3& metric) const = 0;
  /// Back from there.
  virtual Vec3 fromFile(const Vec3& inFile) const { return space_.position({inFile.x, inFile.y}, inFile.z); }
  /// Holds all of the model, along the axes of its file.
  virtual Box3 fileBox() const;
  /// A length below which cameras do not come nearer to what they orbit.
  virtual double leastRadius() const = 0;
  /// Depth of the plane that clips what is near, in metric units, > 0.
  virtual double nearPlane() const = 0;
  /// Returns itself if it is a terrain, and the ground of a scene; null in a scene of surfaces alone.
  virtual const TerrainSubject* terrain() const { return nullptr; }
  /// The ground that cameras follow; null where there is none.
  virtual const GroundHeights* heights() const { return nullptr; }

  /// What the model can be coloured by, the usual one first.
  virtual std::span<const Coloring> colorings() const = 0;
  /// The names of the inks that its triangles can have beside: Coloring::ink, ViewLook::ink.
  virtual std::vector<std::string> inks() const { return {}; }
  /// One of them. Errors: usage, with the name as the culprit: it has none of that name, or why not.
  virtual Result<std::shared_ptr<const TriangleInk>> ink(const std::string& name) const;
  /// Errors: what of the settings it cannot show: usage, as "slopes are for terrain"; as CurvedGround.
  virtual Status check(const ViewSettings& settings) const = 0;
  /// Errors: usage: a layer that it cannot show, as "contours are for terrain", with its name as the culprit.
  Status check(const Layer& layer) const;

 protected:
  Subject(const CameraSpace& space, const MetricBox& box) : space_(space), box_(box) {}
  Status checkColoring(Coloring coloring) const;

  CameraSpace space_;
  MetricBox box_;
};

std::string_view toString(Coloring coloring);

/// The direction, in the space of the view, of a pixel of its picture. `isMirrored`: as CameraSpace says.
Vec3 directionOfPixel(const View& view, bool isMirrored, Vec2 pixel);
/// Where the ray of a place in the picture begins: at the eye, in parallel projection beside it, and `behind`
/// metric units behind it that the ray meets all that is seen.
Vec3 originOfPixel(const View& view, bool isMirrored, Vec2 pixel, double behind);
/// The place in a picture of a point in the eye's axes (Frustum::toView()); nothing behind a perspective eye.
std::optional<Vec2> pixelOfPoint(const View& view, bool isMirrored, const Vec3& inView);
/// A ball about a subject as it is drawn.
Sphere ballAbout(const Subject& subject, const ViewSettings& settings);
/// How far from the eye depths lie, before it or behind it, of all that is drawn.
double depthReach(const View& view, const Subject& subject, const ViewSettings& settings);

/// The pixel of a metric point in a camera's picture; nothing where it is not in front of it.
std::optional<Vec2> pixelOf(const Subject& subject, const Camera& camera, const Vec3& metric,
                            const ViewSettings& settings = {});

/// The edges of what a camera sees, up to a depth in metres, as lines in metric space.
SpaceVertices frustumEdges(const CameraSpace& space, const Camera& camera, double depth, double stretch);

}  // namespace arete
