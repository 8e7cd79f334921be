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
  // Returns the controller in a run of one process, from the first step and from Init of loop functions on. For a robot
  // that loop functions made, it works before AddEntity, too. Throws CARGoSException otherwise, and for a robot without
  // a controller.
  CCI_Controller& GetController();
  const CCI_Controller& GetController() const { return const_cast<CControllableEntity*>(this)->GetController(); }
  // A disabled robot makes no control steps, and its actuators keep their last commands. Only in a run of one process;
  // throws CARGoSException otherwise.
  void SetEnabled(bool enabled) override;
  // Resets its devices and, if it is in this process, its controller.
  void Reset() override;
  // Do nothing: rays of sensors are not drawn.
  void AddCheckedRay(bool /*obstructed*/, const CRay3&) {}
  void AddIntersectionPoint(const CRay3&, Real /*t*/) {}
  std::string GetTypeDescription() const override { return "controller"; }

private:
  CCI_Controller& FindController();

  CCI_Controller* controller_ = nullptr;
  UInt64 found_at_ = 0;  // the number of changes of controllers when it was found
};

}  // namespace argos
