// Programs print their results to standard output. A result that cannot be written is an error of the program.
#pragma once

#include <cstddef>
#include <optional>

namespace swarmanoid
{

// Opens standard input, output and error if the process was started without them. Otherwise the next opened files would
// get their numbers, and printed text would go into them. Printing to such an output is an error.
void OpenStandardFiles();

// Returns the columns of the terminal that the descriptor is, or nothing if it is none.
std::optional<std::size_t> TerminalWidth(int descriptor);

// Records that the reader of the output has closed it, as `head` does. Text that is printed afterwards is not needed.
void ReaderOfOutputHasGone();

// Writes out all printed text. Returns false if any of it was lost, unless the reader has closed the output. The first
// call that finds a loss prints an error.
bool OutputIsWritten();

// Returns the exit code of a program that has printed its results. If they were lost and `code` is no failure, it is
// that of a failed process.
int ExitCodeWithOutput(int code);

}  // namespace swarmanoid
