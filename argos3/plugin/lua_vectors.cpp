// The three types are full userdata of Lua: the value itself lies in the memory that Lua manages, and it has no
// destructor to be called. One set of templates serves all three; the traits of a type name its elements, and its
// operators are those of the C++ class. Values are checked by their metatable, so a wrong argument is an error in the
// script and not a wrong access.
#include "argos3/plugin/lua_vectors.h"

#include <cstring>
#include <new>
#include <type_traits>

#include "controller_host/scripts/lua/lua_stack.h"

namespace swarmanoid::argos3
{

using namespace lua;

namespace
{

using argos::CQuaternion;
using argos::CVector2;
using argos::CVector3;

// The properties of a type: its name in scripts, and a letter for each element.
template <class Type>
struct Traits;
template <>
struct Traits<CVector2>
{
  static constexpr const char* kName = "vector2";
  static constexpr const char* kElements = "xy";
  static Real Get(const CVector2& value, char element) { return element == 'x' ? value.GetX() : value.GetY(); }
  static void Set(CVector2& value, char element, Real number)
  {
    element == 'x' ? value.SetX(number) : value.SetY(number);
  }
};
template <>
struct Traits<CVector3>
{
  static constexpr const char* kName = "vector3";
  static constexpr const char* kElements = "xyz";
  static Real Get(const CVector3& value, char element) { return value[static_cast<UInt32>(element - 'x')]; }
  static void Set(CVector3& value, char element, Real number) { value[static_cast<UInt32>(element - 'x')] = number; }
};
template <>
struct Traits<CQuaternion>
{
  static constexpr const char* kName = "quaternion";
  static constexpr const char* kElements = "wxyz";
  static Real Get(const CQuaternion& value, char element)
  {
    return element == 'w' ? value.GetW() : element == 'x' ? value.GetX() : element == 'y' ? value.GetY() : value.GetZ();
  }
  static void Set(CQuaternion& value, char element, Real number)
  {
    if (element == 'w')
      value.SetW(number);
    else if (element == 'x')
      value.SetX(number);
    else if (element == 'y')
      value.SetY(number);
    else
      value.SetZ(number);
  }
};

template <class Type>
Type& At(lua_State* lua, int index)
{
  return *static_cast<Type*>(luaL_checkudata(lua, index, Traits<Type>::kName));
}

template <class Type>
int Push(lua_State* lua, const Type& value)
{
  static_assert(std::is_trivially_destructible_v<Type>, "Lua frees its memory alone");
  new (lua_newuserdatauv(lua, sizeof(Type), 0)) Type(value);
  luaL_setmetatable(lua, Traits<Type>::kName);
  return 1;
}

template <class Type>
int Make(lua_State* lua)
{
  const int count = lua_gettop(lua);
  if (count == 1) return Push(lua, At<Type>(lua, 1));
  Type value;
  if (count == 0) return Push(lua, value);
  if constexpr (std::is_same_v<Type, CQuaternion>)
    if (count == 2) return Push(lua, CQuaternion(argos::CRadians(luaL_checknumber(lua, 1)), At<CVector3>(lua, 2)));
  CheckCount(lua, static_cast<int>(std::strlen(Traits<Type>::kElements)));
  for (int i = 0; i < count; ++i) Traits<Type>::Set(value, Traits<Type>::kElements[i], luaL_checknumber(lua, i + 1));
  return Push(lua, value);
}

// Returns the letter of an element; 0 for a longer text.
template <class Type>
char ElementAt(lua_State* lua, int index)
{
  const char* key = luaL_checkstring(lua, index);
  if (std::strlen(key) != 1) return 0;
  if (std::strchr(Traits<Type>::kElements, key[0]) == nullptr)
    luaL_error(lua, "a %s has no element '%s'; its elements are %s", Traits<Type>::kName, key, Traits<Type>::kElements);
  return key[0];
}

template <class Type>
int Index(lua_State* lua)
{
  const Type& value = At<Type>(lua, 1);
  if (const char element = ElementAt<Type>(lua, 2); element != 0)
  {
    lua_pushnumber(lua, Traits<Type>::Get(value, element));
    return 1;
  }
  if constexpr (std::is_same_v<Type, CQuaternion>)
  {
    // Reads orientations in the form of older scripts.
    argos::CRadians angle;
    CVector3 axis;
    value.ToAngleAxis(angle, axis);
    if (std::strcmp(lua_tostring(lua, 2), "axis") == 0) return Push(lua, axis);
    lua_pushnumber(lua, angle.GetValue());
    if (std::strcmp(lua_tostring(lua, 2), "angle") == 0) return 1;
  }
  luaL_getmetatable(lua, Traits<Type>::kName);
  lua_pushvalue(lua, 2);
  lua_rawget(lua, -2);
  return 1;
}

template <class Type>
int SetElement(lua_State* lua)
{
  const char element = ElementAt<Type>(lua, 2);
  if (element == 0)
    return luaL_error(lua, "a %s has no element '%s'; its elements are %s", Traits<Type>::kName, lua_tostring(lua, 2),
                      Traits<Type>::kElements);
  Traits<Type>::Set(At<Type>(lua, 1), element, luaL_checknumber(lua, 3));
  return 0;
}

template <class Type>
int Equal(lua_State* lua)
{
  lua_pushboolean(lua, At<Type>(lua, 1) == At<Type>(lua, 2) ? 1 : 0);
  return 1;
}

template <class Type>
int Add(lua_State* lua)
{
  return Push(lua, At<Type>(lua, 1) + At<Type>(lua, 2));
}

template <class Type>
int Subtract(lua_State* lua)
{
  return Push(lua, At<Type>(lua, 1) - At<Type>(lua, 2));
}

template <class Type>
int Negate(lua_State* lua)
{
  return Push(lua, -At<Type>(lua, 1));
}

// The number may be on either side.
template <class Type>
int Scale(lua_State* lua)
{
  if (lua_isnumber(lua, 1) != 0) return Push(lua, At<Type>(lua, 2) * lua_tonumber(lua, 1));
  return Push(lua, At<Type>(lua, 1) * luaL_checknumber(lua, 2));
}

int MultiplyQuaternions(lua_State* lua) { return Push(lua, At<CQuaternion>(lua, 1) * At<CQuaternion>(lua, 2)); }

// Returns the first value, for functions that change it.
int Itself(lua_State* lua)
{
  lua_settop(lua, 1);
  return 1;
}

template <class Type>
int Normalize(lua_State* lua)
{
  At<Type>(lua, 1).Normalize();
  return Itself(lua);
}

template <class Type>
int Length(lua_State* lua)
{
  lua_pushnumber(lua, At<Type>(lua, 1).Length());
  return 1;
}

template <class Type>
int Dot(lua_State* lua)
{
  lua_pushnumber(lua, At<Type>(lua, 1).DotProduct(At<Type>(lua, 2)));
  return 1;
}

int CrossOfPlane(lua_State* lua)
{
  lua_pushnumber(lua, At<CVector2>(lua, 1).CrossProduct(At<CVector2>(lua, 2)));
  return 1;
}

int Cross(lua_State* lua)
{
  At<CVector3>(lua, 1).CrossProduct(At<CVector3>(lua, 2));
  return Itself(lua);
}

int RotateInPlane(lua_State* lua)
{
  At<CVector2>(lua, 1).Rotate(argos::CRadians(luaL_checknumber(lua, 2)));
  return Itself(lua);
}

int Rotate(lua_State* lua)
{
  At<CVector3>(lua, 1).Rotate(At<CQuaternion>(lua, 2));
  return Itself(lua);
}

int Inverse(lua_State* lua) { return Push(lua, At<CQuaternion>(lua, 1).Inverse()); }

int ToAngleAxis(lua_State* lua)
{
  argos::CRadians angle;
  CVector3 axis;
  At<CQuaternion>(lua, 1).ToAngleAxis(angle, axis);
  lua_pushnumber(lua, angle.GetValue());
  return 1 + Push(lua, axis);
}

// Returns the angles about z, y and x.
int ToEulerAngles(lua_State* lua)
{
  argos::CRadians z, y, x;
  At<CQuaternion>(lua, 1).ToEulerAngles(z, y, x);
  for (const argos::CRadians& angle : {z, y, x}) lua_pushnumber(lua, angle.GetValue());
  return 3;
}

template <class Type>
int ToText(lua_State* lua)
{
  const Type value = At<Type>(lua, 1);
  std::ostringstream text;
  text << value;
  lua_pushstring(lua, text.str().c_str());
  return 1;
}

// Leaves the metatable on the stack. Its functions are also the methods.
template <class Type>
void BeginType(lua_State* lua)
{
  luaL_newmetatable(lua, Traits<Type>::kName);
  SetFunction<Index<Type>>(lua, "__index", nullptr);
  SetFunction<SetElement<Type>>(lua, "__newindex", nullptr);
  SetFunction<ToText<Type>>(lua, "__tostring", nullptr);
  SetFunction<Equal<Type>>(lua, "__eq", nullptr);
  SetFunction<Normalize<Type>>(lua, "normalize", nullptr);
}

template <class Type>
void EndType(lua_State* lua)
{
  Leave(lua);
  SetFunction<Make<Type>>(lua, Traits<Type>::kName, nullptr);
}

template <class Type>
void AddVectorType(lua_State* lua)
{
  BeginType<Type>(lua);
  SetFunction<Add<Type>>(lua, "__add", nullptr);
  SetFunction<Subtract<Type>>(lua, "__sub", nullptr);
  SetFunction<Scale<Type>>(lua, "__mul", nullptr);
  SetFunction<Negate<Type>>(lua, "__unm", nullptr);
  SetFunction<Length<Type>>(lua, "length", nullptr);
  SetFunction<Dot<Type>>(lua, "dot", nullptr);
  if constexpr (std::is_same_v<Type, CVector2>)
  {
    SetFunction<CrossOfPlane>(lua, "cross", nullptr);
    SetFunction<RotateInPlane>(lua, "rotate", nullptr);
  }
  else
  {
    SetFunction<Cross>(lua, "cross", nullptr);
    SetFunction<Rotate>(lua, "rotate", nullptr);
  }
  EndType<Type>(lua);
}

}  // namespace

void AddVectors(lua_State* lua)
{
  AddVectorType<CVector2>(lua);
  AddVectorType<CVector3>(lua);
  BeginType<CQuaternion>(lua);
  SetFunction<MultiplyQuaternions>(lua, "__mul", nullptr);
  SetFunction<Inverse>(lua, "inverse", nullptr);
  SetFunction<ToAngleAxis>(lua, "toangleaxis", nullptr);
  SetFunction<ToEulerAngles>(lua, "toeulerangles", nullptr);
  EndType<CQuaternion>(lua);
}

void SetVector(lua_State* lua, const char* name, const CVector3& value)
{
  Push(lua, value);
  lua_setfield(lua, -2, name);
}

void SetQuaternion(lua_State* lua, const char* name, const CQuaternion& value)
{
  Push(lua, value);
  lua_setfield(lua, -2, name);
}

}  // namespace swarmanoid::argos3
