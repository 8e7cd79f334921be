# Answers find_package(Lua52) and find_package(Lua53) in projects for ARGoS3, because ARGoS3's headers include Lua's. Our headers
# do not, so any installed Lua is accepted, and also none.
find_package(Lua QUIET)
if(NOT LUA_FOUND)
  unset(LUA_INCLUDE_DIR CACHE)
  unset(LUA_LIBRARY CACHE)
  set(LUA_INCLUDE_DIR "")
  set(LUA_LIBRARIES "")
endif()
set(${CMAKE_FIND_PACKAGE_NAME}_FOUND TRUE)
set(LUA_FOUND TRUE)
