// SPDX-License-Identifier: GPL-3.0-or-later
//
// The child writes {"value": ...} or {"error": ...} as JSON into a pipe and leaves without running the
// parent's destructors. The parent reads until the pipe closes, then waits.
#include "bench/forked.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>

namespace arete::bench {
namespace {

Json answerOf(const std::function<Result<Json>()>& work) {
  try {
    const Result<Json> result = work();
    if (result) return {{"value", *result}};
    return {{"error", result.error().describe()}, {"code", int(result.error().code)}};
  } catch (const std::exception& error) {
    return {{"error", error.what()}, {"code", int(ErrorCode::unreadable)}};
  }
}

void writeAll(int descriptor, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = write(descriptor, text.data() + at, text.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    at += std::size_t(written);
  }
}

std::string readAll(int descriptor) {
  std::string text;
  char buffer[1 << 14];
  for (;;) {
    const ssize_t count = read(descriptor, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer, std::size_t(count));
  }
}

}  // namespace

Result<Json> runForked(const std::function<Result<Json>()>& work) {
  int ends[2];
  if (pipe(ends) != 0) return failure(ErrorCode::unreadable, std::strerror(errno), "pipe");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) return failure(ErrorCode::unreadable, std::strerror(errno), "fork");
  if (child == 0) {
    close(ends[0]);
    writeAll(ends[1], answerOf(work).dump());
    std::fflush(nullptr);
    _exit(0);
  }
  close(ends[1]);
  const std::string text = readAll(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (WIFSIGNALED(status))
    return failure(
        ErrorCode::unreadable,
        fmt::format("the process was ended by signal {} (9: out of memory, perhaps)", WTERMSIG(status)));
  const Json answer = Json::parse(text, nullptr, false);
  if (answer.is_discarded()) return failure(ErrorCode::unreadable, "the process ended without an answer");
  if (answer.contains("error"))
    return failure(ErrorCode(answer.at("code").get<int>()), answer.at("error").get<std::string>());
  return answer.at("value");
}

double peakBytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * double(usage.ru_maxrss);
}

}  // namespace arete::bench
