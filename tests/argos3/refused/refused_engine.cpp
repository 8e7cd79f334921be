#include <argos3/core/simulator/physics_engine/physics_engine.h>

using namespace argos;

class CMine : public CPhysicsEngine
{
};

REGISTER_PHYSICS_ENGINE(CMine, "mine", "A user", "1.0", "An engine.", "An engine.", "Usable");
