# The names by which CMakeLists.txt of users link the libraries of ARGoS3. Qt-OpenGL user functions are not shown here:
# ARGOS_QTOPENGL_FOUND is false, and whoever asks for it leaves them out.
foreach(name argos3core_simulator argos3plugin_simulator_footbot argos3plugin_simulator_eyebot argos3plugin_simulator_epuck
    argos3plugin_simulator_genericrobot argos3plugin_simulator_entities argos3plugin_simulator_dynamics2d
    argos3plugin_simulator_pointmass3d argos3plugin_simulator_media argos3plugin_simulator_actuators
    argos3plugin_simulator_sensors argos3plugin_simulator_argos_rangeandbearing)
  if(NOT TARGET ${name})
    add_library(${name} INTERFACE IMPORTED)
    target_link_libraries(${name} INTERFACE Swarmanoid::argos3)
  endif()
endforeach()
set(ARGOS_FOUND TRUE)
set(ARGOS_BUILD_FOR simulator)
set(ARGOS_BUILD_FOR_SIMULATOR TRUE)
set(ARGOS_QTOPENGL_FOUND FALSE)
set(ARGOS_COMPILE_QTOPENGL FALSE)
get_target_property(ARGOS_INCLUDE_DIRS Swarmanoid::argos3 INTERFACE_INCLUDE_DIRECTORIES)
set(ARGOS_INCLUDE_DIR ${ARGOS_INCLUDE_DIRS})
set(ARGOS_LIBRARY_DIRS "")
set(ARGOS_LIBRARIES argos3core_simulator)
