#include "common/space/make_entity.h"

namespace swarmanoid
{

std::unique_ptr<CSwarmanoidSpaceEntity> MakeEntity(CSwarmanoidSpace& space, std::uint32_t index,
                                                   const EntityConfiguration& configuration, std::uint32_t first_slot)
{
  switch (configuration.kind)
  {
    case EntityKind::kFootbot:
      return std::make_unique<CFootBotEntity>(space, index, configuration, first_slot);
    case EntityKind::kHandbot:
      return std::make_unique<CHandBotEntity>(space, index, configuration, first_slot);
    case EntityKind::kEyebot:
      return std::make_unique<CEyeBotEntity>(space, index, configuration, first_slot);
    case EntityKind::kBlock:
    case EntityKind::kWall:
      return std::make_unique<CBlockEntity>(space, index, configuration, first_slot);
    case EntityKind::kCylindricPrey:
      return std::make_unique<CCylindricPreyEntity>(space, index, configuration, first_slot);
    case EntityKind::kLightBulb:
      return std::make_unique<CLightBulbEntity>(space, index, configuration, first_slot);
    case EntityKind::kSoundSource:
      return std::make_unique<CSoundSourceEntity>(space, index, configuration, first_slot);
    case EntityKind::kGroundPatch:
      return std::make_unique<CGroundPatchEntity>(space, index, configuration, first_slot);
    default:
      break;
  }
  if (IsRobot(configuration.kind)) return std::make_unique<CRobotEntity>(space, index, configuration, first_slot);
  return std::make_unique<CSwarmanoidSpaceEntity>(space, index, configuration, first_slot);
}

}  // namespace swarmanoid
