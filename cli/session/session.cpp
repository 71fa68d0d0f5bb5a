// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text goes to stdout, everything else to stderr. Before a line is written there, the progress bar ends its
// own. Errors and warnings of the library pass through withOptionNames().
#include "cli/session/session.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <utility>

#include "cli/cache/cache_argument.h"
#include "cli/memory/memory_option.h"
#include "cli/session/interrupt.h"
#include "cli/session/named_files.h"
#include "cli/session/next_step.h"
#include "cli/session/option_names.h"
#include "cli/session/output_argument.h"
#include "cli/session/progress_bar.h"
#include "cli/session/proj_guard.h"
#include "cli/session/run_log.h"
#include "engine/base/memory_refusal.h"
#include "engine/memory/pages.h"
#include "engine/parallel/thread_limit.h"
#include "io/files/network/network_use.h"
#include "io/files/ranges/web_settings.h"
#include "io/files/text/address_text.h"
#include "io/files/text/grouped.h"
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

/// Where GDAL's messages go beside stderr, while a command runs.
RunLog* logOfGdal = nullptr;

void logGdal(const char* line) {
  if (logOfGdal != nullptr)
    logOfGdal->line("warning", {{"code", nameOf(WarningCode::library)}, {"message", line}});
}

void warnOfGdal(const char* line) {
  logGdal(line);
  progressBar().endLine();
  tell(fmt::format("arete: warning: GDAL: {}\n", line));
}

constexpr const char* kLogOption = "--log";

/// The words of a command line that may name files: neither options nor numbers. Of "--option=VALUE" the
/// value. A log is not read.
std::vector<std::string> fileNamesOf(const std::vector<std::string>& words) {
  std::vector<std::string> names;
  for (std::size_t i = 1; i < words.size(); ++i) {  // the first is the command
    std::string word = words[i];
    if (words[i - 1] == kLogOption || word.starts_with(std::string(kLogOption) + "=")) continue;
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

/// What was read of servers, where something was.
void addNetworkTo(Json& answer) {
  const NetworkUse use = networkUse();
  if (use.requests == 0 || !answer.is_object() || answer.contains("network")) return;
  answer["network"] = {{"requests", use.requests}, {"bytes", use.bytes}, {"cachedBytes", use.cachedBytes}};
}

/// "mesh info".
std::string commandName(const CLI::App& command) {
  std::string name;
  for (const CLI::App* app = &command; app != nullptr && app->get_parent() != nullptr;
       app = app->get_parent())
    name = app->get_name() + (name.empty() ? "" : " " + name);
  return name;
}

Json errorObject(const Error& error, ExitCode code) {
  return {{"code", toString(error.code)},
          {"message", error.message},
          {"culprit", error.culprit},
          {"exitCode", static_cast<int>(code)}};
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
  addMemoryTo(*command);
  command
      ->add_flag("--confined", isConfined_,
                 "Read the named files and their sidecars only, without network (for services)")
      ->group("Output");
  command
      ->add_option(
          "--cache", cache_,
          "Keep what is fetched of models on servers in this folder, up to this number of bytes (2GB)")
      ->type_name("DIR[:BYTES]")
      ->check(cacheArgument())
      ->group("Output");
  command
      ->add_option(
          kLogOption, logPath_,
          "Append a log of the run: options, inputs and outputs with SHA-256, stages, times, memory,\n"
          "warnings, the answer; one JSON object a line, each written as it happens")
      ->type_name("FILE.jsonl")
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

/// A failed write to stdout is noticed at the last flush.
ExitCode Session::runParsed() {
  std::optional<ThreadLimit> limit;
  if (threads_ > 0) limit.emplace(threads_);
  ExitCode code = runAndReport();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    const Error error{ErrorCode::unreadable, "cannot be written to", "stdout"};
    if (error_.is_null()) error_ = errorObject(error, ExitCode::file);
    tell("arete: stdout cannot be written to\n");
    code = ExitCode::file;
  }
  return closeLog(code);
}

/// The status is explained before it is reported: a changed input or a signal may be the cause of what looks
/// like another error.
ExitCode Session::runAndReport() try {
  if (command_ != nullptr) progressBar().setPlan(plannedStages(commandName(*command_)));
  listWrittenFiles();
  Status status = openLog();
  if (status) status = prepareGdal();
  if (status) status = run_(*this);
  const Status explained = explain(std::move(status));
  if (explained) progressBar().finishLine();
  const ExitCode code = explained ? ExitCode::ok : fail(explained.error());
  sayFiles();
  return code;
} catch (const MemoryRefusal& refusal) {
  return fail({ErrorCode::outOfMemory, refusal.what(), subject()});
} catch (const std::bad_alloc&) {
  progressBar().endLine();
  const Error error{ErrorCode::outOfMemory, "there is not enough memory for this", ""};
  error_ = errorObject(error, ExitCode::internal);
  tell("arete: there is not enough memory for this\n");
  return ExitCode::internal;
}

// The first line says all that is known before the work: what was asked for, of which files, where.
Status Session::openLog() {
  if (logPath_.empty() && (command_ == nullptr || command_->count(kLogOption) == 0)) return {};
  if (command_ != nullptr) ARETE_CHECK(checkNamedOnce(*command_, kLogOption, logPath_));
  auto log = RunLog::open(logPath_);
  if (!log) {
    log.error().culprit = fmt::format("{} {}", kLogOption, logPath_);
    return tl::unexpected(log.error());
  }
  log_ = std::move(*log);
  std::error_code ignored;
  Json inputs = Json::array();
  std::vector<std::string> files = command_ != nullptr ? namedInputs(*command_) : std::vector<std::string>();
  for (const std::string& file : files) inputs.push_back(fileFacts(file));
  log_->line("start", {{"program", "arete"},
                       {"version", ARETE_VERSION},
                       {"process", ::getpid()},
                       {"folder", std::filesystem::current_path(ignored).string()},
                       {"command", command_ != nullptr ? commandName(*command_) : std::string()},
                       {"arguments", words_},
                       {"options", command_ != nullptr ? typedOptions(*command_, words_) : Json::object()},
                       {"threads", threads_ > 0 ? threads_ : hardwareThreads()},
                       {"machine", machineFacts()},
                       {"inputs", inputs}});
  log_->digestInputs(std::move(files));
  return {};
}

ExitCode Session::closeLog(ExitCode code) {
  if (log_ == nullptr) return code;
  logOfGdal = nullptr;
  const Status ended = log_->end(static_cast<int>(code), error_, interruptFlag());
  if (ended) return code;
  tell(fmt::format("arete: {}\n", withoutControls(ended.error().describe())));
  return code == ExitCode::ok ? ExitCode::file : code;
}

// GDAL is confined before the first file is opened; what GDAL says outside any reader becomes a warning.
Status Session::prepareGdal() {
  logOfGdal = log_.get();
  sendUnclaimedGdalMessages(!quiet_ ? warnOfGdal : log_ ? logGdal : nullptr);
  guardProjFiles();
  boundLibraries();
  if (isConfined_) return confineGdal(fileNamesOf(words_));
  ARETE_TRY(auto cache, openCache(cache_));
  setWebSettings({&interruptFlag(), std::move(cache)});
  return {};
}

Status Session::explain(Status status) const {
  if (const char* const changed = changedInputFile())
    return failure(ErrorCode::unreadable, "was changed while it was read", changed);
  if (status) return status;
  Error& error = status.error();
  nameBudget(error);
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
  const bool isShown = progress_ || (!quiet_ && isatty(STDERR_FILENO) != 0);
  if (isShown || log_)
    context.progress = [isShown, log = log_](std::string_view stage, double fraction) {
      if (isShown) progressBar().report(stage, fraction);
      if (log) log->report(stage, fraction);
    };
  return context;
}

void Session::say(const std::string& text) const {
  if (json_ || quiet_ || changedInputFile() != nullptr) return;
  progressBar().finishLine();
  print(withoutControls(withoutQueries(text)), out_);
  std::fflush(out_);
}

void Session::answer(const Json& object) {
  if (changedInputFile() != nullptr) return;
  Json whole = object;
  addFilesTo(whole);
  addNetworkTo(whole);
  if (log_) log_->line("result", {{"result", whole}});
  if (!json_) return;
  answered_ = true;
  printObject(whole);
}

void Session::printObject(const Json& object) {
  progressBar().finishLine();
  // A path may not be UTF-8: invalid bytes are replaced; nothing throws.
  print(withoutQueriesIn(object).dump(2, ' ', false, Json::error_handler_t::replace) + "\n", out_);
}

void Session::note(const std::string& sentence) const {
  const std::string text = withoutQueries(withOptionNames(sentence));
  if (log_) log_->line("note", {{"message", text}});
  if (quiet_) return;
  progressBar().endLine();
  tell(fmt::format("arete: {}\n", withoutControls(text)));
}

void Session::warn(const std::string& sentence) const {
  warn(sentence, {});
}

void Session::warn(const std::string& sentence, std::string_view code) const {
  const std::string text = withoutQueries(withOptionNames(sentence));
  if (log_) {
    Json fields = Json::object();
    if (!code.empty()) fields["code"] = code;
    fields["message"] = text;
    log_->line("warning", fields);
  }
  if (quiet_) return;
  progressBar().endLine();
  tell(fmt::format("arete: warning: {}\n", withoutControls(text)));
}

void Session::warn(const Warnings& warnings, const std::string& culprit) const {
  for (const Warning& warning : warnings)
    warn(fmt::format("{}: {}", culprit, warning.sentence), nameOf(warning.code));
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
  error_ = errorObject(error, code);
  tell(fmt::format("arete: {}\n", withoutControls(withoutQueries(error.describe()))));
  answerError(error, code);
  return code;
}

// The command line was not parsed; the log that it names may be.
ExitCode Session::refuse(const std::string& sentence, const std::string& help, bool wantsJson) {
  json_ = wantsJson;
  logPath_.clear();
  for (std::size_t i = 0; i + 1 < words_.size(); ++i)
    if (const std::string& next = words_[i + 1];
        words_[i] == kLogOption && !next.starts_with("-") && std::ranges::count(words_, next) == 1)
      logPath_ = next;
  command_ = nullptr;
  if (const Status opened = openLog(); !opened) tell(fmt::format("arete: {}\n", opened.error().describe()));
  const Error error{ErrorCode::usage, sentence, ""};
  error_ = errorObject(error, ExitCode::usage);
  tell(fmt::format("arete: {}\nSee {} --help.\n", withoutControls(withoutQueries(sentence)), help));
  answerError(error, ExitCode::usage);
  return closeLog(ExitCode::usage);
}

void Session::answerError(const Error& error, ExitCode code) {
  if (!answered_ && json_) printObject({{"error", errorObject(error, code)}});
}

}  // namespace arete
