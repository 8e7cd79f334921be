// The part of a robot that has its controller.
#pragma once

#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/entity/entity.h>
#include <argos3/core/utility/math/ray3.h>

namespace argos
{

class CControllableEntity : public CEntity
{
public:
  using CEntity::CEntity;
  // In a run of one process, from the first step on: Init of loop functions too. Throws CARGoSException otherwise, and
  // for a robot without a controller. Of a robot that loop functions made, before AddEntity too.
  CCI_Controller& GetController();
  const CCI_Controller& GetController() const { return const_cast<CControllableEntity*>(this)->GetController(); }
  // One that is disabled makes no control steps, and its actuators go on as they were told last. In a run of one
  // process; throws CARGoSException otherwise.
  void SetEnabled(bool enabled) override;
  // Of its devices and its controller, if it has one in this process.
  void Reset() override;
  std::string GetTypeDescription() const override { return "controller"; }
};

}  // namespace argos
