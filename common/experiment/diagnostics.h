// Collects the mistakes found while an experiment file is read. Only the reader uses it.
#pragma once

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

class Diagnostics
{
public:
  // Adds a mistake. `message`: the mistake, the limit and the cure.
  void Add(const SourceLocation& location, std::string message);
  bool Empty() const { return count_ == 0; }
  std::size_t Count() const { return count_; }
  // Notes that the kind or entity of that name is missing because of a mistake that is reported. Its absence elsewhere
  // follows from that mistake and is not reported again.
  void Lose(std::string name)
  {
    if (!name.empty()) lost_.insert(std::move(name));
  }
  // Returns whether the name was lost; entities of a lost <distribute> or <reserve> "fb" have names such as "fb_3".
  bool IsLost(std::string_view name) const;
  template <class Fits>
  bool HasLost(const Fits& fits) const
  {
    return std::any_of(lost_.begin(), lost_.end(), fits);
  }
  // Returns all mistakes. Those in other files that the experiment names, such as URDF files, come first. The
  // experiment's own follow in the order of the file. Beyond a thousand, a last entry counts the rest.
  std::vector<Diagnostic> Take(const std::string& experiment_file = "");

private:
  std::vector<Diagnostic> found_;
  std::size_t count_ = 0;
  std::set<std::string, std::less<>> lost_;
};

}  // namespace swarmanoid
