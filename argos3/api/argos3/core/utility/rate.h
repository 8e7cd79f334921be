// CRate: keeps a loop of a program at a rate, by the clock of the machine. What controllers of a simulation do should
// not depend on it.
#pragma once

#include <argos3/core/utility/datatypes/datatypes.h>

namespace argos
{

class CRate
{
public:
  // Times a second.
  CRate(Real rate) { SetRate(rate); }
  Real GetRate() const { return rate_; }
  // The period begins now.
  void SetRate(Real rate);
  // Since the latest Sleep.
  UInt64 ElapsedUS() const;
  Real ElapsedS() const { return static_cast<Real>(ElapsedUS()) * 1e-6; }
  // To the end of the period; says so on LOGERR if that has passed.
  void Sleep();

private:
  Real rate_ = 1;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace argos
