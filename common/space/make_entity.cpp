#include "common/space/make_entity.h"

namespace swarmanoid
{

EntityPointer MakeEntity(std::pmr::memory_resource& memory, CSwarmanoidSpace& space, std::uint32_t index,
                         const EntityConfiguration& configuration, std::uint32_t first_slot)
{
  const auto make = [&]<class Entity>(std::type_identity<Entity>) -> EntityPointer
  {
    return EntityPointer(
        std::pmr::polymorphic_allocator<>(&memory).new_object<Entity>(space, index, configuration, first_slot));
  };
  switch (configuration.kind)
  {
    case EntityKind::kFootbot:
      return make(std::type_identity<CFootBotEntity>{});
    case EntityKind::kHandbot:
      return make(std::type_identity<CHandBotEntity>{});
    case EntityKind::kEyebot:
      return make(std::type_identity<CEyeBotEntity>{});
    case EntityKind::kBlock:
    case EntityKind::kWall:
      return make(std::type_identity<CBlockEntity>{});
    case EntityKind::kCylindricPrey:
      return make(std::type_identity<CCylindricPreyEntity>{});
    case EntityKind::kLightBulb:
      return make(std::type_identity<CLightBulbEntity>{});
    case EntityKind::kSoundSource:
      return make(std::type_identity<CSoundSourceEntity>{});
    case EntityKind::kGroundPatch:
    case EntityKind::kChargingStation:
      return make(std::type_identity<CGroundPatchEntity>{});
    default:
      break;
  }
  if (IsRobot(configuration.kind)) return make(std::type_identity<CRobotEntity>{});
  return make(std::type_identity<CSwarmanoidSpaceEntity>{});
}

}  // namespace swarmanoid
