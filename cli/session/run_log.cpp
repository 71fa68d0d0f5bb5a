// SPDX-License-Identifier: GPL-3.0-or-later
//
// A line is one write() to a file opened with O_APPEND: the system puts it behind what other processes have
// written, as a whole. A run that the power or a full disk has cut within a line is closed with an end of
// line before the next one begins.
#include "cli/session/run_log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <system_error>
#include <utility>

#include "cli/session/sha256_of_file.h"
#include "engine/base/caught_failure.h"
#include "engine/parallel/thread_limit.h"
#include "io/files/text/address_text.h"
#include "io/files/written_files.h"

namespace arete {
namespace {

/// For the handler of a fault: the log that is open, and the name of its run.
std::atomic<int> gLogDescriptor = -1, gLogProcess = 0;
std::array<char, 64> gLogRun = {};

std::timespec timeNow() {
  std::timespec now{};
  std::timespec_get(&now, TIME_UTC);
  return now;
}

double secondsOf(const timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
}

struct Usage {
  double cpuSeconds = 0;
  std::uint64_t peakBytes = 0;
};

/// Not what getrusage() says, which includes what a shell or a Python that started the program had taken.
std::uint64_t peakMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    constexpr std::string_view kPeak = "VmHWM:";
    if (line.starts_with(kPeak)) return std::strtoull(line.c_str() + kPeak.size(), nullptr, 10) * 1024;
  }
  return 0;
}

Usage usageSoFar() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return {secondsOf(used.ru_utime) + secondsOf(used.ru_stime), peakMemory()};
}

double rounded(double seconds) {
  return std::round(seconds * 1e4) / 1e4;
}

bool writeWhole(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// What a file that exists has to be for a log to be appended to it: empty, or lines of a log.
Status checkLogContent(int descriptor, const std::string& path, bool& endsInALine) {
  endsInALine = true;
  struct ::stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode) || status.st_size == 0) return {};
  constexpr std::string_view kBegin = R"({"event":")";
  std::array<char, kBegin.size()> begin = {};
  const ssize_t read = ::pread(descriptor, begin.data(), begin.size(), 0);
  if (read != static_cast<ssize_t>(begin.size()) || std::string_view(begin.data(), begin.size()) != kBegin)
    return failure(ErrorCode::usage, "exists and holds something other than a log", path);
  char last = '\n';
  if (::pread(descriptor, &last, 1, status.st_size - 1) == 1) endsInALine = last == '\n';
  return {};
}

/// Texts of a log name no secret of an address.
Json withoutSecrets(Json value) {
  if (value.is_string()) return withoutQueries(value.get_ref<const std::string&>());
  if (value.is_structured())
    for (Json& part : value) part = withoutSecrets(std::move(part));
  return value;
}

}  // namespace

std::string isoTime(const std::timespec& moment) {
  std::tm parts{};
  ::gmtime_r(&moment.tv_sec, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                     parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec, moment.tv_nsec / 1'000'000);
}

Json machineFacts() {
  const double bytes =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  return {{"processors", hardwareThreads()},
          {"memoryBytes", static_cast<std::uint64_t>(std::max(0.0, bytes))}};
}

Json fileFacts(const std::string& path) {
  Json facts = {{"path", path}};
  struct ::stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return facts;
  facts["bytes"] = static_cast<std::uint64_t>(status.st_size);
  facts["modified"] = isoTime(status.st_mtim);
  return facts;
}

Result<std::unique_ptr<RunLog>> RunLog::open(const std::string& path) try {
  if (path.empty() || path == "-")
    return failure(ErrorCode::usage, "a log needs the name of a file; /dev/stderr is one", path);
  // O_NONBLOCK: a pipe that no program reads is an error and no wait.
  const int descriptor =
      ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666);
  if (descriptor < 0)
    return failure(errno == ENOENT ? ErrorCode::notFound : ErrorCode::unreadable,
                   fmt::format("cannot be written: {}", std::generic_category().message(errno)), path);
  ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
  bool endsInALine = true;
  if (Status content = checkLogContent(descriptor, path, endsInALine); !content) {
    ::close(descriptor);
    return tl::unexpected(content.error());
  }
  if (!endsInALine) writeWhole(descriptor, "\n");
  return std::unique_ptr<RunLog>(new RunLog(path, descriptor));
} catch (...) {
  return caughtFailure(path);
}

RunLog::RunLog(std::string path, int descriptor)
    : path_(std::move(path)),
      run_(fmt::format("{}-{}", isoTime(timeNow()), ::getpid())),
      descriptor_(descriptor) {
  run_.copy(gLogRun.data(), gLogRun.size() - 1);
  gLogProcess = ::getpid();
  gLogDescriptor = descriptor_;
}

RunLog::~RunLog() {
  stops_ = true;
  if (digests_.joinable()) digests_.join();
  if (!hasEnded_) try {
      line("end", {{"exitCode", 1}, {"error", {{"code", "internal"}, {"message", "an unexpected failure"}}}});
    } catch (...) {
    }
  gLogDescriptor = -1;
  ::close(descriptor_);
}

double RunLog::secondsSoFar() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void RunLog::write(std::string_view event, const Json& fields) {
  Json line = {
      {"event", event}, {"run", run_}, {"time", isoTime(timeNow())}, {"seconds", rounded(secondsSoFar())}};
  for (const auto& [key, value] : fields.items()) line[key] = value;
  // A path may not be UTF-8: invalid bytes are replaced. An end of line within a text is written as \n.
  const std::string text =
      withoutSecrets(std::move(line)).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  if (!writeWhole(descriptor_, text)) isWhole_ = false;
}

void RunLog::line(std::string_view event, Json fields) {
  const std::lock_guard lock(mutex_);
  if (!hasEnded_) write(event, fields);
}

void RunLog::endStage() {
  if (stage_.name.empty()) return;
  const Usage now = usageSoFar();
  write("stage ends", {{"stage", stage_.name},
                       {"fraction", stage_.fraction},
                       {"stageSeconds", rounded(secondsSoFar() - stage_.seconds)},
                       {"stageCpuSeconds", rounded(now.cpuSeconds - stage_.cpuSeconds)},
                       {"peakMemoryBytes", now.peakBytes}});
  stage_.name.clear();
}

void RunLog::report(std::string_view stage, double fraction) {
  const std::lock_guard lock(mutex_);
  if (hasEnded_) return;
  const bool isSame = stage == stage_.name;
  // A stage that has ended does not begin anew by a second report of its end.
  if (!isSame && fraction >= 1) return;
  if (!isSame || fraction < stage_.fraction) {
    endStage();
    stage_ = {std::string(stage), 0, secondsSoFar(), usageSoFar().cpuSeconds};
    write("stage begins", {{"stage", stage_.name}});
  }
  stage_.fraction = std::clamp(fraction, 0.0, 1.0);
  if (fraction >= 1) endStage();
}

void RunLog::digestInputs(std::vector<std::string> files) {
  std::erase_if(files, [](const std::string& file) { return file.find("://") != file.npos; });
  if (files.empty()) return;
  digests_ = std::thread([this, files = std::move(files)] {
    try {
      for (const std::string& file : files) {
        const auto begin = std::chrono::steady_clock::now();
        const Result<FileDigest> digest = sha256OfFile(file, &stops_);
        if (!digest && digest.error().code == ErrorCode::interrupted) break;
        Json fields = fileFacts(file);
        if (digest) {
          fields["sha256"] = digest->sha256;
          if (!digest->isStable) fields["changedMeanwhile"] = true;
          fields["digestSeconds"] =
              rounded(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        } else {
          fields["error"] = digest.error().message;
        }
        line("input", fields);
      }
    } catch (...) {
      // Without memory for a line it is left out.
    }
    digestsAreDone_ = true;
  });
}

void RunLog::waitForDigests(bool hasFailed, const std::atomic<bool>& interrupted) {
  constexpr auto kPause = std::chrono::milliseconds(1),
                 kLongestAfterAFailure = std::chrono::milliseconds(1000);
  const auto begin = std::chrono::steady_clock::now();
  while (digests_.joinable() && !digestsAreDone_ && !interrupted &&
         !(hasFailed && std::chrono::steady_clock::now() - begin > kLongestAfterAFailure))
    std::this_thread::sleep_for(kPause);
  stops_ = true;
  if (digests_.joinable()) digests_.join();
}

void RunLog::writeOutputs(const std::atomic<bool>& interrupted) {
  for (const WrittenFile& file : writtenFiles()) {
    Json fields = fileFacts(file.path);
    const Result<FileDigest> digest = sha256OfFile(file.path, &interrupted);
    // A group of files that could not be renamed as a whole has been undone.
    if (!digest && digest.error().code == ErrorCode::notFound) continue;
    if (digest) fields["sha256"] = digest->sha256;
    line("output", fields);
  }
}

Status RunLog::end(int exitCode, const Json& error, const std::atomic<bool>& interrupted) {
  {
    const std::lock_guard lock(mutex_);
    endStage();
  }
  waitForDigests(exitCode != 0, interrupted);
  writeOutputs(interrupted);
  const Usage all = usageSoFar();
  Json fields = {
      {"exitCode", exitCode}, {"cpuSeconds", rounded(all.cpuSeconds)}, {"peakMemoryBytes", all.peakBytes}};
  if (!error.is_null()) fields["error"] = error;
  line("end", fields);
  hasEnded_ = true;
  struct ::stat own {
  }, named{};
  const bool isThere = ::fstat(descriptor_, &own) == 0 &&
                       (!S_ISREG(own.st_mode) || own.st_nlink > 0 || ::stat(path_.c_str(), &named) != 0);
  if (!isWhole_) return failure(ErrorCode::unreadable, "the log cannot be written: it lacks lines", path_);
  if (!isThere) return failure(ErrorCode::unreadable, "the log was replaced by another file", path_);
  return {};
}

void endLogInHandler(int exitCode, const char* sentence) noexcept {
  // A child that reads hostile bytes may crash, and does not end the run.
  const int descriptor = gLogDescriptor.exchange(-1);
  if (descriptor < 0 || gLogProcess != ::getpid()) return;
  std::array<char, 400> text = {};
  std::size_t size = 0;
  const auto add = [&](const char* part) {
    for (; *part != 0 && size < text.size(); ++part) text[size++] = *part;
  };
  const char digits[] = {static_cast<char>('0' + exitCode / 100 % 10),
                         static_cast<char>('0' + exitCode / 10 % 10), static_cast<char>('0' + exitCode % 10),
                         0};
  add(R"({"event":"end","run":")");
  add(gLogRun.data());
  add(R"(","exitCode":)");
  add(exitCode >= 100 ? digits : exitCode >= 10 ? digits + 1 : digits + 2);
  add(R"(,"error":{"message":")");
  add(sentence);
  add("\"}}\n");
  [[maybe_unused]] const ssize_t ignored = ::write(descriptor, text.data(), size);
}

}  // namespace arete
