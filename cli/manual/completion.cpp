// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/manual/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace arete {

std::string bashCompletion(const CLI::App& program) {
  std::string commands, options, choices;
  for (const DeclaredCommand& command : declaredCommands(program)) {
    const std::string path = command.joined(" ");
    std::string below, flags;
    for (const CLI::App* one : command.app->get_subcommands({})) below += " " + one->get_name();
    if (!below.empty()) commands += fmt::format("    '{}') echo '{}' ;;\n", path, below.substr(1));
    for (const DeclaredOption& option : declaredOptions(*command.app)) {
      if (option.isArgument) continue;
      for (const std::string& name : option.names) {
        flags += " " + name;
        if (option.choices.empty()) continue;
        choices += fmt::format("    '{} {}') echo '{}' ;;\n", path, name, fmt::join(option.choices, " "));
      }
    }
    options += fmt::format("    '{}') echo '{}' ;;\n", path, flags.empty() ? "" : flags.substr(1));
  }
  return "# bash completion of arete, made of its declarations by: arete manual --completion\n"
         "# shellcheck shell=bash\n"
         "_arete_commands() {\n  case $1 in\n" +
         commands + "  esac\n}\n_arete_options() {\n  case $1 in\n" + options +
         "  esac\n}\n_arete_choices() {\n  case $1 in\n" + choices +
         R"(  esac
}
_arete() {
  local word=${COMP_WORDS[COMP_CWORD]} path='' i next
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    next=" $(_arete_commands "$path") "
    [[ $next == *" ${COMP_WORDS[i]} "* ]] && path=${path:+$path }${COMP_WORDS[i]}
  done
  next=$(_arete_choices "$path ${COMP_WORDS[COMP_CWORD - 1]}")
  if [[ -z $next ]]; then
    if [[ $word == -* ]]; then next=$(_arete_options "$path"); else next=$(_arete_commands "$path"); fi
  fi
  mapfile -t COMPREPLY < <(compgen -W "$next" -- "$word")
}
complete -o default -o bashdefault -F _arete arete
)";
}

}  // namespace arete
