#include <gtest/gtest.h>

#include <vector>

#include "common/math/elementary.h"
#include "common/math/random.h"

namespace swarmanoid
{
namespace
{

TEST(Atan2Each, GivesTheBitsOfAtan2)
{
  std::vector<double> x{0, 1, -1, 0, 0, 1, -1, 1, -1, 1e-300}, y{0, 0, 0, 1, -1, 1, 1, -1, -1, 1e300};
  RandomStream random(1, 2, 3, 4);
  for (int i = 0; i < 10001; ++i)
  {
    x.push_back(random.Uniform(-1, 1));
    y.push_back(random.Uniform(-1, 1) * (i % 3 == 0 ? 0.1 : 1));
  }
  std::vector<double> angles(x.size());
  Atan2Each(y, x, angles);
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_EQ(angles[i], Atan2(y[i], x[i])) << y[i] << " " << x[i];
}

}  // namespace
}  // namespace swarmanoid
