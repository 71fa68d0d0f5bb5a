// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/tools/command_job.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <utility>

#include "io/files/shell_text.h"

namespace arete {
namespace {

/// How often a command is asked whether it goes on.
constexpr int kPollMilliseconds = 50;

/// The end of a pipe that is closed with it.
struct PipeEnds {
  std::array<int, 2> at{-1, -1};
  PipeEnds() {
    if (pipe2(at.data(), O_CLOEXEC) != 0) at = {-1, -1};
  }
  PipeEnds(const PipeEnds&) = delete;
  PipeEnds& operator=(const PipeEnds&) = delete;
  ~PipeEnds() {
    for (int& end : at) closeEnd(end);
  }
  static void closeEnd(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
};

struct Said {
  std::string out, err;
};

/// "build a multitriangulation 40": the line that the bar of a command writes at present.
void reportLine(const std::string& err, const RunContext& context) {
  const std::size_t begin = err.find_last_of('\n');
  const std::string line = begin == std::string::npos ? err : err.substr(begin + 1);
  std::string stage;
  double percent = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool isDigit = line[i] >= '0' && line[i] <= '9';
    if (isDigit) {
      std::size_t end = i;
      while (end < line.size() && line[end] >= '0' && line[end] <= '9') ++end;
      if (end - i <= 3) percent = std::stod(line.substr(i, end - i));
      i = end - 1;
    } else if (percent == 0 && line[i] != '.') {
      stage += line[i];
    }
  }
  while (!stage.empty() && stage.back() == ' ') stage.pop_back();
  if (!stage.empty()) context.report(stage, percent <= 100 ? percent / 100 : 0);
}

/// The sentence of a failure: the last line that is one, without the name of the program.
std::string sentenceOf(const std::string& err, const CommandWords& command, int status) {
  constexpr std::string_view kName = "arete: ";
  std::string sentence;
  std::size_t begin = 0;
  while (begin < err.size()) {
    const std::size_t end = std::min(err.find('\n', begin), err.size());
    const std::string_view line = std::string_view(err).substr(begin, end - begin);
    if (line.starts_with(kName)) sentence = line.substr(kName.size());
    begin = end + 1;
  }
  if (!sentence.empty()) return sentence;
  if (WIFSIGNALED(status))
    return textOf(command) + " was ended by signal " + std::to_string(WTERMSIG(status));
  return textOf(command) + " failed with exit code " + std::to_string(WEXITSTATUS(status));
}

void readMore(int& end, std::string& text) {
  std::array<char, 4096> part;
  const ssize_t got = ::read(end, part.data(), part.size());
  if (got > 0)
    text.append(part.data(), std::size_t(got));
  else if (got == 0 || errno != EINTR)
    PipeEnds::closeEnd(end);
}

Result<std::string> runOne(const std::string& program, const CommandWords& command,
                           const RunContext& context) {
  PipeEnds out, err;
  if (out.at[0] < 0 || err.at[0] < 0) return failure(ErrorCode::unsupported, std::strerror(errno), program);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.at[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.at[1], STDERR_FILENO);
  CommandWords words = command;
  words.insert(words.begin(), program);
  // With a blank before it, as options stand in a command line.
  words.push_back(std::string(" --progress").substr(1));
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  // A group of its own, so that what the command starts is ended with it.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGINT);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return failure(ErrorCode::unsupported, std::strerror(error), program);
  PipeEnds::closeEnd(out.at[1]);
  PipeEnds::closeEnd(err.at[1]);
  Said said;
  bool isInterrupted = false;
  while (out.at[0] >= 0 || err.at[0] >= 0) {
    if (context.cancelled() && !std::exchange(isInterrupted, true)) ::kill(-child, SIGINT);
    std::array<pollfd, 2> ends{pollfd{out.at[0], POLLIN, 0}, pollfd{err.at[0], POLLIN, 0}};
    if (::poll(ends.data(), ends.size(), kPollMilliseconds) <= 0) continue;
    if (ends[0].revents != 0) readMore(out.at[0], said.out);
    if (ends[1].revents == 0) continue;
    readMore(err.at[0], said.err);
    reportLine(said.err, context);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) == -1 && errno == EINTR) {
  }
  if (context.cancelled()) return failure(ErrorCode::interrupted, "was stopped", textOf(command));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    return failure(ErrorCode::unreadable, sentenceOf(said.err, command, status));
  return said.out;
}

}  // namespace

std::string textOf(const CommandWords& command) {
  std::string text = "arete";
  for (const std::string& word : command) text += " " + shellQuoted(word);
  return text;
}

void CommandJob::start(const std::string& program, std::vector<CommandWords> commands) {
  work_.start([program, commands = std::move(commands)](const RunContext& context) -> Result<std::string> {
    std::string said;
    for (const CommandWords& command : commands) {
      ARETE_TRY(said, runOne(program, command, context));
    }
    return said;
  });
}

}  // namespace arete
