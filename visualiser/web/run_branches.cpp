#include "visualiser/web/run_branches.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <utility>

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostErrorBytes = 65536;  // of the errors of a run

bool IsReadable(const FileDescriptor& file)
{
  pollfd end{file.Get(), POLLIN, 0};
  return file.IsOpen() && poll(&end, 1, 0) > 0;
}

// Reads what is there, so that the process never waits for a reader.
void Drain(FileDescriptor& file, std::string* text)
{
  std::array<char, 4096> bytes{};
  while (IsReadable(file))
  {
    const ssize_t count = read(file.Get(), bytes.data(), bytes.size());
    if (count <= 0) return file.Reset();
    if (text != nullptr && text->size() < kMostErrorBytes) text->append(bytes.data(), static_cast<std::size_t>(count));
  }
}

// Returns the last line of what a program said before it failed.
std::string LastLine(std::string text)
{
  while (text.ends_with('\n')) text.pop_back();
  return text.empty() ? "the new run ended without a word" : text.substr(text.rfind('\n') + 1);
}

// Returns a folder that does not exist.
std::string NewFolder(const std::string& run_folder, std::uint64_t tick)
{
  std::string folder = fmt::format("{}/branch-{}", run_folder, tick);
  for (int number = 2; std::filesystem::exists(folder); ++number)
    folder = fmt::format("{}/branch-{}-{}", run_folder, tick, number);
  return folder;
}

}  // namespace

RunBranches::RunBranches(std::string program, std::string run_folder, Answered answered)
    : program_(std::move(program)), run_folder_(std::move(run_folder)), answered_(std::move(answered))
{
}

RunBranches::~RunBranches()
{
  for (const Branch& branch : branches_) spawner_.Signal(branch.process, SIGTERM);
  for (const Branch& branch : branches_) spawner_.Collect(branch.process);
}

void RunBranches::Start(std::uint64_t client, std::uint64_t tick)
{
  Look();
  if (program_.empty())
    return answered_(client, {tick, {}, "a page can start a run only for the user of the run, by `swarmanoid`"});
  if (branches_.size() >= kMost)
    return answered_(client, {tick, {}, fmt::format("{} runs from this page go on; end one of them", kMost)});
  const std::string folder = NewFolder(run_folder_, tick);
  try
  {
    ProcessCommand command;
    command.name = "swarmanoid run";
    command.arguments = {program_,   "run",  "--branch",    fmt::format("{}@{}", run_folder_, tick),
                         "--output", folder, "--quiet",     "--no-visualisers",
                         "--show",   "web",  "--real-time", "1"};
    command.signal_at_our_end = SIGTERM;
    branches_.push_back({client, tick, folder, spawner_.Start(command)});
  }
  catch (const std::exception& error)
  {
    answered_(client, {tick, {}, error.what()});
  }
}

void RunBranches::Look()
{
  std::erase_if(branches_, [this](Branch& branch) { return !Follow(branch); });
}

bool RunBranches::Follow(Branch& branch)
{
  Drain(branch.process.output, nullptr);
  Drain(branch.process.errors, &branch.errors);
  std::string url;
  if (std::ifstream file(branch.folder + "/web_render.url");
      !branch.is_answered && std::getline(file, url) && !file.eof())
  {
    branch.is_answered = true;
    answered_(branch.client, {branch.tick, url, {}});
  }
  if (!IsReadable(branch.process.end)) return true;
  spawner_.Collect(branch.process);
  Drain(branch.process.errors, &branch.errors);
  if (!branch.is_answered) answered_(branch.client, {branch.tick, {}, LastLine(branch.errors)});
  return false;
}

}  // namespace swarmanoid
