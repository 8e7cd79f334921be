// Whether it pays to remember from step to step who is near (a Verlet list): a list that lasts for few steps costs more
// than it saves, and then none is made for a while. Owned by whoever has such a list and knows when it no longer holds:
// the kinematic world's pairs, the sensors' MovedSince.
#pragma once

#include <cstdint>

namespace swarmanoid
{

class VerletLifetime
{
public:
  // First in each step. False: no list in this one.
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
  // Steps since the list was made.
  std::uint32_t Age() const { return age_; }
  // Where there is no list, or it no longer holds. True: one is made now. False: the last one did not pay.
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
  // No list for some steps.
  void Pause()
  {
    has_list_ = false;
    pause_ = kPause;
  }

private:
  static constexpr std::uint32_t kFewest = 4;  // steps that pay
  static constexpr std::uint32_t kPause = 64;

  bool has_list_ = false;
  std::uint32_t age_ = 0;
  std::uint32_t pause_ = 0;  // steps without a list that are to come
};

}  // namespace swarmanoid
