// The setup that another process needs to compute the same runs as this machine: the same Swarmanoid, experiment files
// and libraries. It is sent and compared before the first run.
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/design/design.h"

namespace swarmanoid
{

// A machine cannot take part. what() states the difference, as seen from the machine of the study, and the cure.
class StudyRefused : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// Returns the setup of this machine as bytes.
std::vector<char> SetupOf(const Study& study, const Design& design);

// Returns the study of a setup if this machine has the same; then all plug-ins of its runs are loaded. Throws
// StudyRefused.
std::unique_ptr<Study> TakeUp(std::span<const char> setup);

// Returns the name of this machine.
std::string NameOfThisHost();

}  // namespace swarmanoid
