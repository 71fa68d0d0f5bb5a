// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/report_json.h"

#include <nlohmann/json.hpp>

namespace arete {

nlohmann::ordered_json toJson(const MeasureReport& report, bool isRaster) {
  using Json = nlohmann::ordered_json;
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

}  // namespace arete
