// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/certificate/report_json.h"

#include <nlohmann/json.hpp>

namespace arete {
namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Vec3& p) {
  return {p.x, p.y, p.z};
}

Json toJson(const MeshSummary& mesh) {
  return {{"triangles", mesh.triangles}, {"degenerateTriangles", mesh.degenerateTriangles},
          {"vertices", mesh.vertices},   {"unusedVertices", mesh.unusedVertices},
          {"area", mesh.area},           {"diagonal", mesh.diagonal}};
}

Json toJson(const DistanceOneWay& way) {
  return {{"maximum", way.maximum},
          {"atMost", way.atMost},
          {"mean", way.mean},
          {"rms", way.rms},
          {"maximumAtVertices", way.maximumAtVertices},
          {"worst", toJson(way.worst)},
          {"nearestToWorst", toJson(way.worstNearest)},
          {"samples", way.samples},
          {"vertices", way.vertices}};
}

}  // namespace

nlohmann::ordered_json toJson(const MeasureReport& report, bool isRaster) {
  Json worst = nullptr;
  if (report.worst) {
    const MeasuredSample& w = *report.worst;
    worst = {{"x", w.x}, {"y", w.y}};
    if (isRaster) {
      worst["column"] = w.column;
      worst["row"] = w.row;
    } else {
      worst["point"] = w.sample;
    }
    worst["demHeight"] = w.demHeight;
    worst["tinHeight"] = w.tinHeight;
    worst["triangle"] = w.triangle;
  }
  Json area = {{"tin", report.tinAreaPixels}};
  if (isRaster) area["domain"] = report.domainAreaPixels;
  return {{"triangles", report.triangles},
          {"vertices", report.vertices},
          {"degenerateTriangles", report.degenerateTriangles},
          {"error",
           {{"maximum", report.maxAbsError},
            {"rms", report.rmsError},
            {"meanAbsolute", report.meanAbsError},
            {"mean", report.meanError},
            {"worst", std::move(worst)}}},
          {"samples",
           {{"all", report.samples},
            {"valid", report.valid},
            {"covered", report.covered},
            {"uncovered", report.uncovered},
            {"isolated", report.isolated},
            {"doublyCovered", report.doublyCovered},
            {"overlapped", report.overlapped},
            {"nodataCovered", report.nodataCovered}}},
          {"areaPixels", std::move(area)}};
}

nlohmann::ordered_json toJson(const MeshDistanceReport& report) {
  const double diagonal = report.second.diagonal;
  return {{"first", toJson(report.first)},
          {"second", toJson(report.second)},
          {"fromFirst", toJson(report.forward)},
          {"fromSecond", toJson(report.backward)},
          {"bothWays",
           {{"maximum", report.hausdorff()},
            {"atMost", report.hausdorffAtMost()},
            {"mean", report.mean()},
            {"rms", report.rms()}}},
          {"ofDiagonal",
           {{"diagonal", diagonal},
            {"maximum", report.hausdorff() / diagonal},
            {"mean", report.mean() / diagonal},
            {"rms", report.rms() / diagonal}}},
          {"seed", report.seed}};
}

}  // namespace arete
