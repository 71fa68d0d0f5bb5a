// SPDX-License-Identifier: GPL-3.0-or-later
//
// The child answers over a pipe: a byte for the kind, a length, the bytes. With the length the parent knows
// the end of an answer even if another child, forked by another thread, still holds the pipe open. The limit
// of address space is relative to what the process has, because a sanitizer reserves terabytes.
#include "io/files/isolated.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "engine/base/caught_failure.h"

namespace arete {
namespace {

constexpr std::size_t kHeadBytes = 1 + sizeof(std::uint64_t);
constexpr char kValue = 'v', kFailure = 'f';
constexpr int kMillisecondsBetweenChecks = 50;
constexpr std::size_t kLongestMessage = 4096;

void limit(decltype(RLIMIT_AS) what, std::uint64_t most) {
  rlimit now{};
  if (getrlimit(what, &now) != 0) return;
  const rlim_t value = std::min<std::uint64_t>(most, now.rlim_max);
  const rlimit then{value, value};
  setrlimit(what, &then);
}

/// The address space of this process; 0 if it is unknown.
std::uint64_t addressSpace() {
  unsigned long long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "re")) {
    if (std::fscanf(file, "%llu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

bool writeAll(int descriptor, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t done = ::write(descriptor, bytes, count);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes += done;
    count -= static_cast<std::size_t>(done);
  }
  return true;
}

[[noreturn]] void runChild(const std::function<Result<std::string>()>& work, const IsolationLimits& limits,
                           int pipe) {
  // Handlers of this program, of a sanitizer or of a fuzzer would report a crash, which is expected here.
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGTRAP, SIGINT, SIGTERM, SIGHUP,
                           SIGPIPE, SIGALRM, SIGXCPU, SIGXFSZ, SIGUSR1, SIGUSR2})
    std::signal(signal, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC); nowhere >= 0) {
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
  }
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.seconds);
  if (const std::uint64_t space = addressSpace(); space > 0) limit(RLIMIT_AS, space + limits.memoryBytes);
  Result<std::string> answer = [&]() -> Result<std::string> {
    try {
      return work();
    } catch (...) {
      return caughtFailure();
    }
  }();
  std::array<char, kHeadBytes> head{};
  std::string& bytes = answer ? *answer : answer.error().message;
  if (!answer) bytes.insert(bytes.begin(), static_cast<char>(answer.error().code));
  head[0] = answer ? kValue : kFailure;
  const std::uint64_t size = bytes.size();
  std::memcpy(head.data() + 1, &size, sizeof size);
  const bool isWritten =
      writeAll(pipe, head.data(), head.size()) && writeAll(pipe, bytes.data(), bytes.size());
  _exit(isWritten ? 0 : 1);
}

/// The running child; killed if it still runs at the end.
class Child {
 public:
  Child(pid_t id, int pipe) : id_(id), pipe_(pipe) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    ::close(pipe_);
    kill(id_, SIGKILL);
    while (waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }

  /// Reads `count` bytes. Errors: interrupted; corrupt: the child ended before.
  Status read(char* to, std::size_t count, const RunContext& context) const {
    while (count > 0) {
      if (context.cancelled()) return failure(ErrorCode::interrupted, "reading was interrupted");
      pollfd waits{.fd = pipe_, .events = POLLIN, .revents = 0};
      const int ready = poll(&waits, 1, kMillisecondsBetweenChecks);
      if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
      const ssize_t done = ::read(pipe_, to, count);
      if (done < 0 && errno == EINTR) continue;
      if (done <= 0)
        return failure(ErrorCode::corrupt, "its decoder crashed or took too much memory or time");
      to += done;
      count -= static_cast<std::size_t>(done);
    }
    return {};
  }

 private:
  pid_t id_;
  int pipe_;
};

}  // namespace

Result<std::string> runIsolated(const std::function<Result<std::string>()>& work,
                                const IsolationLimits& limits, const RunContext& context) try {
  std::array<int, 2> ends{};
  const auto cannot = [] {
    return failure(ErrorCode::outOfMemory,
                   "no process can be started to decode it: " + std::generic_category().message(errno));
  };
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return cannot();
  const pid_t id = fork();
  if (id == 0) runChild(work, limits, ends[1]);
  if (id < 0) {
    const auto error = cannot();
    ::close(ends[0]);
    ::close(ends[1]);
    return error;
  }
  ::close(ends[1]);
  const Child child(id, ends[0]);

  std::array<char, kHeadBytes> head{};
  ARETE_CHECK(child.read(head.data(), head.size(), context));
  std::uint64_t size = 0;
  std::memcpy(&size, head.data() + 1, sizeof size);
  const bool isValue = head[0] == kValue;
  if (size > (isValue ? limits.answerBytes : kLongestMessage) || (!isValue && size == 0))
    return failure(ErrorCode::corrupt, "it decodes to more than it announces");
  std::string bytes(size, '\0');
  ARETE_CHECK(child.read(bytes.data(), bytes.size(), context));
  if (isValue) return bytes;
  const auto code = static_cast<unsigned char>(bytes[0]);
  return failure(
      code <= static_cast<unsigned char>(ErrorCode::internal) ? ErrorCode(code) : ErrorCode::corrupt,
      bytes.substr(1));
} catch (...) {
  return caughtFailure();
}

}  // namespace arete
