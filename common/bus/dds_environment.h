// The environment variables that Fast DDS reads (2.9 and 3.1). They are meant for other programs, such as those of ROS
// 2, and would change how the processes of a run find each other: their bus is made without them, unless
// SWARMANOID_DDS_ENVIRONMENT is 1.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace swarmanoid
{

inline constexpr const char* kKeepDdsVariables = "SWARMANOID_DDS_ENVIRONMENT";

// Returns the names of the variables that are set.
std::vector<std::string> DdsVariablesThatAreSet();

// Hides the variables while it lives, so that participants that others make in this process see them again. For one
// thread that makes a participant.
class HiddenDdsVariables
{
public:
  HiddenDdsVariables();
  ~HiddenDdsVariables();
  HiddenDdsVariables(const HiddenDdsVariables&) = delete;
  HiddenDdsVariables& operator=(const HiddenDdsVariables&) = delete;

private:
  std::vector<std::pair<std::string, std::string>> hidden_;  // name and value
};

}  // namespace swarmanoid
