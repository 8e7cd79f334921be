#include "visualiser/started_run.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <utility>

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostErrorBytes = 65536;
constexpr auto kStopTime = std::chrono::seconds(5);
constexpr int kLookPeriod_ms = 10;

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

ProcessCommand CommandOf(const std::string& program, const std::vector<std::string>& what, const std::string& folder)
{
  ProcessCommand command;
  command.name = "swarmanoid run";
  command.arguments = {program, "run"};
  command.arguments.insert(command.arguments.end(), what.begin(), what.end());
  command.arguments.insert(command.arguments.end(),
                           {"--output", folder, "--quiet", "--no-visualisers", "--show", "web"});
  command.signal_at_our_end = SIGTERM;
  return command;
}

}  // namespace

StartedRun::StartedRun(const std::string& program, const std::vector<std::string>& what, std::string folder)
    : folder_(std::move(folder)), process_(spawner_.Start(CommandOf(program, what, folder_)))
{
}

StartedRun::~StartedRun()
{
  Stop();
  while (Look()) poll(nullptr, 0, kLookPeriod_ms);
}

bool StartedRun::Look()
{
  if (has_ended_) return false;
  Drain(process_.output, nullptr);
  Drain(process_.errors, &errors_);
  if (url_.empty())
    if (std::ifstream file(folder_ + "/web_render.url"); !std::getline(file, url_) || file.eof()) url_.clear();
  if (IsReadable(process_.end))
  {
    spawner_.Collect(process_);
    Drain(process_.errors, &errors_);
    has_ended_ = true;
    return false;
  }
  if (stop_ > 0 && Clock::now() >= stop_due_)
  {
    spawner_.Signal(process_, stop_++ == 1 ? SIGTERM : SIGKILL);
    stop_due_ = Clock::now() + kStopTime;
  }
  return true;
}

void StartedRun::Stop()
{
  if (stop_ > 0 || has_ended_) return;
  spawner_.Signal(process_, SIGTERM);
  stop_ = 1;
  stop_due_ = Clock::now() + kStopTime;
}

std::string StartedRun::LastError() const
{
  std::string text = errors_;
  while (text.ends_with('\n')) text.pop_back();
  return text.empty() ? "the new run ended without a word" : text.substr(text.rfind('\n') + 1);
}

}  // namespace swarmanoid
