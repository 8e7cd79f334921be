// The environment variables that Fast DDS reads (2.9 and 3.1). They are meant for other programs, such as those of ROS
// 2, and would change how the processes of a run find each other: their bus is made without them, unless
// SWARMANOID_DDS_ENVIRONMENT is 1.
#pragma once

#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace swarmanoid
{

inline constexpr const char* kKeepDdsVariables = "SWARMANOID_DDS_ENVIRONMENT";

// Returns the names of the variables that are set.
std::vector<std::string> DdsVariablesThatAreSet();

// Hides the variables while it lives, so that participants that others make in this process see them again. Fast DDS
// then reads no file of profiles either. Only one thread at a time has such an object: making a participant is not
// safe for threads, and neither are changes of variables. Unless a user has set one of them, nothing is changed after
// the first object.
class HiddenDdsVariables
{
public:
  HiddenDdsVariables();
  ~HiddenDdsVariables();
  HiddenDdsVariables(const HiddenDdsVariables&) = delete;
  HiddenDdsVariables& operator=(const HiddenDdsVariables&) = delete;

private:
  std::unique_lock<std::mutex> lock_;
  std::vector<std::pair<std::string, std::string>> hidden_;  // name and value
};

}  // namespace swarmanoid
