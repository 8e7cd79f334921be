// Returns the message of the exception that a call throws.
#pragma once

#include <string>

namespace swarmanoid::test
{

// Returns `none` if the call throws nothing. Other exceptions pass.
template <class Exception, class Call>
std::string MessageOf(const Call& call, const std::string& none = "")
{
  try
  {
    call();
  }
  catch (const Exception& error)
  {
    return error.what();
  }
  return none;
}

}  // namespace swarmanoid::test
