// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/attributes/deviation_text.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace arete {
namespace {

nlohmann::ordered_json finiteJson(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

nlohmann::ordered_json placeJson(const Vec3& p) {
  return {p.x, p.y, p.z};
}

}  // namespace

std::string attributeReportText(const AttributeReport& report, const std::string& unitOfLengths) {
  if (report.attributes.empty()) return "  attributes: the second mesh has none\n";
  std::string text = fmt::format(
      "\n  attributes of the second, at the best point of the first within {:.6g}{}\n"
      "  {:<20} {:>12} {:>12} {:>12} {:>16}  {}\n",
      report.within, unitOfLengths.empty() ? "" : " " + unitOfLengths, "", "largest", "mean", "RMS",
      "mean at nearest", "unit");
  for (const AttributeDeviation& a : report.attributes) {
    const NumbersFound& f = a.found;
    if (!a.notComparable.empty()) {
      text += fmt::format("  {:<20} {}\n", a.name, a.notComparable);
      continue;
    }
    if (f.points == 0) {
      text += fmt::format("  {:<20} not compared\n", a.name);
      continue;
    }
    if (a.isEquality) {
      text += f.unequal == 0
                  ? fmt::format("  {:<20} equal at {} points\n", a.name, f.points)
                  : fmt::format("  {:<20} differs at {} of {} points, first at {:.10g} {:.10g} {:.10g}\n",
                                a.name, f.unequal, f.points, f.worst.x, f.worst.y, f.worst.z);
      continue;
    }
    text += fmt::format("  {:<20} {:>12.6g} {:>12.6g} {:>12.6g} {:>16.6g}  {}\n", a.name, f.largest, f.mean,
                        f.rms, f.meanAtNearest, a.unit);
    if (f.beyond > 0)
      text +=
          fmt::format("    {} of {} points have their own chart or part farther away\n", f.beyond, f.points);
    if (f.largest > 0)
      text += fmt::format(
          "    {:<18} {:.10g} {:.10g} {:.10g}{}\n", "largest at", f.worst.x, f.worst.y, f.worst.z,
          f.unequal > 0
              ? fmt::format(" (without a like value within at {} of {} points)", f.unequal, f.points)
              : "");
  }
  if (report.charts > 1)
    text += fmt::format("  {:<20} {} of {} told from their neighbours\n", "charts", report.chartsApart,
                        report.charts);
  return text;
}

nlohmann::ordered_json toJson(const AttributeReport& report) {
  nlohmann::ordered_json json = {{"within", finiteJson(report.within)},
                                 {"charts", report.charts},
                                 {"chartsApart", report.chartsApart},
                                 {"attributes", nlohmann::ordered_json::object()}};
  for (const AttributeDeviation& a : report.attributes) {
    nlohmann::ordered_json one;
    if (!a.notComparable.empty()) {
      one["notComparable"] = a.notComparable;
    } else {
      const NumbersFound& f = a.found;
      one = {{"points", f.points},
             {"unequal", f.unequal},
             {"beyond", f.beyond},
             {"largest", finiteJson(f.largest)}};
      if (!a.isEquality) {
        one["mean"] = f.mean;
        one["rms"] = f.rms;
        one["meanAtNearest"] = f.meanAtNearest;
        one["rmsAtNearest"] = f.rmsAtNearest;
        one["unit"] = a.unit;
      }
      one["at"] = placeJson(f.worst);
      one["nearest"] = f.worstNear ? placeJson(*f.worstNear) : nlohmann::ordered_json();
    }
    if (a.expected) {
      one["expect"] = *a.expected;
      one["kept"] = a.isKept;
    }
    // A mesh may have one name for corners and for vertices.
    std::string key = a.name;
    for (int n = 2; json["attributes"].contains(key); ++n) key = fmt::format("{} ({})", a.name, n);
    json["attributes"][key] = std::move(one);
  }
  return json;
}

}  // namespace arete
