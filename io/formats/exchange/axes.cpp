// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/exchange/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/base/vec.h"
#include "io/geo/crs/names.h"
#include "surface/edit/place.h"

namespace arete {
namespace {

// A foot is 0.3048 m, a US survey foot 1200/3937 m.
constexpr std::array kUnits = {MeshUnit{"mm", 1, 1000},       MeshUnit{"cm", 1, 100},
                               MeshUnit{"m", 1, 1},           MeshUnit{"km", 1000, 1},
                               MeshUnit{"in", 127, 5000},     MeshUnit{"ft", 381, 1250},
                               MeshUnit{"us-ft", 1200, 3937}, MeshUnit{"yd", 1143, 1250}};

/// y up becomes z up: the axis that came towards the viewer then goes away from it.
Vec3 toZUp(const Vec3& p) {
  return {p.x, 0 - p.z, p.y};
}

Vec3 toYUp(const Vec3& p) {
  return {p.x, p.z, 0 - p.y};
}

Vec3 magnitudes(const Vec3& p) {
  return {std::abs(p.x), std::abs(p.y), std::abs(p.z)};
}

template <class Turn>
void turnMesh(MeshFile& mesh, const Turn& turn) {
  for (Vec3& p : mesh.mesh.positions) p = turn(p);
  turnDirections(mesh.mesh, turn);
  if (mesh.frame.origin) *mesh.frame.origin = turn(*mesh.frame.origin);
  mesh.frame.rounding = magnitudes(turn(mesh.frame.rounding));
}

/// The least float that is not below a number.
float roundedUp(double x) {
  const auto rounded = static_cast<float>(x);
  return double(rounded) < x ? std::nextafter(rounded, INFINITY) : rounded;
}

/// Bounds stay bounds. Where one is beyond all numbers, none is stated.
template <class Scale>
void scaleErrors(std::vector<float>& errors, const Scale& scaled) {
  for (float& error : errors) error = roundedUp(scaled(error));
  if (std::ranges::any_of(errors, [](float e) { return !std::isfinite(e); })) errors.clear();
}

Status scaleMesh(MeshFile& mesh, const MeshUnit& unit) {
  const auto scaled = [&](double x) { return x * unit.numerator / unit.denominator; };
  const auto scaledPoint = [&](const Vec3& p) { return Vec3{scaled(p.x), scaled(p.y), scaled(p.z)}; };
  for (Vec3& p : mesh.mesh.positions) {
    p = scaledPoint(p);
    if (!isFinite(p))
      return failure(ErrorCode::invalidData, "a coordinate in metres is too large for a number",
                     fmt::format("unit {}", unit.name));
  }
  scaleErrors(mesh.triangleErrors, scaled);
  if (mesh.frame.origin) *mesh.frame.origin = scaledPoint(*mesh.frame.origin);
  mesh.frame.rounding = scaledPoint(mesh.frame.rounding);
  return {};
}

/// What the file says of its axes and units, if it says anything.
std::string knownFrame(const MeshFile& mesh) {
  if (!mesh.crsWkt.empty()) return fmt::format("its CRS is {}", crsName(mesh.crsWkt));
  return mesh.up == MeshUp::z ? "the file says that its z is the height" : "";
}

}  // namespace

std::vector<std::string> meshUnitNames() {
  std::vector<std::string> names;
  for (const MeshUnit& unit : kUnits) names.emplace_back(unit.name);
  return names;
}

Status placeMesh(MeshFile& mesh, const Similarity& placing) {
  ARETE_CHECK(place(mesh.mesh, placing));
  scaleErrors(mesh.triangleErrors, [&](double error) { return error * placing.scale(); });
  // An origin that the new place leaves no number for is one that the writer chooses anew.
  if (mesh.frame.origin) mesh.frame.origin = placing(*mesh.frame.origin);
  if (mesh.frame.origin && !isFinite(*mesh.frame.origin)) mesh.frame.origin.reset();
  const auto [x, y, z] = placing.axes();
  const Vec3& r = mesh.frame.rounding;
  mesh.frame.rounding = (magnitudes(x) * r.x + magnitudes(y) * r.y + magnitudes(z) * r.z) * placing.scale();
  return {};
}

Status placeMesh(MeshFile& mesh, const MeshPlacing& placing, MeshUp wanted) {
  const std::string known = knownFrame(mesh);
  if (!placing.unit.empty()) {
    const std::string culprit = fmt::format("unit {}", placing.unit);
    const auto* const unit = std::ranges::find(kUnits, std::string_view(placing.unit), &MeshUnit::name);
    if (unit == kUnits.end())
      return failure(ErrorCode::usage, fmt::format("must be one of {}", fmt::join(meshUnitNames(), ", ")),
                     culprit);
    if (!known.empty()) return failure(ErrorCode::usage, known + ", which states the unit", culprit);
    if (!mesh.verticalUnit.empty())
      return failure(ErrorCode::usage,
                     fmt::format("the file states the unit of its heights: {}", mesh.verticalUnit), culprit);
    ARETE_CHECK(scaleMesh(mesh, *unit));
  }
  if (placing.up == MeshUp::unknown) return {};
  if (!known.empty()) {
    if (placing.up == MeshUp::z) return {};
    return failure(ErrorCode::usage, known + ": z is up", "up y");
  }
  if (placing.up == MeshUp::y && wanted == MeshUp::z) turnMesh(mesh, toZUp);
  if (placing.up == MeshUp::z && wanted == MeshUp::y) turnMesh(mesh, toYUp);
  // Not z: a writer of glTF turns a mesh of its own frame.
  mesh.up = wanted == MeshUp::y ? MeshUp::y : MeshUp::unknown;
  return {};
}

}  // namespace arete
