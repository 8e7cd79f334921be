// A command line that cannot be done as asked.
#pragma once

#include <stdexcept>

namespace swarmanoid
{

// what() says why and what would do. Ends the program with kExitUsage.
class UsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

}  // namespace swarmanoid
