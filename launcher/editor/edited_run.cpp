#include "launcher/editor/edited_run.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

#include "launcher/system/installation.h"
#include "simulation/run_folder.h"

namespace swarmanoid
{

namespace fs = std::filesystem;

void EditedRun::Start(const std::string& name, const std::string& text, const Pace& pace)
{
  const fs::path file = fs::path(folder_) / "run.xml";
  std::ofstream stream(file, std::ios::binary);
  if (!(stream << text) || !stream.flush())
    throw std::runtime_error(fmt::format("cannot write '{}': {}", file.string(), std::strerror(errno)));
  next_ = {file.string(), "--real-time", fmt::format("{}", pace.real_time_factor)};
  if (pace.is_paused) next_->emplace_back("--paused");
  next_name_ = name;
  failure_.clear();
  if (run_)
    run_->Stop();
  else
    StartNext();
}

void EditedRun::StartNext()
{
  const std::vector<std::string> options = *std::exchange(next_, std::nullopt);
  const RunFolder folder("", next_name_);
  folder.BecomeLatest();
  output_ = folder.Path();
  run_ = std::make_unique<StartedRun>(OwnProgram(), options, output_);
}

void EditedRun::End()
{
  next_.reset();
  failure_.clear();
  if (run_) run_->Stop();
}

bool EditedRun::Look()
{
  const std::string failure = failure_;
  if (run_ && !run_->Look())
  {
    if (!run_->IsStopping()) failure_ = run_->Errors().empty() ? "the run has ended" : run_->Errors();
    run_.reset();
    std::error_code none;
    fs::remove(output_, none);  // the folder of a run that has not begun is empty
  }
  if (!run_ && next_) try
    {
      StartNext();
    }
    catch (const std::runtime_error& error)
    {
      failure_ = error.what();
    }
  const bool changed = GetPhase() != told_ || failure != failure_;
  told_ = GetPhase();
  return changed;
}

EditedRun::Phase EditedRun::GetPhase() const
{
  if (next_) return Phase::kStarting;
  if (!run_) return Phase::kNone;
  if (run_->IsStopping()) return Phase::kEnding;
  return run_->Url().empty() ? Phase::kStarting : Phase::kRunning;
}

const std::string& EditedRun::Url() const
{
  static const std::string none;
  return GetPhase() == Phase::kRunning ? run_->Url() : none;
}

}  // namespace swarmanoid
