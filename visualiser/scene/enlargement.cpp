#include "visualiser/scene/enlargement.h"

#include <fmt/format.h>

#include <algorithm>

namespace swarmanoid
{
namespace
{

constexpr float kMost = 8;
constexpr float kLeastTold = 1.2F;

}  // namespace

float Enlargement(float width, float least_width)
{
  return std::clamp(least_width / std::max(width, 1e-6F), 1.0F, kMost);
}

std::string EnlargementText(float enlargement)
{
  return enlargement < kLeastTold ? "" : fmt::format("robots up to {:.2g} times as wide", enlargement);
}

}  // namespace swarmanoid
