// Starts a thread with a clear error. The exception of the standard library only says "Resource temporarily
// unavailable".
#pragma once

#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

namespace swarmanoid
{

// `purpose`: the task of the thread, as in "writes the journal". Throws std::runtime_error with it if the system cannot
// start another thread.
template <class Call>
std::thread StartThread(const std::string& purpose, Call&& call)
{
  try
  {
    return std::thread(std::forward<Call>(call));
  }
  catch (const std::system_error& error)
  {
    throw std::runtime_error("cannot start the thread that " + purpose + ": " + error.code().message() +
                             "; the user or the container has as many threads as it may: end other processes, or raise "
                             "the limit (ulimit -u)");
  }
}

}  // namespace swarmanoid
