// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/manual/manual.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "cli/manual/completion.h"
#include "cli/manual/declarations.h"
#include "cli/manual/man_page.h"
#include "engine/base/counted.h"
#include "io/files/file_writer.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

struct ManualArguments {
  std::string folder;
  bool wantsCompletion = false;
  const CLI::App* program = nullptr;
};

Status runManual(const ManualArguments& arguments, Session& session) {
  const CLI::App& program = *arguments.program;
  if (arguments.wantsCompletion == !arguments.folder.empty())
    return failure(ErrorCode::usage, "needs either --man or --completion", "manual");
  if (arguments.wantsCompletion) {
    const std::string script = bashCompletion(program);
    session.say(script);
    session.answer({{"completion", script}});
    return {};
  }
  std::error_code error;
  fs::create_directories(arguments.folder, error);
  if (error)
    return failure(ErrorCode::unreadable, "the folder cannot be made: " + error.message(),
                   fmt::format("--man {}", arguments.folder));
  Json files = Json::array();
  for (const DeclaredCommand& command : declaredCommands(program)) {
    const std::string path = (fs::path(arguments.folder) / (pageName(command) + ".1")).string();
    ARETE_TRY(FileWriter out, FileWriter::create(path));
    out.write(manPage(command, program));
    ARETE_CHECK(out.finish());
    files.push_back(path);
  }
  session.say(
      fmt::format("{}: {}\n", arguments.folder, counted(files.size(), "manual page", "manual pages")));
  session.answer({{"files", std::move(files)}});
  return {};
}

}  // namespace

void addManualCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<ManualArguments>();
  arguments->program = &app;
  CLI::App* command =
      session.addCommand(app, "manual", "Write manual pages, or completion for the shell",
                         "  arete manual --man ~/.local/share/man/man1\n"
                         "  arete manual --completion > ~/.local/share/bash-completion/completions/arete",
                         [arguments](Session& s) { return runManual(*arguments, s); });
  command->add_option("--man", arguments->folder, "Folder for the pages: arete.1 and one for each command")
      ->type_name("FOLDER");
  command->add_flag("--completion", arguments->wantsCompletion,
                    "Write a script for bash to stdout; zsh takes it too");
}

}  // namespace arete
