// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text goes to stdout, everything else to stderr. Before a line is written there, the progress bar ends its
// own. Errors and warnings of the library pass through withOptionNames().
#include "cli/session/session.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <new>
#include <utility>

#include "cli/session/byte_count.h"
#include "cli/session/interrupt.h"
#include "cli/session/next_step.h"
#include "cli/session/option_names.h"
#include "cli/session/output_argument.h"
#include "cli/session/progress_bar.h"
#include "cli/session/proj_guard.h"
#include "engine/memory/pages.h"
#include "engine/parallel/thread_limit.h"
#include "io/files/text/address_text.h"
#include "io/files/watched_files.h"
#include "io/files/written_files.h"
#include "io/geo/gdal/confined.h"
#include "io/geo/gdal/unclaimed_messages.h"

namespace arete {
namespace {

/// The progress line on stderr, which is ended before anything else is written there.
ProgressBar& progressBar() {
  static ProgressBar bar(stderr);
  return bar;
}

/// Not fmt::print(), which throws where stderr is closed or full: an error keeps its exit code.
void tell(const std::string& text) {
  std::fputs(text.c_str(), stderr);
}

void warnOfGdal(const char* line) {
  progressBar().endLine();
  tell(fmt::format("arete: warning: GDAL: {}\n", line));
}

/// The words of a command line that may name files: neither options nor numbers. Of "--option=VALUE" the
/// value.
std::vector<std::string> fileNamesOf(const std::vector<std::string>& words) {
  std::vector<std::string> names;
  for (std::size_t i = 1; i < words.size(); ++i) {  // the first is the command
    std::string word = words[i];
    if (word.starts_with("-")) {
      const std::size_t equals = word.find('=');
      if (equals == word.npos) continue;
      word.erase(0, equals + 1);
    }
    if (word.find_first_not_of("0123456789.,-+eE") != word.npos) names.push_back(std::move(word));
  }
  return names;
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

/// The object without the queries of addresses in its texts.
Json withoutQueriesIn(Json value) {
  if (value.is_string()) return withoutQueries(value.get_ref<const std::string&>());
  if (value.is_structured())
    for (Json& part : value) part = withoutQueriesIn(std::move(part));
  return value;
}

/// The files that were written, as the answer lists them. What was there before them is named apart.
void addFilesTo(Json& answer) {
  const std::vector<WrittenFile> written = writtenFiles();
  if (written.empty() || !answer.is_object()) return;
  Json files = Json::array(), replaced = Json::array();
  for (const WrittenFile& file : written) {
    files.push_back({{"path", file.path}, {"bytes", file.bytes}});
    if (file.olderBytes && !file.isAddedTo)
      replaced.push_back({{"path", file.path}, {"bytes", *file.olderBytes}});
  }
  if (!answer.contains("files")) answer["files"] = std::move(files);
  answer["replaced"] = std::move(replaced);
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
  command
      ->add_flag("--confined", isConfined_,
                 "Read the named files and their sidecars only, without network (for services)")
      ->group("Output");
  // The command runs after parsing has ended, and not within it, so that its errors are not taken for those
  // in the arguments.
  command->callback([this, command, run = std::move(run)] {
    requireOneOutput(*command);
    run_ = run;
    command_ = command;
  });
  return command;
}

/// The status is explained before it is reported: a changed input or a signal may be the cause of what looks
/// like another error. A failed write to stdout is noticed at the last flush.
ExitCode Session::runParsed() {
  std::optional<ThreadLimit> limit;
  if (threads_ > 0) limit.emplace(threads_);
  ExitCode code = ExitCode::ok;
  try {
    listWrittenFiles();
    Status status = prepareGdal();
    if (status) status = run_(*this);
    if (Status explained = explain(std::move(status)); explained)
      progressBar().finishLine();
    else
      code = fail(explained.error());
    sayFiles();
  } catch (const std::bad_alloc&) {
    progressBar().endLine();
    tell("arete: there is not enough memory for this\n");
    return ExitCode::internal;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    tell("arete: stdout cannot be written to\n");
    return ExitCode::file;
  }
  return code;
}

// GDAL is confined before the first file is opened; what GDAL says outside any reader becomes a warning.
Status Session::prepareGdal() {
  sendUnclaimedGdalMessages(quiet_ ? nullptr : warnOfGdal);
  guardProjFiles();
  return isConfined_ ? confineGdal(fileNamesOf(words_)) : Status();
}

Status Session::explain(Status status) const {
  if (const char* const changed = changedInputFile())
    return failure(ErrorCode::unreadable, "was changed while it was read", changed);
  if (status) return status;
  Error& error = status.error();
  // What a signal ended may look like a file that cannot be opened.
  const bool isAboutAFile = error.code == ErrorCode::notFound || error.code == ErrorCode::unreadable ||
                            error.code == ErrorCode::unsupported || error.code == ErrorCode::corrupt;
  if (interruptFlag() && isAboutAFile) return failure(ErrorCode::interrupted, "interrupted", error.culprit);
  if (error.culprit.empty() && (isAboutAFile || error.code == ErrorCode::invalidData))
    error.culprit = subject();
  return status;
}

std::string Session::subject() const {
  if (command_ == nullptr) return {};
  for (const CLI::Option* option : command_->get_options())
    if (option->get_positional() && option->count() > 0) return option->results().front();
  return {};
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
  if (json_ || quiet_ || changedInputFile() != nullptr) return;
  progressBar().finishLine();
  print(withoutControls(text), out_);
  std::fflush(out_);
}

void Session::answer(const Json& object) {
  if (!json_ || (changedInputFile() != nullptr && !object.contains("error"))) return;
  progressBar().finishLine();
  answered_ = true;
  Json whole = object;
  addFilesTo(whole);
  // A path may not be UTF-8: invalid bytes are replaced; nothing throws.
  print(withoutQueriesIn(std::move(whole)).dump(2, ' ', false, Json::error_handler_t::replace) + "\n", out_);
}

void Session::note(const std::string& sentence) const {
  if (quiet_) return;
  progressBar().endLine();
  tell(fmt::format("arete: {}\n", withoutControls(withoutQueries(withOptionNames(sentence)))));
}

void Session::warn(const std::string& sentence) const {
  if (quiet_) return;
  progressBar().endLine();
  tell(fmt::format("arete: warning: {}\n", withoutControls(withoutQueries(withOptionNames(sentence)))));
}

void Session::warn(const Warnings& warnings, const std::string& culprit) const {
  for (const Warning& warning : warnings) warn(fmt::format("{}: {}", culprit, warning.sentence));
}

// A file that was replaced is said on stderr, where what a person should know goes while text is piped away.
// The pictures of a flight are many: they are counted.
void Session::sayFiles() const {
  if (json_) return;  // the answer lists them
  constexpr std::size_t kMostNamed = 20;
  const std::vector<WrittenFile> files = writtenFiles();
  if (files.size() > kMostNamed) {
    std::uint64_t bytes = 0;
    std::size_t replaced = 0;
    for (const WrittenFile& file : files) {
      bytes += file.bytes;
      replaced += file.olderBytes && !file.isAddedTo ? 1 : 0;
    }
    say(fmt::format("Wrote {} files ({}), {} to {}\n", files.size(), byteCount(bytes), files.front().path,
                    files.back().path));
    if (replaced > 0) note(fmt::format("Replaced {} of {} files", replaced, files.size()));
    return;
  }
  for (const WrittenFile& file : files) {
    const std::string named = fmt::format("{} ({})", file.path, byteCount(file.bytes));
    if (file.olderBytes && !file.isAddedTo)
      note("Replaced " + named);
    else
      say(fmt::format("{} {}\n", file.isAddedTo ? "Added to" : "Wrote", named));
  }
}

ExitCode Session::fail(const Error& failed) {
  progressBar().endLine();
  const Error error = withNextStep(withOptionNames(failed), command_ ? command_->get_name() : "");
  const ExitCode code = exitCodeOf(error.code);
  tell(fmt::format("arete: {}\n", withoutControls(withoutQueries(error.describe()))));
  answerError(error, code);
  return code;
}

ExitCode Session::refuse(const std::string& sentence, const std::string& help, bool wantsJson) {
  json_ = wantsJson;
  tell(fmt::format("arete: {}\nSee {} --help.\n", withoutControls(withoutQueries(sentence)), help));
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
