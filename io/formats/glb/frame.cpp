// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/frame.h"

#include <fmt/format.h>

namespace arete {

namespace {

constexpr const char* kGeographic = "east-north-up";
constexpr const char* kProjected = "map";

}  // namespace

// Only the members that a kind of frame needs are written, so that none contradicts the others.
nlohmann::ordered_json toJson(const GlbFrame& frame) {
  const LocalFrameSpec& s = frame.local;
  nlohmann::ordered_json json = {
      {"axes", "x = east, y = up, z = south; metres"},
      {"frame", s.isGeographic ? kGeographic : kProjected},
      {"origin", {s.origin.x, s.origin.y, s.origin.z}},
      {"crsWkt", frame.crsWkt},
      {"verticalUnit", frame.verticalUnit},
      {"verticalUnitMetres", s.verticalUnitMetres},
  };
  if (s.isGeographic) {
    json["angularUnitRadians"] = s.angularUnitRadians;
    json["semiMajorAxisMetres"] = s.semiMajorAxisMetres;
    json["inverseFlattening"] = s.inverseFlattening;
    json["middleLongitude"] = s.middleLongitude;
  } else {
    json["linearUnitMetres"] = s.linearUnitMetres;
    if (s.mapScale != std::array<double, 2>{1, 1}) json["mapScale"] = s.mapScale;
  }
  if (!frame.notes.empty()) json["notes"] = frame.notes;
  return json;
}

// The first member that is missing or of another type is reported; the values are checked where the frame is
// made.
Result<GlbFrame> glbFrameFromJson(const nlohmann::json& json) {
  GlbFrame frame;
  LocalFrameSpec& s = frame.local;
  std::string wrong;
  const auto take = [&](const char* key, double& value) {
    const auto found = json.find(key);
    if (found != json.end() && found->is_number())
      value = found->get<double>();
    else if (wrong.empty())
      wrong = key;
  };
  const auto takeText = [&](const char* key, std::string& value) {
    const auto found = json.find(key);
    if (found != json.end() && found->is_string())
      value = found->get<std::string>();
    else if (wrong.empty())
      wrong = key;
  };
  if (!json.is_object()) return failure(ErrorCode::corrupt, "asset.extras.arete is not an object");
  std::string kind;
  takeText("frame", kind);
  s.isGeographic = kind == kGeographic;
  if (kind != kGeographic && kind != kProjected) wrong = "frame";
  takeText("crsWkt", frame.crsWkt);
  takeText("verticalUnit", frame.verticalUnit);
  take("verticalUnitMetres", s.verticalUnitMetres);
  if (s.isGeographic) {
    take("angularUnitRadians", s.angularUnitRadians);
    take("semiMajorAxisMetres", s.semiMajorAxisMetres);
    take("inverseFlattening", s.inverseFlattening);
    take("middleLongitude", s.middleLongitude);
  } else {
    take("linearUnitMetres", s.linearUnitMetres);
    // A scale of 1 is not written, so the member may be missing.
    if (const auto scale = json.find("mapScale"); scale != json.end()) {
      if (scale->is_array() && scale->size() == 2 && (*scale)[0].is_number() && (*scale)[1].is_number())
        s.mapScale = {(*scale)[0].get<double>(), (*scale)[1].get<double>()};
      else if (wrong.empty())
        wrong = "mapScale";
    }
  }
  const auto origin = json.find("origin");
  if (origin != json.end() && origin->is_array() && origin->size() == 3 && (*origin)[0].is_number() &&
      (*origin)[1].is_number() && (*origin)[2].is_number())
    s.origin = {(*origin)[0].get<double>(), (*origin)[1].get<double>(), (*origin)[2].get<double>()};
  else if (wrong.empty())
    wrong = "origin";
  if (!wrong.empty())
    return failure(ErrorCode::corrupt, fmt::format("asset.extras.arete.{} is missing or invalid", wrong));
  return frame;
}

}  // namespace arete
