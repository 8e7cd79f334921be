// The mistakes found while an experiment file is read. Used by the reader only.
#pragma once

#include <string>
#include <vector>

#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

class Diagnostics
{
public:
  void Add(const SourceLocation& location, std::string message);
  bool Empty() const { return count_ == 0; }
  std::size_t Count() const { return count_; }
  // All of them in the order of the file; beyond a thousand, a last one says how many more there are.
  std::vector<Diagnostic> Take();

private:
  std::vector<Diagnostic> found_;
  std::size_t count_ = 0;
};

}  // namespace swarmanoid
