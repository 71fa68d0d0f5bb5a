// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs commands of arete one after the other in one process, so that a thousand of them take seconds. A line
// of stdin is a command, its words separated by tabs. stdout and stderr of a command go to the files "out"
// and "err" of the current folder, anew for each; its exit code is a line on descriptor 3. Where a command
// ends the process, the one that reads these lines knows which it was.
#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "cli/commands/program.h"

namespace {

void redirect(int descriptor, const char* path) {
  const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || dup2(file, descriptor) < 0) std::abort();
  close(file);
}

}  // namespace

int main() {
  for (std::string line; std::getline(std::cin, line);) {
    std::vector<std::string> words = {"arete"};
    std::istringstream in(line);
    for (std::string word; std::getline(in, word, '\t');) words.push_back(word);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    redirect(STDOUT_FILENO, "out");
    redirect(STDERR_FILENO, "err");
    const int code = static_cast<int>(arete::runProgram(static_cast<int>(words.size()), argv.data()));
    std::fflush(nullptr);
    const std::string answer = std::to_string(code) + "\n";
    if (write(3, answer.data(), answer.size()) < 0) return 1;
  }
  return 0;
}
