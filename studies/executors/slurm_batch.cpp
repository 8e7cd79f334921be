// Each file is written under another name, synchronised and renamed, so that it is complete or absent, also on file
// systems of several machines. A result is one file for each run. The file `job`, which has the number of the submitted
// job, is written last and removed first: a batch without it is incomplete or finished.
#include "studies/executors/slurm_batch.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "common/activity/failure_report.h"
#include "common/configuration/configuration_tree.h"
#include "common/configuration/regular_file.h"
#include "common/configuration/trust.h"
#include "common/errors/exit_codes.h"
#include "common/program/shell_word.h"
#include "launcher/system/installation.h"
#include "studies/executors/checked_frame.h"
#include "studies/executors/study_worker.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr std::uint64_t kMostOfFile = 1ULL << 32U;

std::string OrdersFile(const std::string& folder, std::size_t task)
{
  return fmt::format("{}/orders-{}", folder, task);
}
std::string ResultsFolder(const std::string& folder) { return folder + "/results"; }
std::string LogOfTask(const std::string& folder, std::size_t task)
{
  return fmt::format("{}/task-{}.log", folder, task);
}

// Writes the file completely or not at all, also if the machine stops.
void WriteWhole(const std::string& path, std::span<const char> content)
{
  const std::string draft = fmt::format("{}.{}.new", path, getpid());
  const int file = open(draft.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0666);
  errno = file < 0 ? errno : 0;
  const bool good = file >= 0 && WriteAll(file, {content.data(), content.size()}) && fsync(file) == 0;
  const int reason = errno;
  if (file >= 0) close(file);
  if (good && std::rename(draft.c_str(), path.c_str()) == 0) return;
  const int why = good ? errno : reason;
  std::remove(draft.c_str());
  throw std::runtime_error(fmt::format("cannot write '{}': {}", path, std::strerror(why)));
}

std::vector<char> ReadWholeFile(const std::string& path)
{
  try
  {
    const std::string bytes = ReadRegularFile(path, kMostOfFile);
    FrameReader reader;
    reader.Add(bytes);
    auto content = reader.Next();
    if (!content || !reader.AtEnd()) throw FrameError("it is cut short");
    return std::move(*content);
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(fmt::format("'{}': {}", path, error.what()));
  }
}

// Reads a name such as "12-7".
std::optional<RunName> NameOfResult(const std::string& file)
{
  const std::size_t dash = file.find('-');
  if (dash == std::string::npos) return std::nullopt;
  const auto point = ParseInteger(file.substr(0, dash));
  const auto seed = ParseInteger(file.substr(dash + 1));
  if (!point || !seed) return std::nullopt;
  return RunName{static_cast<std::uint32_t>(*point), static_cast<std::uint64_t>(*seed)};
}

}  // namespace

SlurmBatch SlurmBatch::Create(const std::string& study_folder, const std::vector<char>& setup,
                              const std::vector<RunOrder>& orders, std::size_t runs_per_task)
{
  std::error_code error;
  const std::string all = fs::absolute(study_folder, error).lexically_normal() / "slurm";
  std::size_t number = 1;
  while (fs::exists(fmt::format("{}/{}", all, number), error)) ++number;
  SlurmBatch batch(fmt::format("{}/{}", all, number));
  fs::create_directories(ResultsFolder(batch.folder_), error);
  if (error) throw std::runtime_error(fmt::format("cannot make the folder '{}': {}", batch.folder_, error.message()));
  WriteWhole(batch.folder_ + "/setup", Framed(setup));
  for (std::size_t first = 0, task = 0; first < orders.size(); first += runs_per_task, ++task)
  {
    ByteWriter bytes;
    const std::size_t end = std::min(first + runs_per_task, orders.size());
    bytes.Put(static_cast<std::uint64_t>(end - first));
    for (std::size_t k = first; k < end; ++k)
    {
      WriteFields(bytes, orders[k]);
      batch.outstanding_[task].push_back(orders[k].name);
    }
    WriteWhole(OrdersFile(batch.folder_, task), Framed(bytes.Bytes()));
  }
  const std::string script =
      fmt::format("#!/bin/sh\nexec {} {}{} {} \"$SLURM_ARRAY_TASK_ID\"\n", ShellWord(OwnProgram()), kStudyWorkerFlag,
                  ExperimentsAreTrusted() ? std::string(" ") + kTrustFlag : "", ShellWord(batch.folder_));
  WriteWhole(batch.Script(), script);
  return batch;
}

void SlurmBatch::SetJob(const std::string& job)
{
  job_ = job;
  WriteWhole(folder_ + "/job", job);
}

std::vector<SlurmBatch> SlurmBatch::FindAll(const std::string& study_folder)
{
  std::vector<SlurmBatch> batches;
  std::error_code none;
  const std::string all = fs::absolute(study_folder, none).lexically_normal() / "slurm";
  for (fs::directory_iterator entry(all, none), end; entry != end; entry.increment(none))
  {
    SlurmBatch batch(entry->path().string());
    // A batch that was never submitted, or is done, has no results to take.
    std::ifstream job(batch.folder_ + "/job");
    if (!(job >> batch.job_)) continue;
    for (std::size_t task = 0; fs::exists(OrdersFile(batch.folder_, task), none); ++task)
      for (const RunOrder& order : ReadOrders(batch.folder_, task)) batch.outstanding_[task].push_back(order.name);
    for (fs::directory_iterator result(ResultsFolder(batch.folder_), none); result != end; result.increment(none))
      if (const auto name = NameOfResult(result->path().filename().string()))
        if (fs::file_size(result->path(), none) == 0) batch.Settle(*name);
    batches.push_back(std::move(batch));
  }
  std::sort(batches.begin(), batches.end(),
            [](const SlurmBatch& a, const SlurmBatch& b) { return a.folder_ < b.folder_; });
  return batches;
}

std::vector<RunOutcome> SlurmBatch::TakeResults()
{
  std::vector<RunOutcome> outcomes;
  std::error_code none;
  for (fs::directory_iterator entry(ResultsFolder(folder_), none), end; entry != end; entry.increment(none))
  {
    const std::string path = entry->path().string();
    const auto name = NameOfResult(entry->path().filename().string());
    if (!name || fs::file_size(path, none) == 0 || !taken_.insert(path).second || !Settle(*name)) continue;
    RunOutcome& outcome = outcomes.emplace_back();
    try
    {
      const std::vector<char> content = ReadWholeFile(path);
      ByteReader bytes(content);
      outcome = ReadFields<RunOutcome>(bytes);
    }
    catch (const std::runtime_error& error)
    {
      outcome = {};
      outcome.exit_code = kExitProcessFailed;
      outcome.failure = fmt::format("its result is damaged: {}", error.what());
    }
    outcome.name = *name;
  }
  return outcomes;
}

bool SlurmBatch::Settle(const RunName& name)
{
  for (auto task = outstanding_.begin(); task != outstanding_.end(); ++task)
  {
    if (std::erase(task->second, name) == 0) continue;
    if (task->second.empty()) outstanding_.erase(task);
    return true;
  }
  return false;
}

void SlurmBatch::RemoveTaken()
{
  std::error_code none;
  for (const std::string& path : taken_) fs::resize_file(path, 0, none);
  taken_.clear();
}

void SlurmBatch::Remove()
{
  std::error_code none;
  // Without this file the batch counts as done, even if removing the other files fails.
  fs::remove(folder_ + "/job", none);
  fs::remove_all(folder_, none);
  rmdir(fs::path(folder_).parent_path().c_str());
}

std::string SlurmBatch::LastLineOfTask(std::size_t task) const
{
  std::ifstream file(LogOfTask(folder_, task));
  std::string last;
  for (std::string line; std::getline(file, line);)
    if (!TrimBlanks(line).empty()) last = line;
  return last.substr(0, 500);
}

void SlurmBatch::KeepLogOfTask(std::size_t task, const RunName& name) const
{
  const fs::path folder = fs::path(folder_).parent_path().parent_path() / "runs" / name.Text();
  std::error_code none;
  if (fs::file_size(LogOfTask(folder_, task), none) == 0 || none) return;
  fs::create_directories(folder, none);
  fs::copy_file(LogOfTask(folder_, task), folder / "slurm.log", fs::copy_options::overwrite_existing, none);
}

std::vector<char> SlurmBatch::ReadSetup(const std::string& folder) { return ReadWholeFile(folder + "/setup"); }

std::vector<RunOrder> SlurmBatch::ReadOrders(const std::string& folder, std::size_t task)
{
  const std::vector<char> content = ReadWholeFile(OrdersFile(folder, task));
  ByteReader bytes(content);
  std::vector<RunOrder> orders;
  for (auto count = bytes.Get<std::uint64_t>(); count > 0; --count) orders.push_back(ReadFields<RunOrder>(bytes));
  return orders;
}

bool SlurmBatch::HasResult(const std::string& folder, const RunName& name)
{
  std::error_code none;
  return fs::exists(ResultsFolder(folder) + "/" + name.Text(), none);
}

void SlurmBatch::WriteResult(const std::string& folder, const RunOutcome& outcome)
{
  ByteWriter bytes;
  WriteFields(bytes, outcome);
  WriteWhole(ResultsFolder(folder) + "/" + outcome.name.Text(), Framed(bytes.Bytes()));
}

}  // namespace swarmanoid
