// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/session/exit_code.h"
#include "cli/session/json.h"
#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"

namespace arete {

class RunLog;

/// One run of the program: output, progress, interruption and exit code, for all commands alike.
///
/// Results go to stdout, either as text or (--json) as one object; progress, warnings and errors go to
/// stderr. With --quiet only errors are written, and the object of --json. With --log all of it is in a log
/// too.
class Session {
 public:
  using Run = std::function<Status(Session&)>;

  /// Declares a command and the options that every command has.
  ///
  /// @param examples lines for the end of its help.
  /// @param run is called by runParsed() if this command was parsed.
  /// @return the command, for options of its own.
  CLI::App* addCommand(CLI::App& app, const std::string& name, const std::string& summary,
                       const std::string& examples, Run run);

  /// Runs the command that was parsed and writes its error, if any. Call once.
  ExitCode runParsed();

  /// Writes why a command line cannot be parsed.
  ///
  /// @param help the command whose --help is recommended, as "arete build".
  /// @param wantsJson whether --json is among the words.
  ExitCode refuse(const std::string& sentence, const std::string& help, bool wantsJson);

  bool wantsJson() const { return json_; }
  /// Whether the object of answer() is wanted, by --json or by --log.
  bool wantsAnswer() const { return json_ || log_ != nullptr; }
  /// Progress according to the options, and the cancel flag that Ctrl-C sets.
  RunContext context() const;

  /// Leaves stdout to a file that the command writes there: text and the object of --json go to stderr.
  void leaveStdout() { out_ = stderr; }

  /// Writes text to stdout; not with --json or --quiet.
  void say(const std::string& text) const;
  /// Writes the object to stdout with --json, and to the log, and in it the files that were written and
  /// those that were replaced. Call at most once, behind the last file.
  void answer(const Json& object);
  /// Writes "arete: ..." to stderr, not with --quiet: what a person wants to know beside a table on stdout.
  void note(const std::string& sentence) const;
  /// Writes "arete: warning: ..." to stderr, not with --quiet. Fields in backquotes become options.
  void warn(const std::string& sentence) const;
  void warn(const Warnings& warnings, const std::string& culprit) const;

  /// The words of the command line, behind the program's name: among them are the files that --confined
  /// allows.
  void setWords(std::vector<std::string> words) { words_ = std::move(words); }

 private:
  /// Runs the command and reports its error.
  ExitCode runAndReport();
  /// Opens the log, if one is wanted, and writes its first line.
  Status openLog();
  /// Writes the last lines of the log. @return the exit code, which a log that cannot be written changes
  ExitCode closeLog(ExitCode code);
  Status prepareGdal();
  /// The status of a run, or why it says what it says: an input was changed, a signal ended it. An error of
  /// data without a culprit is one of the command's file.
  Status explain(Status status) const;
  /// The file that the command is about: its first argument that is no option.
  std::string subject() const;
  ExitCode fail(const Error& failed);
  /// Names the files that were written, and those that were replaced.
  void sayFiles() const;
  void answerError(const Error& error, ExitCode code);
  void printObject(const Json& object);
  void warn(const std::string& sentence, std::string_view code) const;

  bool json_ = false, quiet_ = false, progress_ = false, answered_ = false;
  int threads_ = 0;
  bool isConfined_ = false;
  std::FILE* out_ = stdout;
  std::vector<std::string> words_;
  Run run_;
  const CLI::App* command_ = nullptr;
  std::string logPath_, cache_;
  std::shared_ptr<RunLog> log_;
  Json error_;  // null, or the object of the error
};

}  // namespace arete
