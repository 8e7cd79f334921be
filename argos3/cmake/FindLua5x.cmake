# For find_package(Lua52) and find_package(Lua53) of users of ARGoS3, whose headers include Lua's. Ours do not: any Lua
# that is there will do, and none, too.
find_package(Lua QUIET)
if(NOT LUA_FOUND)
  unset(LUA_INCLUDE_DIR CACHE)
  unset(LUA_LIBRARY CACHE)
  set(LUA_INCLUDE_DIR "")
  set(LUA_LIBRARIES "")
endif()
set(${CMAKE_FIND_PACKAGE_NAME}_FOUND TRUE)
set(LUA_FOUND TRUE)
