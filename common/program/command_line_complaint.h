// What is said of words on the command line that a command does not take.
#pragma once

#include <string>

namespace CLI
{
class App;
class Error;
}  // namespace CLI

namespace swarmanoid
{

// The words, what the command takes instead, and the nearest of that; for other errors what they say themselves.
std::string CommandLineComplaint(const CLI::App& app, const CLI::Error& error);

}  // namespace swarmanoid
