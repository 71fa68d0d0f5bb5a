// SPDX-License-Identifier: GPL-3.0-or-later
//
// Declares the commands, parses, dispatches. What a command does lives in io/ and below.
#include "cli/commands/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "cli/arguments/spaced_numbers.h"
#include "cli/arguments/unknown_words.h"
#include "cli/commands/build.h"
#include "cli/commands/convert.h"
#include "cli/commands/demo.h"
#include "cli/commands/extract.h"
#include "cli/commands/height.h"
#include "cli/commands/info.h"
#include "cli/commands/measure.h"
#include "cli/commands/validate.h"
#include "cli/manual/help_page.h"
#include "cli/manual/manual.h"
#include "cli/mesh/mesh.h"
#include "cli/session/exit_code.h"
#include "cli/session/interrupt.h"
#include "cli/session/output_argument.h"
#include "cli/session/session.h"
#include "cli/sight/los.h"
#include "cli/sight/profile.h"
#include "cli/sight/viewshed.h"
#include "cli/view/view.h"

namespace arete {
namespace {

/// The command that was parsed, "mesh info" as info.
const CLI::App& parsedCommand(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  return *command;
}

/// "arete mesh info".
std::string wholeName(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return (parent ? wholeName(*parent) + " " : "") + command.get_name();
}

/// "help mesh info" says "mesh info --help", and "version" says "--version".
std::vector<std::string> withHelpAsOption(std::vector<std::string> words) {
  if (words.front() == "version") words.front() = "--version";
  if (words.front() == "help") {
    words.erase(words.begin());
    if (std::ranges::find(words, "--help-all") == words.end()) words.emplace_back("--help");
  }
  return words;
}

}  // namespace

void declareProgram(CLI::App& app, Session& session) {
  app.description(
      "Arete turns a digital elevation model or a triangle mesh into one multitriangulation and\n"
      "takes meshes of any tolerance from it, with an error that can be measured independently.");
  app.name("arete");
  app.set_version_flag("--version", "arete " ARETE_VERSION, "Print the version");
  app.formatter(helpPages());  // of all commands that are added from here on
  app.set_help_flag("-h,--help", "Show the common options, and examples");
  app.set_help_all_flag("--help-all", "Show all options");
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  arete build dem.tif -o dem.amt                     once\n"
      "  arete extract dem.amt -o tin.ply --max-error 5     any number of times, at any tolerance\n"
      "  arete height dem.amt --at X,Y                      height of the terrain there\n"
      "  arete los dem.amt --from X,Y,H --to X,Y,H          whether they see each other\n"
      "  arete measure tin.ply dem.tif --expect 5           the promise, checked independently\n"
      "  arete mesh info scan.ply                           what is the matter with a mesh\n"
      "\n" +
      std::string(exitCodeTable()) +
      "\n\nCOMMAND --help, or help COMMAND, shows the common options of a command and examples;\n"
      "COMMAND --help-all shows all of its options.");
  addBuildCommand(app, session);
  addInfoCommand(app, session);
  addExtractCommand(app, session);
  addHeightCommand(app, session);
  addLosCommand(app, session);
  addProfileCommand(app, session);
  addViewshedCommand(app, session);
  addViewCommand(app, session);
  addMeasureCommand(app, session);
  addValidateCommand(app, session);
  addConvertCommand(app, session);
  addMeshCommand(app, session);
  addDemoCommand(app, session);
  addManualCommand(app, session);
}

ExitCode runProgram(int argc, char** argv) {
  Session session;
  CLI::App app;
  declareProgram(app, session);

  if (argc < 2) {
    std::fputs(app.help().c_str(), stderr);
    return ExitCode::usage;
  }
  const std::vector<std::string> words = withHelpAsOption({argv + 1, argv + argc});
  session.setWords(words);
  const bool wantsJson = std::ranges::count(words, "--json") > 0;
  if (const std::string sentence = unknownCommand(app, words); !sentence.empty())
    return session.refuse(sentence, "arete", wantsJson);
  if (const std::string sentence = spacedNumbers(app, words); !sentence.empty())
    return session.refuse(sentence, "arete " + words.front(), wantsJson);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes them from the end
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // --help, --version
      app.exit(error);
      return std::fflush(stdout) == 0 ? ExitCode::ok : ExitCode::file;
    }
    const CLI::App& command = parsedCommand(app);
    // An option that does not exist says more than one that is missing for it.
    // The value of such an option may have been taken for the output.
    const bool mayBeUnknown =
        dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
        dynamic_cast<const CLI::RequiredError*>(&error) != nullptr ||
        (dynamic_cast<const CLI::ValidationError*>(&error) != nullptr && hasOutputArgument(command));
    const std::string unknown = mayBeUnknown ? unknownOption(command, words) : std::string();
    return session.refuse(unknown.empty() ? error.what() : unknown, wholeName(command), wantsJson);
  }
  return session.runParsed();
}

}  // namespace arete
