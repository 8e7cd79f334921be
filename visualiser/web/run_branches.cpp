#include "visualiser/web/run_branches.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <vector>

namespace swarmanoid
{
namespace
{

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

// All runs end at the same time.
RunBranches::~RunBranches()
{
  for (const Branch& branch : branches_) branch.run->Stop();
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
    const std::vector<std::string> what{"--branch", fmt::format("{}@{}", run_folder_, tick), "--real-time", "1"};
    branches_.push_back({client, tick, std::make_unique<StartedRun>(program_, what, folder)});
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
  const bool goes_on = branch.run->Look();
  if (const std::string& url = branch.run->Url(); !url.empty() && !branch.is_answered)
  {
    branch.is_answered = true;
    answered_(branch.client, {branch.tick, url, {}});
  }
  if (!goes_on && !branch.is_answered) answered_(branch.client, {branch.tick, {}, branch.run->LastError()});
  return goes_on;
}

}  // namespace swarmanoid
