// A thread serves one client at a time. It waits until the client's newest request has stood for kStands, starts the
// command, and reads its output while the request is still the newest one; otherwise the command is killed. `mutex_`
// guards the requests; the thread holds it neither while it computes nor while it calls back.
#include "visualiser/robot_playback.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "common/program/process.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

// Moving along the timeline requests every tick on the way, so a request must stand for this time.
constexpr auto kStands = 250ms;
constexpr int kLook_ms = 50;
constexpr std::size_t kMostBytes = std::size_t{64} << 20U;

bool IsOurs(const std::string& folder)
{
  struct stat found
  {
  };
  return stat(folder.c_str(), &found) == 0 && found.st_uid == geteuid();
}

std::vector<DeviceStatus> DevicesOf(const Json& list)
{
  std::vector<DeviceStatus> devices;
  for (const Json& device : list)
  {
    DeviceStatus& status = devices.emplace_back(DeviceStatus{device.at("type").get<std::string>(), {}});
    for (const Json& reading : device.at("readings"))
    {
      const Json& value = reading.at("value");
      status.readings.push_back({reading.at("name").get<std::string>(), reading.at("unit").get<std::string>(),
                                 value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>()});
    }
  }
  return devices;
}

// A program whose two outputs are read while it runs. The destructor kills it with all processes that it started.
class ReadProgram
{
public:
  explicit ReadProgram(const std::vector<std::string>& words) : process_(spawner_.Start({words[0], words, {}, {}})) {}
  ~ReadProgram()
  {
    if (ended_) return;
    spawner_.Signal(process_, SIGKILL);
    spawner_.Collect(process_);
  }
  ReadProgram(const ReadProgram&) = delete;
  ReadProgram& operator=(const ReadProgram&) = delete;

  // Returns false once the program has ended and all output is read.
  bool Read()
  {
    const std::array<FileDescriptor*, 2> files{&process_.output, &process_.errors};
    std::array<pollfd, 2> ends{};
    for (std::size_t k = 0; k < files.size(); ++k) ends[k] = pollfd{files[k]->Get(), POLLIN, 0};
    poll(ends.data(), ends.size(), kLook_ms);
    for (std::size_t k = 0; k < files.size(); ++k)
    {
      if (!files[k]->IsOpen() || ends[k].revents == 0) continue;
      std::array<char, 65536> bytes;
      const ssize_t count = read(files[k]->Get(), bytes.data(), bytes.size());
      if (count > 0 && texts_[k].size() < kMostBytes)
        texts_[k].append(bytes.data(), static_cast<std::size_t>(count));
      else if (count == 0)
        files[k]->Reset();
    }
    if (files[0]->IsOpen() || files[1]->IsOpen()) return true;
    ended_ = spawner_.Collect(process_);
    return false;
  }

  bool Succeeded() const { return ended_ && ended_->Clean(); }
  const std::string& Output() const { return texts_[0]; }
  const std::string& Errors() const { return texts_[1]; }

private:
  SystemSpawner spawner_;
  SpawnedProcess process_;
  std::optional<ProcessEnd> ended_;
  std::array<std::string, 2> texts_;
};

}  // namespace

std::string CommandFor(const std::string& run_folder)
{
  const char* program = std::getenv(kCommandVariable);
  return program != nullptr && IsOurs(run_folder) ? program : "";
}

std::vector<RobotStatus> ReadInspection(const Experiment& experiment, std::uint64_t tick, const std::string& json)
{
  std::unordered_map<std::string, std::uint32_t> numbers;
  for (std::uint32_t e = 0; e < experiment.entities.size(); ++e) numbers[experiment.entities[e].id] = e;
  std::vector<RobotStatus> robots;
  try
  {
    const Json printed = Json::parse(json);
    for (const Json& robot : printed.at("robots"))
    {
      RobotStatus& status = robots.emplace_back();
      status.entity = numbers.at(robot.at("id").get<std::string>());
      status.tick = tick;
      status.controller = robot.at("controller").get<std::string>();
      status.state = robot.at("state").get<std::string>();
      status.text = robot.at("text").get<std::string>();
      status.sensors = DevicesOf(robot.at("sensors"));
      status.actuators = DevicesOf(robot.at("actuators"));
    }
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error(fmt::format("what `swarmanoid inspect --json` printed cannot be read: {}", error.what()));
  }
  return robots;
}

RobotPlayback::RobotPlayback(const Experiment& experiment, std::string run_folder, Answered answered)
    : experiment_(experiment),
      run_folder_(std::move(run_folder)),
      program_(CommandFor(run_folder_)),
      answered_(std::move(answered)),
      thread_([this] { Work(); })
{
}

RobotPlayback::~RobotPlayback()
{
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
    changed_.notify_all();
  }
  thread_.join();
}

void RobotPlayback::Ask(std::uint64_t client, const LookBackRequest& request)
{
  Wanted wanted{request, 0};
  std::erase_if(wanted.request.entities, [this](std::uint32_t entity)
                { return entity >= experiment_.entities.size() || experiment_.entities[entity].controller.empty(); });
  const std::lock_guard lock(mutex_);
  wanted.number = ++requests_;
  wanted_.erase(client);
  if (IsPossible() && !wanted.request.entities.empty()) wanted_.emplace(client, std::move(wanted));
  changed_.notify_all();
}

void RobotPlayback::Forget(std::uint64_t client)
{
  const std::lock_guard lock(mutex_);
  wanted_.erase(client);
  changed_.notify_all();
}

bool RobotPlayback::IsWanted(std::uint64_t client, std::uint64_t number)
{
  const std::lock_guard lock(mutex_);
  const auto found = wanted_.find(client);
  return !over_ && found != wanted_.end() && found->second.number == number;
}

void RobotPlayback::Work()
{
  std::unique_lock lock(mutex_);
  while (true)
  {
    changed_.wait(lock, [this] { return over_ || !wanted_.empty(); });
    if (over_) return;
    // The client that has waited longest is served first.
    const auto first =
        std::ranges::min_element(wanted_, {}, [](const auto& client_wanted) { return client_wanted.second.number; });
    const std::uint64_t client = first->first;
    const Wanted wanted = first->second;
    const auto is_other = [&]
    {
      const auto found = wanted_.find(client);
      return over_ || found == wanted_.end() || found->second.number != wanted.number;
    };
    if (changed_.wait_for(lock, kStands, is_other)) continue;
    lock.unlock();
    const RobotPlaybackAnswer answer = Compute(client, wanted);
    if (IsWanted(client, wanted.number)) answered_(client, answer);
    lock.lock();
    if (!is_other()) wanted_.erase(client);
  }
}

RobotPlaybackAnswer RobotPlayback::Compute(std::uint64_t client, const Wanted& wanted)
{
  RobotPlaybackAnswer answer;
  answer.tick = wanted.request.tick;
  try
  {
    std::vector<std::string> words{program_, "inspect", fmt::format("{}@{}", run_folder_, answer.tick), "--json", "--"};
    for (const std::uint32_t entity : wanted.request.entities) words.push_back(experiment_.entities[entity].id);
    ReadProgram reader(words);
    while (reader.Read())
      if (!IsWanted(client, wanted.number)) return answer;
    if (!reader.Succeeded())
    {
      // Controllers may have written output before the error.
      std::string said = reader.Errors();
      while (said.ends_with('\n')) said.pop_back();
      throw std::runtime_error(said.empty() ? "`swarmanoid inspect` failed without a word"
                                            : said.substr(said.rfind('\n') + 1));
    }
    answer.robots = ReadInspection(experiment_, answer.tick, reader.Output());
  }
  catch (const std::exception& error)
  {
    answer.error = error.what();
  }
  return answer;
}

}  // namespace swarmanoid
