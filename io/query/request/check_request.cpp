// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/request/check_request.h"

#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace arete {
namespace {

using Field = std::pair<std::string_view, bool>;  // its name, and whether it is stated

tl::unexpected<Error> refused(std::string_view field, const char* why) {
  return failure(ErrorCode::usage, why, std::string(field));
}

Status checkKind(const CutRequest& r, ModelKind kind) {
  const bool fitsHeights = r.fit != CutFit::none && r.fit != CutFit::rms;
  const std::array ofTerrain = {Field{"planRegion", r.planRegion != nullptr},
                                Field{"camera", r.camera.has_value()}, Field{"distance", r.distance != 0},
                                Field{"fit", fitsHeights}};
  const std::array ofSurface = {
      Field{"spaceRegion", r.spaceRegion != nullptr}, Field{"spaceCamera", r.spaceCamera.has_value()},
      Field{"dropParts", r.dropParts != 0},           Field{"attributeErrors", !r.attributeErrors.empty()},
      Field{"importance", !r.importance.empty()},     Field{"fit", r.fit == CutFit::rms}};
  const std::span<const Field> ofOther =
      kind == ModelKind::terrain ? std::span<const Field>(ofSurface) : std::span<const Field>(ofTerrain);
  for (const auto& [name, isStated] : ofOther)
    if (isStated)
      return refused(name, kind == ModelKind::terrain ? "is for surfaces, and the model is of terrain"
                                                      : "is for terrain, and the model is of a surface");
  return {};
}

}  // namespace

Status checkRequest(const CutRequest& r, ModelKind kind) {
  ARETE_CHECK(checkKind(r, kind));
  const bool hasRegion = !r.region.empty() || r.planRegion || r.spaceRegion;
  // The allowed error depends on the place in one way.
  if (r.focus && hasRegion) return refused("focus", "cannot be combined with a region");
  if (r.hasCamera() && (hasRegion || r.focus))
    return refused("camera", "cannot be combined with a region or a focus");
  if (r.hasCamera() && r.maxError)
    return refused("camera", "measures in pixels (pixelError), and cannot be combined with maxError");
  if (r.pixelError && !r.hasCamera()) return refused("pixelError", "requires a camera");
  if (r.order == CutOrder::twoQueues && !r.hasCamera())
    return refused("order", "twoQueues requires a camera");
  if (!r.attributeErrors.empty() && r.method == CutMethod::saturated)
    return refused("attributeErrors", "cannot be combined with the saturated method");
  if (!r.attributeErrors.empty() && r.fit != CutFit::none)
    return refused("attributeErrors", "cannot be combined with a fit: it moves what is bounded");
  if (!r.importance.empty() && r.method == CutMethod::saturated)
    return refused("importance", "cannot be combined with the saturated method");
  if (!r.importance.empty() && r.fit != CutFit::none)
    return refused("importance", "cannot be combined with a fit: it keeps one error everywhere");
  if (r.fit == CutFit::none) return {};
  if (r.hasCamera() || r.focus || r.deadlineMilliseconds)
    return refused("fit", "cannot be combined with a camera, a focus or a deadline");
  if (r.fit == CutFit::triangles && !r.maxError) return refused("fit", "triangles requires maxError");
  if (r.fit == CutFit::triangles && r.method == CutMethod::saturated)
    return refused("fit", "triangles cannot be combined with the saturated method");
  if ((r.fit == CutFit::error || r.fit == CutFit::rms) && hasRegion)
    return refused("fit", "error and rms are for the whole model");
  return {};
}

}  // namespace arete
