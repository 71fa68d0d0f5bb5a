// SPDX-License-Identifier: GPL-3.0-or-later
// arete-bench: how fast, how large, how many triangles. Figures as JSON, as tables for bench/figures.md,
// and two reports against each other. The parent process starts no thread: every stage runs in a child of its
// own.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/figure.h"
#include "bench/sources.h"
#include "bench/stages/stages.h"

namespace arete::bench {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::vector<std::string> only, dems;
  std::vector<double> sizes = {1, 4, 16};
  std::string json, data, scratch, baselines, hmm;
  int repeats = 3;
  bool markdown = false, quiet = false;
};

int fail(const Error& error) {
  fmt::print(stderr, "arete-bench: {}\n", error.describe());
  return error.code == ErrorCode::usage ? 2 : 1;
}

/// A DEM is named, or no DEM is and it is one of all.
bool isWanted(const std::string& name, const std::vector<std::string>& wanted) {
  return wanted.empty() || std::any_of(wanted.begin(), wanted.end(), [&](const std::string& part) {
           return name.find(part) != std::string::npos;
         });
}

/// Every wanted stage on every wanted DEM, into the report. Returns the exit code.
int measureDems(const Arguments& arguments, const Plan& plan, Report& report) {
  std::vector<DemSource> sources = realDems(arguments.data);
  if (sources.empty())
    fmt::print(stderr, "arete-bench: no real DEMs here (ARETE_DATA or --data names their folder)\n");
  for (const double millions : arguments.sizes) {
    sources.push_back(generatedDem(millions, plan.scratch));
    if (sources.back().side <= kLargestInFull) sources.push_back(scattered(sources.back()));
  }
  std::erase_if(sources, [&](const DemSource& s) { return !isWanted(s.name, arguments.dems); });
  if (sources.empty()) return fail({ErrorCode::usage, "no DEM has that name", "--dem"});

  int exitCode = 0;
  for (const DemSource& source : sources) {
    if (!arguments.quiet) fmt::print(stderr, "arete-bench: {} ...\n", source.name);
    Result<Figures> figures = measureDem(source, plan);
    if (!figures) {
      exitCode = fail(figures.error());
      continue;
    }
    report.figures.insert(report.figures.end(), figures->begin(), figures->end());
  }
  return exitCode;
}

/// Stage "surface" on every wanted mesh, into the report. Returns the exit code.
int measureMeshes(const Arguments& arguments, const Plan& plan, Report& report) {
  int exitCode = 0;
  const auto take = [&](const Result<Figures>& figures) {
    if (figures)
      report.figures.insert(report.figures.end(), figures->begin(), figures->end());
    else
      exitCode = fail(figures.error());
  };
  for (const MeshSource& source : realMeshes(arguments.data)) {
    if (!isWanted(source.name, arguments.dems)) continue;
    if (!arguments.quiet) fmt::print(stderr, "arete-bench: {} ...\n", source.name);
    take(measureMesh(source, plan));
  }
  if (isWanted("generated rock", arguments.dems)) take(measureSurfaceMemory(plan));
  return exitCode;
}

/// The stage "rival" needs a program that is not ours: without it the stage is an error where it is named,
/// and is passed over where all stages are wanted.
int measureAll(const Arguments& arguments) {
  Plan plan;
  plan.only = arguments.only;
  plan.scratch = arguments.scratch;
  plan.baselines = arguments.baselines;
  plan.hmm = arguments.hmm;
  if (plan.hmm.empty() && !plan.only.empty() && plan.wants("rival"))
    return fail({ErrorCode::usage, "the stage \"rival\" needs the rival's program", "--hmm"});
  plan.repetition.most = arguments.repeats;
  std::error_code error;
  fs::create_directories(plan.scratch, error);
  if (error)
    return fail({ErrorCode::unreadable, "the folder cannot be made: " + error.message(), plan.scratch});

  // A stage that fails does not end the run: the figures of the others are reported, and the exit code tells
  // of the failure.
  Report report = emptyReport();
  report.repeats = arguments.repeats;
  int exitCode = 0;
  if (plan.wants("machine")) {
    if (!arguments.quiet) fmt::print(stderr, "arete-bench: this machine ...\n");
    const Result<Figures> figures = measureMachine(plan);
    if (figures)
      report.figures = *figures;
    else
      exitCode = fail(figures.error());
  }
  if (plan.wants("surface"))
    if (const int failed = measureMeshes(arguments, plan, report); failed != 0) exitCode = failed;
  const bool wantsDems = plan.only.empty() || std::ranges::any_of(plan.only, [](const std::string& stage) {
                           return stage != "machine" && stage != "surface";
                         });
  if (wantsDems)
    if (const int failed = measureDems(arguments, plan, report); failed != 0) exitCode = failed;
  const Figures means = geometricMeans(report.figures);
  report.figures.insert(report.figures.end(), means.begin(), means.end());

  if (!arguments.json.empty())
    if (const Status written = writeReport(report, arguments.json); !written) return fail(written.error());
  if (arguments.markdown || arguments.json.empty()) fmt::print("{}", toMarkdown(report));
  return exitCode;
}

// Both reports are read before anything is printed, so that a missing file leaves no half table.
int compare(const std::string& basePath, const std::string& headPath) {
  const Result<Report> base = readReport(basePath);
  if (!base) return fail(base.error());
  const Result<Report> head = readReport(headPath);
  if (!head) return fail(head.error());
  fmt::print("{}", compareReports(*base, *head));
  return 0;
}

int print(const std::string& path) {
  const Result<Report> report = readReport(path);
  if (!report) return fail(report.error());
  fmt::print("{}", toMarkdown(*report));
  return 0;
}

// The defaults of the folders come first, since the help and the parser take them from these variables.
int run(int argc, char** argv) {
  Arguments arguments;
  arguments.data = dataFolder();
  arguments.scratch = (fs::temp_directory_path() / "arete-bench").string();
  arguments.baselines = (fs::path(ARETE_SOURCE_FOLDER) / "bench" / "baselines.json").string();

  CLI::App app{"Measures Arete: time, memory, bytes and triangles, on real and on generated DEMs."};
  app.name("arete-bench");
  app.footer(
      "Exit codes: 0 done, 1 failed, 2 the command line makes no sense.\n"
      "Examples:\n"
      "  arete-bench --json head.json --markdown\n"
      "  arete-bench --only build,cut --sizes 1 --dem generated\n"
      "  arete-bench --only rival --hmm ~/hmm/hmm --dem bigtujunga,aconcagua,generated\n"
      "  arete-bench compare base.json head.json\n"
      "  arete-bench tables head.json");
  app.add_option("--only", arguments.only,
                 "Stages, with commas between: " + fmt::format("{}", fmt::join(stageNames(), ", ")))
      ->delimiter(',')
      ->check(CLI::IsMember(stageNames()));
  app.add_option("--dem", arguments.dems, "DEMs and meshes whose name contains one of these")->delimiter(',');
  app.add_option("--sizes", arguments.sizes, "Generated DEMs, millions of samples (default 1,4,16)")
      ->delimiter(',')
      ->check(CLI::Range(0.001, 256.0));
  app.add_option("--repeats", arguments.repeats, "Runs to take the median of (default 3)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--json", arguments.json, "File for the figures");
  app.add_flag("--markdown", arguments.markdown, "Print tables (done anyhow without --json)");
  app.add_flag("-q,--quiet", arguments.quiet, "Do not say which DEM is being measured");
  app.add_option("--data", arguments.data, "Folder of the real DEMs (default: $ARETE_DATA)");
  app.add_option("--scratch", arguments.scratch, "Folder for generated DEMs, which are kept, and models");
  app.add_option("--hmm", arguments.hmm,
                 "The program hmm (github.com/fogleman/hmm), to build beside: stage \"rival\"")
      ->check(CLI::ExistingFile);
  app.add_option("--baselines", arguments.baselines, "Counts to compare triangles with");

  std::string base, head;
  CLI::App* compareCommand = app.add_subcommand("compare", "Ratios of two reports");
  compareCommand->add_option("BASE", base, "Report (JSON)")->required();
  compareCommand->add_option("HEAD", head, "Report (JSON)")->required();
  CLI::App* tablesCommand = app.add_subcommand("tables", "The tables of a report");
  tablesCommand->add_option("REPORT", head, "Report (JSON)")->required();
  app.require_subcommand(0, 1);

  // Without a subcommand everything is measured; "compare" and "tables" read reports only.
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (compareCommand->parsed()) return compare(base, head);
  if (tablesCommand->parsed()) return print(head);
  return measureAll(arguments);
}

}  // namespace
}  // namespace arete::bench

int main(int argc, char** argv) {
  return arete::bench::run(argc, argv);
}
