#include "visualiser/past_inside.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

// Whoever scrubs along the timeline asks for every tick on the way.
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

std::string Program(const std::string& run_folder)
{
  const char* program = std::getenv(kCommandVariable);
  return program != nullptr && IsOurs(run_folder) ? program : "";
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

// A program whose two outputs are read while it runs. Killed at its end.
class ReadProgram
{
public:
  explicit ReadProgram(std::vector<std::string> words)
  {
    std::array<std::array<int, 2>, 2> pipes{};
    for (std::array<int, 2>& ends : pipes)
      if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe can be made");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, pipes[0][1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, pipes[1][1], STDERR_FILENO);
    // Sockets of this process that it kept would be taken after its end.
    posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    const int error = posix_spawn(&pid_, arguments[0], &files, &attributes, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    for (std::size_t k = 0; k < pipes.size(); ++k)
    {
      ends_[k] = pollfd{pipes[k][0], POLLIN, 0};
      close(pipes[k][1]);
    }
    if (error == 0) return;
    pid_ = -1;
    Close();
    throw std::runtime_error(fmt::format("cannot start '{}': {}", words[0], std::strerror(error)));
  }
  ~ReadProgram()
  {
    if (pid_ > 0 && !ended_)
    {
      kill(pid_, SIGKILL);
      waitpid(pid_, &status_, 0);
    }
    Close();
  }
  ReadProgram(const ReadProgram&) = delete;
  ReadProgram& operator=(const ReadProgram&) = delete;

  // False once it has ended and all is read.
  bool Read()
  {
    poll(ends_.data(), ends_.size(), kLook_ms);
    for (std::size_t k = 0; k < ends_.size(); ++k)
    {
      if (ends_[k].fd < 0 || ends_[k].revents == 0) continue;
      std::array<char, 65536> bytes;
      const ssize_t count = read(ends_[k].fd, bytes.data(), bytes.size());
      if (count > 0 && texts_[k].size() < kMostBytes)
        texts_[k].append(bytes.data(), static_cast<std::size_t>(count));
      else if (count == 0)
        close(std::exchange(ends_[k].fd, -1));
    }
    if (ends_[0].fd >= 0 || ends_[1].fd >= 0) return true;
    waitpid(pid_, &status_, 0);
    ended_ = true;
    return false;
  }

  bool Succeeded() const { return ended_ && WIFEXITED(status_) && WEXITSTATUS(status_) == 0; }
  const std::string& Output() const { return texts_[0]; }
  const std::string& Errors() const { return texts_[1]; }

private:
  void Close()
  {
    for (pollfd& end : ends_)
      if (end.fd >= 0) close(std::exchange(end.fd, -1));
  }

  pid_t pid_ = -1;
  bool ended_ = false;
  int status_ = 0;
  std::array<pollfd, 2> ends_{};
  std::array<std::string, 2> texts_;
};

}  // namespace

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

PastInside::PastInside(const Experiment& experiment, std::string run_folder, Answered answered)
    : experiment_(experiment),
      run_folder_(std::move(run_folder)),
      program_(Program(run_folder_)),
      answered_(std::move(answered)),
      thread_([this] { Work(); })
{
}

PastInside::~PastInside()
{
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
    changed_.notify_all();
  }
  thread_.join();
}

void PastInside::Ask(std::uint64_t client, const LookBackRequest& request)
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

void PastInside::Forget(std::uint64_t client)
{
  const std::lock_guard lock(mutex_);
  wanted_.erase(client);
  changed_.notify_all();
}

bool PastInside::IsWanted(std::uint64_t client, std::uint64_t number)
{
  const std::lock_guard lock(mutex_);
  const auto found = wanted_.find(client);
  return !over_ && found != wanted_.end() && found->second.number == number;
}

void PastInside::Work()
{
  std::unique_lock lock(mutex_);
  while (true)
  {
    changed_.wait(lock, [this] { return over_ || !wanted_.empty(); });
    if (over_) return;
    // Who has waited longest.
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
    const PastInsideAnswer answer = Compute(client, wanted);
    if (IsWanted(client, wanted.number)) answered_(client, answer);
    lock.lock();
    if (!is_other()) wanted_.erase(client);
  }
}

PastInsideAnswer PastInside::Compute(std::uint64_t client, const Wanted& wanted)
{
  PastInsideAnswer answer;
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
      // Controllers may have said something before.
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
