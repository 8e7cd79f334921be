// Decides whether a list of neighbours is worth keeping from step to step (a Verlet list). A list that lasts for few
// steps costs more than it saves; then none is made for a while. The owner of the list knows when it becomes invalid:
// the kinematic world's pairs, and the sensors' MovedSince.
#pragma once

#include <cstdint>

namespace swarmanoid
{

class VerletLifetime
{
public:
  // Call it first in each step. Returns false if this step uses no list.
  bool BeginStep()
  {
    if (pause_ > 0)
    {
      --pause_;
      return false;
    }
    ++age_;
    return true;
  }
  bool HasList() const { return has_list_; }
  // Returns the steps since the list was made.
  std::uint32_t Age() const { return age_; }
  // Call it if no list exists or it is invalid. Returns true if a list is to be made now, false if the last one did not
  // pay.
  bool Renew()
  {
    if (has_list_ && age_ < kFewest)
    {
      Pause();
      return false;
    }
    has_list_ = true;
    age_ = 0;
    return true;
  }
  // Uses no list for some steps.
  void Pause()
  {
    has_list_ = false;
    pause_ = kPause;
  }

private:
  static constexpr std::uint32_t kFewest = 4;  // the least age at which a list pays
  static constexpr std::uint32_t kPause = 64;

  bool has_list_ = false;
  std::uint32_t age_ = 0;
  std::uint32_t pause_ = 0;  // the remaining steps without a list
};

}  // namespace swarmanoid
