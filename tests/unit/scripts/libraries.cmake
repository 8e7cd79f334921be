# The experiments of these tests load the plug-in.
add_dependencies(unit_scripts lua_plugin)
