// SPDX-License-Identifier: GPL-3.0-or-later
//
// hmm takes heights 0..1 for its grey levels 0..65535, errors on the same scale, and prints what it does:
//   triangulating... 0.98s
//     triangles = 959361
// Its STL goes to /dev/null, so that no disk is timed.
#include "bench/hmm.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "bench/timing.h"

namespace arete::bench {
namespace {

constexpr double kWhite = 65535;

/// The number behind the first `key` of a text; negative where there is none.
double numberBehind(const std::string& text, const std::string& key) {
  const std::size_t at = text.find(key);
  return at == std::string::npos ? -1 : std::strtod(text.c_str() + at + key.size(), nullptr);
}

double secondsOf(const timeval& time) {
  return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
}

struct Ended {
  int status = 0;
  rusage usage = {};
  std::string said;
};

/// Starts a program with its standard output in a pipe and waits for its end.
Result<Ended> runProgram(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe(ends) != 0) return failure(ErrorCode::unreadable, std::strerror(errno), "pipe");
  const pid_t child = fork();
  if (child < 0) return failure(ErrorCode::unreadable, std::strerror(errno), "fork");
  if (child == 0) {
    close(ends[0]);
    if (dup2(ends[1], STDOUT_FILENO) >= 0 && stayOnOneCore()) execv(arguments[0], arguments.data());
    _exit(127);
  }
  close(ends[1]);
  Ended ended;
  char buffer[1 << 12];
  for (;;) {
    const ssize_t count = read(ends[0], buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    ended.said.append(buffer, std::size_t(count));
  }
  close(ends[0]);
  while (wait4(child, &ended.status, 0, &ended.usage) < 0 && errno == EINTR) continue;
  return ended;
}

}  // namespace

Result<HmmInput> writeHmmInput(const RasterHeightfield& field, const std::string& png) {
  const auto [low, high] = std::minmax_element(field.heights.begin(), field.heights.end());
  HmmInput input{png, 1};
  // Whole heights within 65535 units become grey levels without rounding.
  bool isWhole = *high - *low <= kWhite;
  for (const double height : field.heights) {
    if (std::isnan(height))
      return failure(ErrorCode::unsupported, "hmm does not know voids: it would mesh over them",
                     field.source);
    isWhole = isWhole && height - *low == std::floor(height - *low);
  }
  if (!isWhole) input.unit = (*high - *low) / kWhite;
  std::vector<std::uint16_t> levels;
  levels.reserve(field.heights.size());
  for (const double height : field.heights)
    levels.push_back(static_cast<std::uint16_t>(std::lround((height - *low) / input.unit)));

  GDALAllRegister();
  GDALDriver* const memory = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDriver* const writer = GetGDALDriverManager()->GetDriverByName("PNG");
  if (memory == nullptr || writer == nullptr)
    return failure(ErrorCode::unsupported, "this GDAL cannot write PNG", png);
  const int columns = int(field.columns), rows = int(field.rows);
  const auto close = [](GDALDataset* dataset) { GDALClose(dataset); };
  using Dataset = std::unique_ptr<GDALDataset, decltype(close)>;
  // GDAL writes PNG only as a copy of another dataset, so the image is made in memory first.
  const Dataset image(memory->Create("", columns, rows, 1, GDT_UInt16, nullptr), close);
  const bool isFilled =
      image && image->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, columns, rows, levels.data(), columns, rows,
                                                 GDT_UInt16, 0, 0, nullptr) == CE_None;
  const Dataset written(
      isFilled ? writer->CreateCopy(png.c_str(), image.get(), TRUE, nullptr, nullptr, nullptr) : nullptr,
      close);
  if (!written) return failure(ErrorCode::unreadable, "the PNG for hmm cannot be written", png);
  return input;
}

Result<HmmRun> runHmm(const std::string& hmm, const HmmInput& input, double tolerance) {
  if (access(hmm.c_str(), X_OK) != 0)
    return failure(ErrorCode::notFound, "there is no program that can be run", hmm);
  const Stopwatch watch;
  // hmm takes heights and tolerances as parts of the range of its grey levels.
  ARETE_TRY(const Ended ended,
            runProgram({hmm, "-z", fmt::format("{}", kWhite * input.unit), "-e",
                        fmt::format("{}", tolerance / (kWhite * input.unit)), input.png, "/dev/null"}));
  HmmRun run;
  run.seconds = watch.seconds();
  run.processorSeconds = secondsOf(ended.usage.ru_utime) + secondsOf(ended.usage.ru_stime);
  run.triangulateSeconds = numberBehind(ended.said, "triangulating... ");
  run.triangles = numberBehind(ended.said, "  triangles = ");
  run.peakBytes = 1024.0 * double(ended.usage.ru_maxrss);
  if (!WIFEXITED(ended.status) || WEXITSTATUS(ended.status) != 0)
    return failure(ErrorCode::unreadable, "the rival failed on " + input.png, hmm);
  if (run.triangulateSeconds < 0 || run.triangles < 0)
    return failure(ErrorCode::unreadable, "the rival's words cannot be understood: " + ended.said, hmm);
  return run;
}

Status stayOnOneCore() {
  cpu_set_t allowed, one;
  CPU_ZERO(&allowed);
  CPU_ZERO(&one);
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0)
    return failure(ErrorCode::unreadable, std::strerror(errno), "sched_getaffinity");
  // The last: systems serve their interrupts on the first, and people pin what they time there.
  int core = CPU_SETSIZE - 1;
  while (core > 0 && !CPU_ISSET(core, &allowed)) --core;
  CPU_SET(core, &one);
  if (sched_setaffinity(0, sizeof one, &one) != 0)
    return failure(ErrorCode::unreadable, std::strerror(errno), "sched_setaffinity");
  return {};
}

}  // namespace arete::bench
