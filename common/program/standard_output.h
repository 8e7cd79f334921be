// Standard output, where programs print their results: a result that cannot be written is an error of the program.
#pragma once

namespace swarmanoid
{

// Opens standard input, output and error if the process was started without them. Otherwise the next file that it
// opens would get their numbers, and what is printed would go into that file. What is printed then is an error.
void OpenStandardFiles();

// Tells that the program which read the output has closed it, as `head` does. It has seen enough: what is printed from
// then on is not missed.
void ReaderOfOutputHasGone();

// Writes out what was printed. Returns false if anything that this process printed is lost, unless its reader has gone.
// The first call that finds it prints an error.
bool OutputIsWritten();

// The exit code of a program that has printed its results: that of a failed process if they are lost, unless it has
// another one already.
int ExitCodeWithOutput(int code);

}  // namespace swarmanoid
