// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/session/exit_code.h"
#include "engine/base/result.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// Insertion order is reading order.
using Json = nlohmann::ordered_json;

/// What all commands share: how they speak, how they stop, what they tell the shell.
///
/// Results go to stdout, either as text or (--json) as one object; progress, warnings and errors go to
/// stderr. With --quiet only errors are said, and --json's object.
class Session {
 public:
  using Run = std::function<Status(Session&)>;

  /// Declares a command with its examples and the options every command has, and what runs it. The command's
  /// own options are added to what comes back; `run` is called once they are parsed.
  CLI::App* addCommand(CLI::App& app, const std::string& name, const std::string& summary,
                       const std::string& examples, Run run);

  /// Runs the command that was parsed, says its error if it has one. At most once.
  ExitCode runParsed();

  /// Says why the command line makes no sense, and whose --help tells what would. `wantsJson`: as far as the
  /// words tell, since they could not be parsed.
  ExitCode refuse(const std::string& sentence, const std::string& help, bool wantsJson);

  bool wantsJson() const { return json_; }
  /// Progress as asked for, and the flag that Ctrl-C sets.
  RunContext context() const;

  /// Text for stdout; nothing with --json or --quiet.
  void say(const std::string& text) const;
  /// The object for stdout; nothing without --json. Once per run.
  void answer(const Json& object);
  /// A sentence for stderr, "arete: warning: ..."; nothing with --quiet.
  void warn(const std::string& sentence) const;
  void warn(const std::vector<std::string>& sentences, const std::string& culprit) const;

 private:
  ExitCode fail(const Error& error);
  void answerError(const Error& error, ExitCode code);

  bool json_ = false, quiet_ = false, progress_ = false, answered_ = false;
  int threads_ = 0;
  Run run_;
};

}  // namespace arete
