#include "common/experiment/experiment.h"

#include <algorithm>

namespace swarmanoid
{
namespace
{

template <class T>
const T* FindById(const std::vector<T>& all, const std::string& id)
{
  const auto found = std::find_if(all.begin(), all.end(), [&](const T& one) { return one.id == id; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

double UsualLimit(const Vector3& arena_size) { return std::max(100.0, 10 * arena_size.maxCoeff()); }

Pose WaitingPose(const EntityConfiguration& entity, std::size_t index)
{
  // Twenty metres apart along x. Far in y, too, for engines whose plane is perpendicular to x.
  const double height = IsFreeBox(entity.kind) ? entity.size.z() / 2 : 0;
  return {{-1e5 - 20.0 * static_cast<double>(index), -1.65e5, height}, Quaternion::Identity()};
}

const ControllerConfiguration* Experiment::FindController(const std::string& id) const
{
  return FindById(controllers, id);
}

bool Experiment::HasGuards() const
{
  return std::any_of(controllers.begin(), controllers.end(),
                     [](const ControllerConfiguration& controller) { return controller.IsGuarded(); });
}

const EngineConfiguration* Experiment::FindEngine(const std::string& id) const { return FindById(engines, id); }

}  // namespace swarmanoid
