// The eye-bot, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>

namespace argos
{

class CEyeBotEntity : public CRobotWithController
{
public:
  explicit CEyeBotEntity(const std::string& id) : CRobotWithController(id) {}
  // For AddEntity: a robot that the experiment file declares and that is not in the arena.
  CEyeBotEntity(const std::string& id, const std::string& /*controller*/, const CVector3& position = CVector3(),
                const CQuaternion& orientation = CQuaternion())
      : CRobotWithController(id)
  {
    GetEmbodiedEntity().GetOriginAnchor().Position = position;
    GetEmbodiedEntity().GetOriginAnchor().Orientation = orientation;
  }
  std::string GetTypeDescription() const override { return "eye-bot"; }
};

}  // namespace argos
