// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/figure.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include "io/files/file_writer.h"

namespace arete::bench {
namespace {

/// The text behind the colon of the first line of a /proc file that begins with `key`.
std::string procField(const char* path, const std::string& key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(key, 0) != 0) continue;
    const std::size_t colon = line.find(':');
    const std::size_t text = line.find_first_not_of(" \t", colon + 1);
    return colon == std::string::npos || text == std::string::npos ? "" : line.substr(text);
  }
  return {};
}

std::string_view toString(Better better) {
  return better == Better::lower ? "lower" : better == Better::higher ? "higher" : "neither";
}

Better betterOf(const std::string& text) {
  return text == "lower" ? Better::lower : text == "higher" ? Better::higher : Better::neither;
}

}  // namespace

// A report names what its figures depend on: the build, the compiler, the machine and how busy it was. Debug
// builds are marked, since their times mean nothing.
Report emptyReport() {
  Report report;
#ifdef NDEBUG
  const char* build = "release";
#else
  const char* build = "debug";
#endif
  report.program = fmt::format("Arete {}, {}, compiled by {} {}", ARETE_VERSION, build,
#ifdef __clang__
                               "Clang",
#else
                               "GCC",
#endif
                               __VERSION__);
  report.processor = procField("/proc/cpuinfo", "model name");
  report.cores = std::thread::hardware_concurrency();
  report.memoryBytes = 1024 * std::strtod(procField("/proc/meminfo", "MemTotal").c_str(), nullptr);
  double load[1] = {0};
  if (getloadavg(load, 1) == 1) report.loadAtStart = load[0];
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char text[32] = {};
  std::tm utc = {};
  if (gmtime_r(&now, &utc) != nullptr) std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  report.date = text;
  return report;
}

// The names of the fields are the format of reports that are kept, so they stay as they are.
Json toJson(const Figures& figures) {
  Json all = Json::array();
  for (const Figure& f : figures)
    all.push_back({{"dem", f.dem},
                   {"stage", f.stage},
                   {"variant", f.variant},
                   {"name", f.name},
                   {"value", f.value},
                   {"unit", f.unit},
                   {"better", toString(f.better)}});
  return all;
}

Json toJson(const Report& report) {
  return {{"program", report.program},
          {"machine",
           {{"processor", report.processor},
            {"cores", report.cores},
            {"memoryBytes", report.memoryBytes},
            {"loadAtStart", report.loadAtStart}}},
          {"date", report.date},
          {"repeats", report.repeats},
          {"figures", toJson(report.figures)}};
}

/// A report with a missing field throws, and readReport() turns that into an error.
Figures figuresFromJson(const Json& json) {
  Figures figures;
  for (const Json& f : json) {
    Figure figure;
    figure.dem = f.at("dem").get<std::string>();
    figure.stage = f.at("stage").get<std::string>();
    figure.variant = f.at("variant").get<std::string>();
    figure.name = f.at("name").get<std::string>();
    figure.value = f.at("value").get<double>();
    figure.unit = f.at("unit").get<std::string>();
    figure.better = betterOf(f.at("better").get<std::string>());
    figures.push_back(std::move(figure));
  }
  return figures;
}

// A file that is damaged or of another program ends as an error that names the path.
Result<Report> readReport(const std::string& path) {
  std::ifstream file(path);
  if (!file) return failure(ErrorCode::notFound, "the report cannot be opened", path);
  try {
    const Json json = Json::parse(file);
    Report report;
    report.program = json.at("program").get<std::string>();
    report.processor = json.at("machine").at("processor").get<std::string>();
    report.cores = json.at("machine").at("cores").get<unsigned>();
    report.memoryBytes = json.at("machine").at("memoryBytes").get<double>();
    report.loadAtStart = json.at("machine").at("loadAtStart").get<double>();
    report.date = json.at("date").get<std::string>();
    report.repeats = json.at("repeats").get<int>();
    report.figures = figuresFromJson(json.at("figures"));
    return report;
  } catch (const Json::exception& error) {
    return failure(ErrorCode::corrupt, fmt::format("this is no report of arete-bench: {}", error.what()),
                   path);
  }
}

/// The file is written under a temporary name and renamed, as all outputs are.
Status writeReport(const Report& report, const std::string& path) {
  ARETE_TRY(FileWriter writer, FileWriter::create(path));
  writer.write(toJson(report).dump(1));
  writer.write("\n");
  return writer.finish();
}

}  // namespace arete::bench
