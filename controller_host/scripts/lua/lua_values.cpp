// Invariant: no function here lets Lua raise an error, so C++ objects may live between the calls. Tables are read
// without metamethods, and the stack has space for each level.
#include "controller_host/scripts/lua/lua_values.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "controller_host/scripts/lua/lua_stack.h"

namespace swarmanoid::lua
{
namespace
{

enum class Tag : std::uint8_t
{
  kFalse,
  kTrue,
  kInteger,
  kNumber,
  kText,
  kTable,
  kOther  // only in ValuesOfScript
};

constexpr int kDeepest = 100;  // tables within tables

void RequireStack(lua_State* lua)
{
  if (lua_checkstack(lua, 10) == 0) throw std::runtime_error("no memory is left for Lua");
}

std::string TextAt(lua_State* lua, int place)
{
  std::size_t length = 0;
  const char* text = lua_tolstring(lua, place, &length);
  return {text, length};
}

std::string NameOfKey(lua_State* lua, int place)
{
  if (lua_type(lua, place) == LUA_TSTRING) return "." + TextAt(lua, place);
  if (lua_isinteger(lua, place) != 0) return "[" + std::to_string(lua_tointeger(lua, place)) + "]";
  return std::string("[a ") + luaL_typename(lua, place) + "]";
}

// Puts a value that is no table. Returns false for a value of another type.
bool PutPlain(lua_State* lua, int place, ByteWriter& bytes)
{
  switch (lua_type(lua, place))
  {
    case LUA_TBOOLEAN:
      bytes.Put(lua_toboolean(lua, place) != 0 ? Tag::kTrue : Tag::kFalse);
      return true;
    case LUA_TNUMBER:
      if (lua_isinteger(lua, place) != 0)
      {
        bytes.Put(Tag::kInteger);
        bytes.Put(lua_tointeger(lua, place));
      }
      else
      {
        bytes.Put(Tag::kNumber);
        bytes.Put(lua_tonumber(lua, place));
      }
      return true;
    case LUA_TSTRING:
      bytes.Put(Tag::kText);
      bytes.PutText(TextAt(lua, place));
      return true;
    default:
      return false;
  }
}

std::string Bytes(const ByteWriter& bytes) { return {bytes.Bytes().begin(), bytes.Bytes().end()}; }

// Puts the entries in the order of their keys, since the order of Lua depends on addresses.
void PutEntries(std::vector<std::pair<std::string, std::string>>& entries, ByteWriter& bytes)
{
  std::ranges::sort(entries);
  bytes.Put(Tag::kTable);
  bytes.Put(static_cast<std::uint64_t>(entries.size()));
  for (const auto& [key, value] : entries)
  {
    bytes.PutText(key);
    bytes.PutText(value);
  }
}

class Saver
{
public:
  explicit Saver(lua_State* lua) : lua_(lua) {}

  std::string Table(int table, const std::string& name, int depth = 0)
  {
    RequireStack(lua_);
    if (depth > kDeepest) Fail(name, "is a table within more than 100 tables");
    if (const auto [first, is_new] = names_.emplace(lua_topointer(lua_, table), name); !is_new)
      Fail(name, "is the same table as " + first->second);
    if (lua_getmetatable(lua_, table) != 0)
    {
      lua_pop(lua_, 1);
      Fail(name, "has a metatable, which is not saved");
    }
    std::vector<std::pair<std::string, std::string>> entries;
    for (lua_pushnil(lua_); lua_next(lua_, table) != 0; lua_pop(lua_, 1))
    {
      const int value = lua_gettop(lua_), key = value - 1;
      const std::string name_of_value = name + NameOfKey(lua_, key);
      ByteWriter key_bytes, bytes;
      if (!PutPlain(lua_, key, key_bytes)) Fail(name, std::string("has a ") + luaL_typename(lua_, key) + " as a key");
      if (lua_istable(lua_, value))
        entries.emplace_back(Bytes(key_bytes), Table(value, name_of_value, depth + 1));
      else if (PutPlain(lua_, value, bytes))
        entries.emplace_back(Bytes(key_bytes), Bytes(bytes));
      else
        Fail(name_of_value, std::string("is a ") + luaL_typename(lua_, value) +
                                "; only numbers, texts, booleans and tables of them can be saved");
    }
    ByteWriter all;
    PutEntries(entries, all);
    return Bytes(all);
  }

private:
  [[noreturn]] static void Fail(const std::string& name, const std::string& what)
  {
    throw std::runtime_error(name + " " + what);
  }

  lua_State* lua_;
  std::map<const void*, std::string> names_;
};

void PushPlain(lua_State* lua, ByteReader& bytes, Tag tag)
{
  if (tag == Tag::kInteger)
    lua_pushinteger(lua, bytes.Get<lua_Integer>());
  else if (tag == Tag::kNumber)
    lua_pushnumber(lua, bytes.Get<lua_Number>());
  else if (tag == Tag::kText)
  {
    const std::string text = bytes.GetText();
    lua_pushlstring(lua, text.data(), text.size());
  }
  else if (tag == Tag::kTrue || tag == Tag::kFalse)
    lua_pushboolean(lua, tag == Tag::kTrue ? 1 : 0);
  else
    throw std::runtime_error("saved state: a value of Lua has an unknown type");
}

// Reads a key, which must not be a table or a number that is none.
void PushKey(lua_State* lua, const std::string& saved)
{
  ByteReader bytes(saved);
  PushPlain(lua, bytes, bytes.Get<Tag>());
  const lua_Number number = lua_tonumber(lua, -1);
  if (number != number) throw std::runtime_error("saved state: a key of a table of Lua is not a number");
}

// Removes the entries that are not in the list of keys, which is sorted.
void RemoveOthers(lua_State* lua, int table, const std::vector<std::string>& keys)
{
  for (lua_pushnil(lua); lua_next(lua, table) != 0;)
  {
    lua_pop(lua, 1);
    ByteWriter bytes;
    const bool is_plain = PutPlain(lua, lua_gettop(lua), bytes);
    if (is_plain && std::ranges::binary_search(keys, Bytes(bytes))) continue;
    // A value may be removed while a table is visited.
    lua_pushvalue(lua, -1);
    lua_pushnil(lua);
    lua_rawset(lua, table);
  }
}

void Load(lua_State* lua, int table, ByteReader& bytes, int depth)
{
  RequireStack(lua);
  if (depth > kDeepest || bytes.Get<Tag>() != Tag::kTable)
    throw std::runtime_error("saved state: it is no table of Lua");
  std::vector<std::pair<std::string, std::string>> entries;
  for (auto left = bytes.Get<std::uint64_t>(); left > 0; --left)
  {
    std::string key = bytes.GetText();
    entries.emplace_back(std::move(key), bytes.GetText());
  }
  std::vector<std::string> keys;
  for (const auto& entry : entries) keys.push_back(entry.first);
  std::ranges::sort(keys);
  RemoveOthers(lua, table, keys);
  for (const auto& [key, value] : entries)
  {
    ByteReader value_bytes(value), tag(value);
    PushKey(lua, key);
    if (const auto type = tag.Get<Tag>(); type != Tag::kTable)
    {
      value_bytes.Get<Tag>();
      PushPlain(lua, value_bytes, type);
    }
    else
    {
      lua_pushvalue(lua, -1);
      if (lua_rawget(lua, table) != LUA_TTABLE)
      {
        lua_pop(lua, 1);
        lua_newtable(lua);
      }
      Load(lua, lua_gettop(lua), value_bytes, depth + 1);
    }
    lua_rawset(lua, table);
  }
}

class Collector
{
public:
  Collector(lua_State* lua, const KnownValues& known) : lua_(lua), known_(known), visited_(known.tables) {}

  // Names the tables of the state. A variable that refers to one of them has its name as a value.
  void NameState(int table, const std::string& name, int depth = 0)
  {
    RequireStack(lua_);
    if (depth > kDeepest || !state_.emplace(lua_topointer(lua_, table), name).second) return;
    for (lua_pushnil(lua_); lua_next(lua_, table) != 0; lua_pop(lua_, 1))
      if (lua_istable(lua_, -1)) NameState(lua_gettop(lua_), name + NameOfKey(lua_, lua_gettop(lua_) - 1), depth + 1);
  }

  void AddGlobals()
  {
    lua_pushglobaltable(lua_);
    const int globals = lua_gettop(lua_);
    visited_.insert(lua_topointer(lua_, globals));
    for (lua_pushnil(lua_); lua_next(lua_, globals) != 0; lua_pop(lua_, 1))
    {
      const int value = lua_gettop(lua_);
      const std::string name = lua_type(lua_, value - 1) == LUA_TSTRING ? TextAt(lua_, value - 1) : "of another type";
      if (!known_.globals.contains(name)) Add(value, "the global variable '" + name + "'");
    }
    lua_pop(lua_, 1);
  }

  std::map<std::string, std::string> values;

private:
  void Add(int place, const std::string& name)
  {
    ByteWriter bytes;
    Put(place, bytes, 0);
    values[name] = Bytes(bytes);
  }

  void Put(int place, ByteWriter& bytes, int depth)
  {
    RequireStack(lua_);
    if (lua_isfunction(lua_, place)) return AddVariablesOf(place);
    if (lua_isthread(lua_, place))
      throw std::runtime_error(
          "the script keeps a coroutine, which cannot be saved; leave out the table `state`, or the coroutine");
    if (!lua_istable(lua_, place))
    {
      if (!PutPlain(lua_, place, bytes)) bytes.Put(Tag::kOther);
      return;
    }
    if (const auto state = state_.find(lua_topointer(lua_, place)); state != state_.end())
      return bytes.PutText(state->second);
    if (depth > kDeepest || !visited_.insert(lua_topointer(lua_, place)).second) return;
    std::vector<std::pair<std::string, std::string>> entries;
    for (lua_pushnil(lua_); lua_next(lua_, place) != 0; lua_pop(lua_, 1))
    {
      const int value = lua_gettop(lua_);
      ByteWriter key_bytes, value_bytes;
      PutPlain(lua_, value - 1, key_bytes);
      Put(value, value_bytes, depth + 1);
      entries.emplace_back(Bytes(key_bytes), Bytes(value_bytes));
    }
    PutEntries(entries, bytes);
  }

  void AddVariablesOf(int function)
  {
    if (lua_iscfunction(lua_, function) != 0 || !visited_.insert(lua_topointer(lua_, function)).second) return;
    for (int i = 1;; ++i)
    {
      const char* variable = lua_getupvalue(lua_, function, i);
      if (variable == nullptr) return;
      const int place = lua_gettop(lua_);
      // Functions of one file share their variables.
      if (visited_.insert(lua_upvalueid(lua_, function, i)).second)
      {
        lua_Debug about{};
        lua_pushvalue(lua_, function);
        lua_getinfo(lua_, ">S", &about);
        Add(place, std::string("the local variable '") + variable + "' of the function in " + about.short_src + ":" +
                       std::to_string(about.linedefined));
      }
      lua_settop(lua_, place - 1);
    }
  }

  lua_State* lua_;
  const KnownValues& known_;
  std::map<const void*, std::string> state_;
  std::set<const void*> visited_;
};

}  // namespace

std::string SavedTable(lua_State* lua, int table, const std::string& name) { return Saver(lua).Table(table, name); }

void LoadTable(lua_State* lua, int table, const std::string& saved)
{
  ByteReader bytes(saved);
  Load(lua, table, bytes, 0);
  if (!bytes.AtEnd()) throw std::runtime_error("saved state: it is longer than a table of Lua");
}

std::map<std::string, std::string> ValuesOfScript(lua_State* lua, const KnownValues& known)
{
  Collector collector(lua, known);
  if (PushGlobal(lua, "state") == LUA_TTABLE) collector.NameState(lua_gettop(lua), "state");
  lua_pop(lua, 1);
  collector.AddGlobals();
  return std::move(collector.values);
}

}  // namespace swarmanoid::lua
