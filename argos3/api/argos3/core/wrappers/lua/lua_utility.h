// Includes CLuaController.
#pragma once

#include <argos3/core/wrappers/lua/lua_controller.h>
