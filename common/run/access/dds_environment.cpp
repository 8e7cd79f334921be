#include "common/run/access/dds_environment.h"

#include <cstdlib>
#include <string_view>

namespace swarmanoid
{
namespace
{

constexpr const char* kVariables[] = {
    "ROS_DISCOVERY_SERVER",     "ROS_SUPER_CLIENT",   "FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE",
    "FASTDDS_ENVIRONMENT_FILE", "FASTDDS_STATISTICS", "FASTDDS_BUILTIN_TRANSPORTS"};
constexpr const char* kNoProfiles = "SKIP_DEFAULT_XML";  // set to 1, no file of the working folder is read

std::mutex& TheMutex()
{
  static std::mutex mutex;
  return mutex;
}

}  // namespace

std::vector<std::string> DdsVariablesThatAreSet()
{
  std::vector<std::string> names;
  for (const char* name : kVariables)
    if (std::getenv(name) != nullptr) names.emplace_back(name);
  return names;
}

HiddenDdsVariables::HiddenDdsVariables() : lock_(TheMutex())
{
  setenv(kNoProfiles, "1", 0);  // changes nothing if it is set
  const char* kept = std::getenv(kKeepDdsVariables);
  if (kept != nullptr && std::string_view(kept) == "1") return;
  if (const std::string value = std::getenv(kNoProfiles); value != "1")
  {
    hidden_.emplace_back(kNoProfiles, value);
    setenv(kNoProfiles, "1", 1);
  }
  for (const std::string& name : DdsVariablesThatAreSet())
  {
    hidden_.emplace_back(name, std::getenv(name.c_str()));
    unsetenv(name.c_str());
  }
}

HiddenDdsVariables::~HiddenDdsVariables()
{
  for (const auto& [name, value] : hidden_) setenv(name.c_str(), value.c_str(), 1);
}

}  // namespace swarmanoid
