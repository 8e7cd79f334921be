// What a process elsewhere has to have so that its runs are those of this machine: the same Swarmanoid, experiment
// files and libraries. Told before the first run, and compared there.
#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/design.h"

namespace swarmanoid
{

// A machine cannot take part. what() says what differs, in the words of somebody who looks at it from outside, and the
// cure.
class StudyRefused : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// Of this machine, as bytes.
std::vector<char> SetupOf(const Study& study, const Design& design);

// The study of a setup, if this machine has the same; all plug-ins of its runs are loaded then. Throws StudyRefused.
std::unique_ptr<Study> TakeUp(std::span<const char> setup);

// The name of this machine.
std::string NameOfThisHost();

}  // namespace swarmanoid
