// Loop functions that look into scripts, grippers and the experiment file. Not linked to anything: names are found when
// it is loaded.
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/core/wrappers/lua/lua_controller.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/simulator/entities/gripper_equipped_entity.h>

using namespace argos;

class CReader : public CLoopFunctions
{
public:
  void Init(TConfigurationNode&) override
  {
    TConfigurationNode& root = GetSimulator().GetConfigurationRoot();
    UInt32 seed = 0;
    GetNodeAttribute(GetNode(GetNode(root, "framework"), "experiment"), "random_seed", seed);
    LOG << "file: " << root.Value() << " " << seed << std::endl;
  }
  void PostStep() override
  {
    auto& robot = *any_cast<CFootBotEntity*>(GetSpace().GetEntitiesByType("foot-bot")["fb"]);
    auto& script = dynamic_cast<CLuaController&>(robot.GetControllableEntity().GetController());
    lua_State* lua = script.GetLuaState();
    lua_getglobal(lua, "robot");
    lua_getfield(lua, -1, "steps");
    const Real steps = lua_tonumber(lua, -1);
    lua_pop(lua, 1);
    lua_pushnumber(lua, steps + 100);
    lua_setfield(lua, -2, "steps");
    lua_pop(lua, 1);
    const CGripperEquippedEntity gripper = robot.GetComponent<CGripperEquippedEntity>("gripper");
    LOG << "step " << GetSpace().GetSimulationClock() << ": " << steps << " "
        << (gripper.IsGripping() ? gripper.GetGrippedEntity().GetParent().GetId() : "nothing") << std::endl;
  }
};

REGISTER_LOOP_FUNCTIONS(CReader, "reader")
