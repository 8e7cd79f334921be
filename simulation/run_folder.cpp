#include "simulation/run_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/configuration/output_file.h"
#include "common/version/version.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

std::string LocalTime(const char* format)
{
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[64];
  return {text, std::strftime(text, sizeof text, format, &local)};
}

std::string HostName()
{
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

// Returns the processor's name as the kernel reports it, or an empty text.
std::string ProcessorName()
{
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.find(": ") + 2, line.size()));
  return {};
}

[[noreturn]] void Refuse(const std::string& path, const std::string& reason)
{
  throw RunFolderError(
      fmt::format("cannot make the run folder '{}': {}; name another one with --output", path, reason));
}

// Makes a requested folder. It must be new or empty, so that a mistake of the user never overwrites an old run.
std::string MakeAsked(const std::string& asked)
{
  std::error_code error;
  fs::create_directories(asked, error);
  if (error) Refuse(asked, error.message());
  if (!fs::is_directory(asked)) Refuse(asked, "it is no folder");
  if (const std::string mistake = OutputFolderMistake(asked); !mistake.empty()) Refuse(asked, mistake);
  if (!fs::is_empty(asked, error)) Refuse(asked, "it is not empty");
  return asked;
}

std::string MakeNew(const std::string& experiment)
{
  std::error_code error;
  fs::create_directories("runs", error);
  if (error) Refuse("runs", error.message());
  if (const std::string mistake = OutputFolderMistake("runs"); !mistake.empty()) Refuse("runs", mistake);
  const std::string stem = fmt::format("runs/{}-{}", experiment, LocalTime("%Y%m%d-%H%M%S"));
  for (int number = 1;; ++number)
  {
    const std::string path = number == 1 ? stem : fmt::format("{}-{}", stem, number);
    if (mkdir(path.c_str(), 0777) == 0) return path;
    if (errno != EEXIST) Refuse(path, std::strerror(errno));
  }
}

}  // namespace

RunFolder::RunFolder(const std::string& asked, const std::string& experiment)
    : path_(fs::absolute(asked.empty() ? MakeNew(experiment) : MakeAsked(asked)).lexically_normal()),
      is_under_runs_(asked.empty())
{
}

void RunFolder::BecomeLatest() const
{
  if (!is_under_runs_) return;
  const fs::path path(path_), link = path.parent_path() / "latest";
  std::error_code error;
  if (fs::exists(fs::symlink_status(link, error)) && !fs::is_symlink(link, error)) return;
  // A renamed link replaces the old one at once, so that other runs never miss it.
  const fs::path draft = path.parent_path() / fmt::format(".latest-{}", getpid());
  fs::create_symlink(path.filename(), draft, error);
  if (!error) fs::rename(draft, link, error);
  if (error) fs::remove(draft, error);
}

void RunFolder::Write(const std::string& name, const std::string& text) const
{
  const std::string path = File(name);
  const std::string draft = path + ".new";
  std::FILE* file = OpenOutputFile(draft);
  bool good = file != nullptr;
  if (file != nullptr)
  {
    good = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    good = std::fclose(file) == 0 && good;
  }
  if (good) good = std::rename(draft.c_str(), path.c_str()) == 0;
  if (good) return;
  const std::string reason = std::strerror(errno);
  std::remove(draft.c_str());
  throw RunFolderError(fmt::format("cannot write '{}': {}", path, reason));
}

std::string Manifest::Text() const
{
  nlohmann::ordered_json json;
  json["swarmanoid"] = Version();
  json["revision"] = GitRevision();
  json["host"] = HostName();
  json["processor"] = ProcessorName();
  json["libraries"] = nlohmann::ordered_json::object();
  for (const auto& [name, build] : libraries) json["libraries"][name] = build;
  json["experiment"] = experiment;
  json["file"] = file;
  json["experiment_hash"] = fmt::format("{:016x}", experiment_hash);
  json["seed"] = seed;
  json["command"] = command;
  json["started"] = started;
  if (!hash_log.empty()) json["hash_log"] = hash_log;
  if (!restored_from.empty()) json["restored_from"] = restored_from;
  if (branch_of)
    json["branch_of"] = {{"run", branch_of->run},
                         {"tick", branch_of->tick},
                         {"state_hash", fmt::format("{:016x}", branch_of->hash)},
                         {"first_tick", branch_of->first_tick},
                         {"changes", branch_of->changes}};
  if (reset_of)
    json["reset_of"] = {{"run", reset_of->run},
                        {"tick", reset_of->tick},
                        {"paused", reset_of->paused},
                        {"real_time_factor", reset_of->real_time_factor}};
  if (domain) json["domain"] = *domain;
  json["processes"] = nlohmann::ordered_json::array();
  for (const auto& [name, log] : processes) json["processes"].push_back({{"name", name}, {"log", log}});
  if (!ended.empty()) json["ended"] = ended;
  if (exit_code) json["exit_code"] = *exit_code;
  if (ticks)
  {
    json["ticks"] = *ticks;
    json["wall_s"] = wall_s;
    json["real_time_factor"] = real_time_factor;
  }
  if (threads > 0)
  {
    json["threads"] = threads;
    json["shared_ticks"] = shared_ticks;
  }
  if (state_hash) json["state_hash"] = fmt::format("{:016x}", *state_hash);
  if (!failure.empty()) json["failure"] = failure;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

nlohmann::json ReadManifest(const std::string& folder)
{
  std::ifstream file(folder + "/manifest.json");
  return nlohmann::json::parse(file);
}

std::string TimeStamp() { return LocalTime("%Y-%m-%dT%H:%M:%S%z"); }

std::uint64_t TextHash(const std::string& text) { return XXH3_64bits(text.data(), text.size()); }

}  // namespace swarmanoid
