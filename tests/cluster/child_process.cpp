#include "tests/cluster/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "tests/eventually.h"

namespace swarmanoid
{

using Clock = std::chrono::steady_clock;

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::string& output_file)
    : output_file_(output_file)
{
  // A test that is killed leaves no process.
  static std::string with[] = {"setpriv", "--pdeathsig", "KILL"};
  std::vector<char*> arguments{with[0].data(), with[1].data(), with[2].data()};
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, output_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0600);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  const int error = posix_spawnp(&id_, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw std::runtime_error("cannot start " + command[0]);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : id_(other.id_), exit_code_(other.exit_code_), output_file_(std::move(other.output_file_))
{
  other.id_ = -1;
}

ChildProcess::~ChildProcess()
{
  if (id_ < 0 || !Running()) return;
  Signal(SIGKILL);
  Wait();
}

int ChildProcess::Wait(double seconds)
{
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (exit_code_ < 0)
  {
    int status = 0;
    if (waitpid(id_, &status, WNOHANG) == id_)
      exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    else if (Clock::now() >= end)
      return -1;
    else
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return exit_code_;
}

void ChildProcess::Signal(int signal) const { kill(id_, signal); }

bool ChildProcess::StopAsleep() const
{
  const auto sleeps = [](const std::filesystem::directory_entry& thread)
  {
    std::string state;
    std::getline(std::ifstream(thread.path() / "stat"), state);
    return state.find(") S ") != std::string::npos;
  };
  const auto all_sleep = [&]
  { return std::ranges::all_of(std::filesystem::directory_iterator(fmt::format("/proc/{}/task", id_)), sleeps); };
  if (!test::Eventually(all_sleep)) return false;
  Signal(SIGSTOP);
  return true;
}

std::string ChildProcess::Output() const
{
  std::ifstream file(output_file_);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

bool ChildProcess::WaitForOutput(const std::string& text, double seconds) const
{
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (Output().find(text) == std::string::npos)
  {
    if (Clock::now() >= end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace swarmanoid
