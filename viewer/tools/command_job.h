// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/background_work.h"

namespace arete {

/// The words of a command line, behind the program's name.
using CommandWords = std::vector<std::string>;

/// "arete mesh crop 'my scan.obj' ...", as a shell takes it.
std::string textOf(const CommandWords& command);

/// Runs commands of the program, one after the other, each as a process of its own: what they write has the
/// bytes that a user's shell would get, and one that runs out of memory ends alone.
class CommandJob {
 public:
  /// @param program its path. A job that runs is cancelled.
  void start(const std::string& program, std::vector<CommandWords> commands);
  /// Interrupts the command that runs, which leaves no half of a file, and waits for its end.
  void cancel() { work_.cancel(); }
  bool isRunning() const { return work_.isRunning(); }
  /// The stage is the last line that the command has said.
  BackgroundWork<std::string>::Progress progress() const { return work_.progress(); }
  /// What the last command said on stdout, once, when all are done. Errors: the code unsupported: the program
  /// cannot be started; unreadable: the sentence of the command that failed.
  std::optional<Result<std::string>> take() { return work_.take(); }

 private:
  BackgroundWork<std::string> work_;
};

}  // namespace arete
