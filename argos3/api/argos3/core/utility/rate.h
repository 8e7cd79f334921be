// CRate: keeps a loop of a program at a rate, by the clock of the machine. Simulated controllers should not depend on
// it.
#pragma once

#include <argos3/core/utility/datatypes/datatypes.h>

namespace argos
{

class CRate
{
public:
  // `rate` is in times a second.
  CRate(Real rate) { SetRate(rate); }
  Real GetRate() const { return rate_; }
  // Starts the period now.
  void SetRate(Real rate);
  // Returns the time since the last Sleep.
  UInt64 ElapsedUS() const;
  Real ElapsedS() const { return static_cast<Real>(ElapsedUS()) * 1e-6; }
  // Waits until the end of the period; reports on LOGERR if that has passed.
  void Sleep();

private:
  Real rate_ = 1;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace argos
