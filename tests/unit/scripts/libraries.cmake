# The experiments of these tests load the plug-ins.
add_dependencies(unit_scripts lua_plugin)
if(TARGET python_plugin)
  add_dependencies(unit_scripts python_plugin)
endif()
