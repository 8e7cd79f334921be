// The Kilobot, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>
#include <argos3/plugins/robots/kilobot/simulator/kilobot_measures.h>
#include <argos3/plugins/simulator/entities/wheeled_entity.h>

namespace argos
{

class CKilobotEntity : public CRobotWithController
{
public:
  explicit CKilobotEntity(const std::string& id) : CRobotWithController(id, kLeds) { AddComponent(wheels_); }
  CWheeledEntity& GetWheeledEntity() { return wheels_; }
  // Makes a Kilobot for AddEntity. The range is that of the file's robots with the same controller.
  CKilobotEntity(const std::string& id, const std::string& controller, const CVector3& position = CVector3(),
                 const CQuaternion& orientation = CQuaternion(), Real communication_range = 0.1);
  std::string GetTypeDescription() const override { return "kilobot"; }

private:
  CWheeledEntity wheels_{this, KILOBOT_INTERPIN_DISTANCE, 0.001};
  static constexpr unsigned kLeds = 1;
};

}  // namespace argos
