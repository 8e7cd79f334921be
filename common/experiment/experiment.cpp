#include "common/experiment/experiment.h"

#include <algorithm>
#include <array>

namespace swarmanoid
{
namespace
{

struct KindNames
{
  std::string_view table;
  std::string_view tag;
};

// In the order of EntityKind.
constexpr std::array<KindNames, 11> kNames{{{"Footbot", "footbot"},
                                            {"Handbot", "handbot"},
                                            {"Eyebot", "eyebot"},
                                            {"Block", "block"},
                                            {"CylindricPrey", "cylindric_prey"},
                                            {"LightBulb", "light_bulb"},
                                            {"SoundSource", "sound_source"},
                                            {"GroundPatch", "ground_patch"},
                                            {"Hole", "hole"},
                                            {"Wall", "wall"},
                                            {"Terrain", "terrain"}}};

template <class T>
const T* FindById(const std::vector<T>& all, const std::string& id)
{
  const auto found = std::find_if(all.begin(), all.end(), [&](const T& one) { return one.id == id; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

bool IsBodiless(EntityKind kind)
{
  return kind == EntityKind::kLightBulb || kind == EntityKind::kSoundSource || kind == EntityKind::kGroundPatch;
}

double UsualLimit(const Vector3& arena_size) { return std::max(100.0, 10 * arena_size.maxCoeff()); }

Pose WaitingPose(const EntityConfiguration& entity, std::size_t index)
{
  // Twenty metres apart along x. Far in y, too, for engines whose plane is perpendicular to x.
  const double height = entity.kind == EntityKind::kBlock ? entity.size.z() / 2 : 0;
  return {{-1e5 - 20.0 * static_cast<double>(index), -1.65e5, height}, Quaternion::Identity()};
}

const ControllerConfiguration* Experiment::FindController(const std::string& id) const
{
  return FindById(controllers, id);
}

const EngineConfiguration* Experiment::FindEngine(const std::string& id) const { return FindById(engines, id); }

bool IsRobot(EntityKind kind)
{
  return kind == EntityKind::kFootbot || kind == EntityKind::kHandbot || kind == EntityKind::kEyebot;
}

std::string_view TableName(EntityKind kind) { return kNames[static_cast<std::size_t>(kind)].table; }

std::string_view TagName(EntityKind kind) { return kNames[static_cast<std::size_t>(kind)].tag; }

}  // namespace swarmanoid
