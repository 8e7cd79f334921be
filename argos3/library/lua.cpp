#include <argos3/core/wrappers/lua/lua_controller.h>

namespace argos
{

CLuaController::~CLuaController() = default;

}  // namespace argos
