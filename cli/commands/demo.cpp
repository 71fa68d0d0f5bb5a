// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs the demo of viewer/headless and reports its results as text and JSON.
#include "cli/commands/demo.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/arguments/arguments.h"
#include "io/files/text/stated_size.h"
#include "viewer/headless/demo.h"

namespace arete {
namespace {

/// The arguments outlive the parser, since the command runs after everything is parsed.
struct DemoArguments {
  DemArguments dem;
  DemoOptions options;
  std::string maxErrors;
  bool isPlain = false;
};

// The JSON has the numbers of the table and of the curve, so that both can be drawn again.
Json answerOf(const DemoReport& report) {
  Json results = Json::array(), curve = Json::array();
  for (const DemoResult& r : report.results)
    results.push_back({{"maxError", r.maxError},
                       {"maxErrorPercent", r.percentOfRelief},
                       {"triangles", r.triangles},
                       {"percentOfFinest", r.percentOfFinest},
                       {"measuredMax", r.measuredMax},
                       {"measuredRms", r.measuredRms},
                       {"measuredMean", r.measuredMean},
                       {"uncovered", r.uncovered},
                       {"cutSeconds", r.cutSeconds},
                       {"kept", r.isKept}});
  for (const CurvePoint& p : report.curve)
    curve.push_back({{"maxError", p.maxError},
                     {"minimalTriangles", p.minimalTriangles},
                     {"saturatedTriangles", p.saturatedTriangles}});
  return {{"dem", report.dem},
          {"columns", report.columns},
          {"rows", report.rows},
          {"unit", report.unit},
          {"relief", report.relief},
          {"finestTriangles", report.finestTriangles},
          {"isolated", report.isolated},
          {"buildSeconds", report.buildSeconds},
          {"totalSeconds", report.totalSeconds},
          {"results", results},
          {"curve", curve},
          {"files", report.files}};
}

std::string textOf(const DemoReport& report) {
  std::string text =
      fmt::format("{}: {} x {} samples, {} at full resolution, built in {:.1f} s\n\n{}\n", report.dem,
                  report.columns, report.rows, grouped(report.finestTriangles, "triangle", "triangles"),
                  report.buildSeconds, demoTable(report));
  if (report.isolated > 0)
    text += grouped(report.isolated, "isolated sample is", "isolated samples are") +
            " in no triangle and in no column.\n";
  text += fmt::format("Written in {:.1f} s:\n", report.totalSeconds);
  for (const std::string& file : report.files) text += "  " + file + "\n";
  return text;
}

// A share of the relief and an error in the unit of heights may be mixed in one list; the demo resolves
// shares when it knows the relief.
Status demonstrate(DemoArguments& arguments, Session& session) {
  arguments.options.reading = arguments.dem.reading;
  arguments.options.isDecorated = !arguments.isPlain;
  if (!arguments.maxErrors.empty()) {
    ARETE_TRY(const auto errors, parseStatedSizes(arguments.maxErrors, "--max-error"));
    for (const StatedSize& stated : errors)
      (stated.isShare ? arguments.options.reliefShares : arguments.options.maxErrors)
          .push_back(stated.number);
  }
  ARETE_TRY(const DemoReport report, runDemo(arguments.dem.path, arguments.options, session.context()));
  session.warn(report.warnings, arguments.dem.path);
  session.say(textOf(report));
  session.answer(answerOf(report));
  return {};
}

}  // namespace

void addDemoCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<DemoArguments>();
  CLI::App* command =
      session.addCommand(app, "demo", "Build, extract, measure and draw one DEM, to see the results",
                         "  arete demo dem.tif -o demo\n"
                         "  arete demo dem.tif -o demo --max-error 2,10,50 --shape fidelity",
                         [arguments](Session& s) { return demonstrate(*arguments, s); });
  command->add_option("DEM", arguments->dem.path, "Any raster that GDAL reads")->required();
  command->add_option("-o,--output", arguments->options.folder, "Folder for the files; created if missing")
      ->required();
  command
      ->add_option("--max-error", arguments->maxErrors,
                   "Tolerances, in the DEM's unit of height or as E% of its relief, with commas between\n"
                   "(default: chosen from the data)")
      ->check(tolerances())
      ->type_name("E[,E...]");
  command
      ->add_option(
          "--shape", arguments->options.build.shape,
          "delaunay: well-shaped triangles (default); fidelity: far fewer triangles at the same error")
      ->transform(
          oneOf<HoleShape>({{"delaunay", HoleShape::delaunay}, {"fidelity", HoleShape::dataDependent}}))
      ->type_name("NAME");
  command->add_flag("--no-decorations", arguments->isPlain,
                    "Draw no legend, scale bar, north arrow and graticule on the maps");
  arguments->dem.addTo(*command);
}

}  // namespace arete
