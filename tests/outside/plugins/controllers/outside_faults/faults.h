// What goes wrong in the code of users, for plug-ins that fail when the environment variable OUTSIDE_FAULT says so:
// "<who> <fault> <tick>". The file OUTSIDE_FAULT_TIME gets the time of the failure, in seconds of the monotonic clock.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace faults
{

// Every call takes some of the stack, and none of it can be left out.
[[gnu::noinline]] inline int Recurse(int depth)
{
  volatile char room[4096];
  room[depth % 4096] = static_cast<char>(depth);
  return Recurse(depth + 1) + room[depth % 4096];
}

// There may be no memory left.
inline void NoteTime()
{
  const char* path = std::getenv("OUTSIDE_FAULT_TIME");
  if (path == nullptr) return;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  char text[40];
  const int size = std::snprintf(text, sizeof text, "%lld.%09ld", static_cast<long long>(now.tv_sec), now.tv_nsec);
  const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  if (write(file, text, static_cast<std::size_t>(size)) < 0) std::abort();
  close(file);
}

inline void TakeAllMemory()
{
  std::vector<std::vector<char>> taken;
  try
  {
    while (true) taken.emplace_back(std::size_t{4} << 20, 'x');
  }
  catch (const std::bad_alloc&)
  {
    NoteTime();
    throw;
  }
}

struct Foreign
{
};

inline void Fail(const std::string& fault)
{
  NoteTime();
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

// `who`: controller, functions, engine, render or watch.
inline void FailIfAsked(const char* who, std::uint64_t tick)
{
  const char* asked = std::getenv("OUTSIDE_FAULT");
  if (asked == nullptr) return;
  std::istringstream words(asked);
  std::string whom, fault;
  std::uint64_t when = 0;
  if (words >> whom >> fault >> when && whom == who && tick == when) Fail(fault);
}

}  // namespace faults
