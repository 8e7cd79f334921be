// CLoopFunctions: code around the steps of an experiment. It runs at the space server.
#pragma once

#include <argos3/core/simulator/simulator.h>
#include <argos3/core/simulator/space/space.h>
#include <argos3/core/utility/configuration/base_configurable_resource.h>
#include <argos3/core/utility/datatypes/color.h>
#include <argos3/core/utility/math/quaternion.h>
#include <argos3/core/utility/math/vector2.h>
#include <argos3/core/utility/math/vector3.h>
#include <argos3/core/utility/plugins/factory.h>

namespace argos
{

class CLoopFunctions : public CBaseConfigurableResource
{
public:
  // Gets <loop_functions>. Controllers exist already, and their Init was called.
  void Init(TConfigurationNode&) override {}
  void Reset() override {}
  void Destroy() override {}
  // Called after the physics of a tick and before the controllers.
  virtual void PreStep() {}
  // Called after the controllers. Entities are where the controllers saw them.
  virtual void PostStep() {}
  // Called before the first step.
  virtual void PreExperiment() {}
  // Called after the last step. It may still change entities.
  virtual void PostExperiment() {}
  // Returns true to end the experiment; called after each step.
  virtual bool IsExperimentFinished() { return false; }
  // Returns the colour of a point of the floor, in metres in the frame of the arena.
  virtual CColor GetFloorColor(const CVector2&) { return CColor::WHITE; }

  CSimulator& GetSimulator() { return CSimulator::GetInstance(); }
  CSpace& GetSpace() { return CSimulator::GetInstance().GetSpace(); }

  void IterateOverControllableEntities(const CSpace::TControllableEntityIterCBType& call) const
  {
    CSimulator::GetInstance().GetSpace().IterateOverControllableEntities(call);
  }

  // Moves an entity. Returns false and moves nothing if it would touch another body. Throws CARGoSException for an
  // entity that cannot move.
  virtual bool MoveEntity(CEmbodiedEntity& entity, const CVector3& position, const CQuaternion& orientation,
                          bool check_only = false, bool ignore_collisions = false);
  // Moves a light.
  virtual void MoveEntity(CPositionalEntity& entity, const CVector3& position, const CQuaternion& orientation);
  // Adds an entity that the experiment file declares and that was removed, or a robot that the file does not declare.
  // Such robots need a run of one process; GetController() works at once. The simulator takes ownership. Throws
  // CARGoSException for a box, cylinder or light that the file does not declare, and if there are too many robots.
  virtual void AddEntity(CEntity& entity);
  // Removes an entity from the arena by its id. Throws CARGoSException for an entity that is not in it or cannot be
  // removed.
  virtual void RemoveEntity(const std::string& id);
  // Removes an entity in the same way. The object stays valid.
  virtual void RemoveEntity(CEntity& entity);
};

}  // namespace argos

#define REGISTER_LOOP_FUNCTIONS(CLASS, LABEL)                                                           \
  namespace                                                                                             \
  {                                                                                                     \
  const argos::SLoopFunctionsRegistration argos3_registration_of_##CLASS(LABEL,                         \
                                                                         []() -> argos::CLoopFunctions* \
                                                                         { return new CLASS; });        \
  }
