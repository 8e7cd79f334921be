#include "common/experiment/experiment.h"

#include <algorithm>
#include <charconv>

namespace swarmanoid
{
std::optional<EngineSplit> EngineSplit::Parse(std::string_view text)
{
  const auto number = [](std::string_view digits) -> std::optional<unsigned>
  {
    unsigned value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool is_whole = error == std::errc() && end == digits.data() + digits.size();
    return is_whole && value >= 1 && value <= kMostRegions ? std::optional(value) : std::nullopt;
  };
  const std::size_t sign = text.find('x');
  if (sign == std::string_view::npos)
  {
    const auto regions = number(text);
    return regions ? std::optional(EngineSplit{*regions, 0}) : std::nullopt;
  }
  const auto columns = number(text.substr(0, sign));
  const auto rows = number(text.substr(sign + 1));
  if (!columns || !rows || *columns * *rows > kMostRegions) return std::nullopt;
  return EngineSplit{*columns * *rows, *columns};
}

double UsualLimit(const Vector3& arena_size) { return std::max(100.0, 10 * arena_size.maxCoeff()); }

Pose WaitingPose(const EntityConfiguration& entity, std::size_t index)
{
  // Waiting entities are twenty metres apart along x. They are far in y, too, for engines whose plane is perpendicular
  // to x.
  const double height = IsFreeBox(entity.kind) ? entity.size.z() / 2 : 0;
  return {{-1e5 - 20.0 * static_cast<double>(index), -1.65e5, height}, Quaternion::Identity()};
}

const ControllerConfiguration* Experiment::FindController(const std::string& id) const
{
  const auto found = std::find_if(controllers.begin(), controllers.end(),
                                  [&](const ControllerConfiguration& controller) { return controller.id == id; });
  return found == controllers.end() ? nullptr : &*found;
}

bool Experiment::HasGuards() const
{
  return std::any_of(controllers.begin(), controllers.end(),
                     [](const ControllerConfiguration& controller) { return controller.IsGuarded(); });
}

}  // namespace swarmanoid
