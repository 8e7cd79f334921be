// The error for a command line that cannot be executed.
#pragma once

#include <stdexcept>

namespace swarmanoid
{

// A mistake in the command line is thrown as this error. what() gives the reason and the cure. It ends the program with
// kExitUsage.
class UsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

}  // namespace swarmanoid
