// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace arete::bench {

using Json = nlohmann::ordered_json;

/// Which way a figure is better; `neither` is a fact beside it, such as a count of samples.
enum class Better { lower, higher, neither };

/// One measured number. Dem, stage, variant and name together tell it from all others of a report.
struct Figure {
  std::string dem;      ///< "bigtujunga", "generated-1M"
  std::string stage;    ///< "build"
  std::string variant;  ///< "delaunay, 1 thread"
  std::string name;     ///< "time"
  double value = 0;
  std::string unit;  ///< "s"; may be empty
  Better better = Better::neither;

  bool isSameAs(const Figure& o) const {
    return dem == o.dem && stage == o.stage && variant == o.variant && name == o.name;
  }
};

using Figures = std::vector<Figure>;

/// Figures, and what they were measured on.
struct Report {
  std::string program;    ///< version and build
  std::string processor;  ///< as the processor names itself
  unsigned cores = 0;
  double memoryBytes = 0;
  double loadAtStart = 0;  ///< runnable processes; above zero the times are not to be trusted
  std::string date;        ///< ISO 8601, UTC
  int repeats = 0;
  Figures figures;
};

/// The machine this runs on, and now. Linux: /proc; unknown fields stay empty.
Report emptyReport();

Json toJson(const Figures& figures);
Json toJson(const Report& report);
Figures figuresFromJson(const Json& json);
/// Errors: notFound, corrupt.
Result<Report> readReport(const std::string& path);
Status writeReport(const Report& report, const std::string& path);

/// One table per stage: a row for every DEM and variant, a column for every name.
std::string toMarkdown(const Report& report);

/// What two reports have in common, as head / base, and the geometric mean of every stage and name.
std::string compareReports(const Report& base, const Report& head);

}  // namespace arete::bench
