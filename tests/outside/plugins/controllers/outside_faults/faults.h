// Faults of users' code, for plug-ins that fail when the environment variable OUTSIDE_FAULT is "<who> <fault> <tick>".
// The file OUTSIDE_FAULT_MARK is made before the failure.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace faults
{

// Every call takes some of the stack, and the compiler cannot remove it.
[[gnu::noinline]] inline int Recurse(int depth)
{
  volatile char room[4096];
  room[depth % 4096] = static_cast<char>(depth);
  return Recurse(depth + 1) + room[depth % 4096];
}

inline void TakeAllMemory()
{
  std::vector<std::vector<char>> taken;
  while (true) taken.emplace_back(std::size_t{4} << 20, 'x');
}

struct Foreign
{
};

inline void Fail(const std::string& fault)
{
  if (const char* mark = std::getenv("OUTSIDE_FAULT_MARK")) close(open(mark, O_WRONLY | O_CREAT, 0666));
  if (fault == "throw") throw std::runtime_error("cannot go on");
  if (fault == "throw_number") throw 42;
  if (fault == "throw_foreign") throw Foreign();
  if (fault == "exit") std::exit(0);
  if (fault == "_exit") _exit(0);
  if (fault == "_Exit") std::_Exit(0);
  if (fault == "quick_exit") std::quick_exit(0);
  if (fault == "system_call") syscall(SYS_exit_group, 0);
  if (fault == "abort") std::abort();
  if (fault == "terminate") std::terminate();
  if (fault == "kill") kill(getpid(), SIGKILL);
  if (fault == "segfault") *static_cast<volatile int*>(nullptr) = 1;
  if (fault == "stack") Recurse(0);
  if (fault == "memory") TakeAllMemory();
  volatile bool for_ever = fault == "loop";
  while (for_ever)
  {
  }
}

// `who` is controller, functions, engine, render or watch.
inline void FailIfAsked(const char* who, std::uint64_t tick)
{
  const char* asked = std::getenv("OUTSIDE_FAULT");
  if (asked == nullptr) return;
  std::istringstream words(asked);
  std::string part, fault;
  std::uint64_t when = 0;
  if (words >> part >> fault >> when && part == who && tick == when) Fail(fault);
}

}  // namespace faults
