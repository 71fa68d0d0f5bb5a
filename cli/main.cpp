// SPDX-License-Identifier: GPL-3.0-or-later
//
// arete: runs the program and reports exceptions that no command has caught.
#include <cstdio>
#include <exception>
#include <new>

#include "cli/commands/program.h"
#include "cli/session/faults.h"
#include "cli/session/interrupt.h"
#include "cli/session/memory_end.h"

int main(int argc, char** argv) {
  try {
    arete::prepareForLackOfMemory();
    arete::prepareForFaults();
    arete::catchInterrupts();
    return arete::leaveWith(arete::runProgram(argc, argv));
  } catch (const std::bad_alloc&) {
    std::fputs("arete: there is not enough memory for this\n", stderr);
  } catch (const std::exception& error) {
    std::fputs("arete: an unexpected failure, which is a bug: ", stderr);
    std::fputs(error.what(), stderr);
    std::fputc('\n', stderr);
  } catch (...) {
    std::fputs("arete: an unexpected failure, which is a bug\n", stderr);
  }
  return arete::leaveWith(arete::ExitCode::internal);
}
