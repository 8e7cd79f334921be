// Standard output, where programs print their results: a result that cannot be written is an error of the program.
#pragma once

namespace swarmanoid
{

// Opens standard input, output and error if the process was started without them. Otherwise the next file that it
// opens would get their numbers, and what is printed would go into that file. What is printed then is an error.
void OpenStandardFiles();

// Writes out what was printed. False if anything that this process printed is lost; the first call that finds it says
// so on standard error.
bool OutputIsWritten();

// The exit code of a program that has printed its results: that of a failed process if they are lost, unless it has
// another one already.
int ExitCodeWithOutput(int code);

}  // namespace swarmanoid
