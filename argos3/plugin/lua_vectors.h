// vector2, vector3 and quaternion of scripts: values of CVector2, CVector3 and CQuaternion with the operators, methods
// and elements of ARGoS3. As in ARGoS3, normalize, cross and rotate change the value itself.
#pragma once

#include <argos3/core/utility/math/quaternion.h>

#include <lua.hpp>

namespace swarmanoid::argos3
{

// Adds the three global functions that make values. The table of globals must be on top of the stack.
void AddVectors(lua_State* lua);
// Adds a new value as an element of the table on top of the stack.
void SetVector(lua_State* lua, const char* name, const argos::CVector3& value);
void SetQuaternion(lua_State* lua, const char* name, const argos::CQuaternion& value);

}  // namespace swarmanoid::argos3
