// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text goes to stdout, everything else to stderr. Before a line is written there, the progress bar ends its
// own. Errors and warnings of the library pass through withOptionNames().
#include "cli/session/session.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <new>
#include <utility>

#include "cli/session/interrupt.h"
#include "cli/session/option_names.h"
#include "cli/session/progress_bar.h"
#include "engine/memory/pages.h"

namespace arete {
namespace {

/// The progress line on stderr, which is ended before anything else is written there.
ProgressBar& progressBar() {
  static ProgressBar bar(stderr);
  return bar;
}

/// Errors are found at the end of the run, by ferror().
void print(const std::string& text, std::FILE* out) {
  std::fwrite(text.data(), 1, text.size(), out);
}

/// Replaces control characters, which names and texts of a file may hold, so that they cannot drive the
/// terminal.
std::string withoutControls(std::string text) {
  for (char& c : text)
    if ((static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t') || c == 127) c = '?';
  return text;
}

}  // namespace

CLI::App* Session::addCommand(CLI::App& app, const std::string& name, const std::string& summary,
                              const std::string& examples, Run run) {
  CLI::App* command = app.add_subcommand(name, summary);
  command->footer("Examples:\n" + examples);
  command->add_flag("--json", json_, "Write the answer to stdout as one JSON object")->group("Output");
  command->add_flag("-q,--quiet", quiet_, "Write only errors, and the object of --json")->group("Output");
  command->add_flag("--progress", progress_, "Write progress to stderr even where that is not a terminal")
      ->group("Output");
  command->add_option("--threads", threads_, "Number of threads (default: all); results do not depend on it")
      ->check(CLI::Range(1, 4096))
      ->type_name("N")
      ->group("Output");
  command
      ->add_flag_callback(
          "--no-huge-pages", [] { setHugePages(false); },
          "Keep large arrays in small memory pages, where huge pages make this machine slower")
      ->group("Output");
  command->callback([this, run = std::move(run)] { run_ = run; });
  return command;
}

ExitCode Session::runParsed() {
  std::unique_ptr<tbb::global_control> limit;
  if (threads_ > 0)
    limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                  static_cast<std::size_t>(threads_));
  ExitCode code = ExitCode::ok;
  try {
    const Status status = run_(*this);
    if (status)
      progressBar().finishLine();
    else
      code = fail(status.error());
  } catch (const std::bad_alloc&) {
    progressBar().endLine();
    fmt::print(stderr, "arete: there is not enough memory for this\n");
    return ExitCode::internal;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    fmt::print(stderr, "arete: stdout cannot be written to\n");
    return ExitCode::file;
  }
  return code;
}

RunContext Session::context() const {
  RunContext context;
  context.cancel = &interruptFlag();
  context.threads = threads_;
  if (progress_ || (!quiet_ && isatty(STDERR_FILENO) != 0))
    context.progress = [](std::string_view stage, double fraction) { progressBar().report(stage, fraction); };
  return context;
}

void Session::say(const std::string& text) const {
  if (json_ || quiet_) return;
  progressBar().finishLine();
  print(withoutControls(text), out_);
  std::fflush(out_);
}

void Session::answer(const Json& object) {
  if (!json_) return;
  progressBar().finishLine();
  answered_ = true;
  // A path may not be UTF-8: invalid bytes are replaced; nothing throws.
  print(object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n", out_);
}

void Session::warn(const std::string& sentence) const {
  if (quiet_) return;
  progressBar().endLine();
  fmt::print(stderr, "arete: warning: {}\n", withoutControls(withOptionNames(sentence)));
}

void Session::warn(const std::vector<std::string>& sentences, const std::string& culprit) const {
  for (const std::string& sentence : sentences) warn(fmt::format("{}: {}", culprit, sentence));
}

ExitCode Session::fail(const Error& failed) {
  progressBar().endLine();
  const Error error = withOptionNames(failed);
  const ExitCode code = exitCodeOf(error.code);
  fmt::print(stderr, "arete: {}\n", withoutControls(error.describe()));
  answerError(error, code);
  return code;
}

ExitCode Session::refuse(const std::string& sentence, const std::string& help, bool wantsJson) {
  json_ = wantsJson;
  fmt::print(stderr, "arete: {}\nSee {} --help.\n", withoutControls(sentence), help);
  answerError({ErrorCode::usage, sentence, ""}, ExitCode::usage);
  return ExitCode::usage;
}

void Session::answerError(const Error& error, ExitCode code) {
  if (answered_) return;
  answer({{"error",
           {{"code", toString(error.code)},
            {"message", error.message},
            {"culprit", error.culprit},
            {"exitCode", static_cast<int>(code)}}}});
}

}  // namespace arete
