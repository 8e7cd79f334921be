// Pairs of conversions, compiled at -O3 with the options of the project: GCC 12 computes both at once.
#include "tests/libraries/conversions.h"

namespace swarmanoid::test
{

void ThroughFloat(const double* x, float* rounded, double* back)
{
  rounded[0] = static_cast<float>(x[0]);
  rounded[1] = static_cast<float>(x[1]);
  back[0] = rounded[0];
  back[1] = rounded[1];
}

void ThroughInt(const double* x, double* back)
{
  back[0] = static_cast<int>(x[0]);
  back[1] = static_cast<int>(x[1]);
}

}  // namespace swarmanoid::test
