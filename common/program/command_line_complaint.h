// The message for words on the command line that a command does not take.
#pragma once

#include <string>

namespace CLI
{
class App;
class Error;
}  // namespace CLI

namespace swarmanoid
{

// Returns the unknown words, the words that the command takes instead, and the nearest of these. For other errors it
// returns their own text.
std::string CommandLineComplaint(const CLI::App& app, const CLI::Error& error);

}  // namespace swarmanoid
