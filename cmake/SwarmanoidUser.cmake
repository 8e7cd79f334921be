# This file has functions for projects with controllers, inside the source tree and outside it. find_package(Swarmanoid) includes it.

# swarmanoid_config_header(FOLDER) writes FOLDER/config.h, which tells a controller what it is compiled for.
set(SWARMANOID_CONFIG_TEMPLATE ${CMAKE_CURRENT_LIST_DIR}/config.h.in)
function(swarmanoid_config_header folder)
  if(NOT DEFINED Swarmanoid_VERSION)
    set(Swarmanoid_VERSION ${PROJECT_VERSION})
  endif()
  configure_file(${SWARMANOID_CONFIG_TEMPLATE} ${folder}/config.h @ONLY)
endfunction()

# swarmanoid_controller(NAME SOURCES... [LINK libs...]) adds the library libNAME.so, which an experiment names as library="NAME".
function(swarmanoid_controller name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} MODULE ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE Swarmanoid::control_interface Swarmanoid::behavior_toolkit ${ARG_LINK})
endfunction()

# swarmanoid_controllers(FOLDER OUTPUT) adds a library for each folder of FOLDER that has .cpp files. The libraries are written to
# the folder OUTPUT. The caller's SWARMANOID_CONTROLLERS gets their names.
function(swarmanoid_controllers folder output)
  file(GLOB names CONFIGURE_DEPENDS RELATIVE ${folder} ${folder}/*)
  set(controllers)
  foreach(name IN LISTS names)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/${name}/*.cpp)
    if(sources)
      swarmanoid_controller(${name} SOURCES ${sources})
      target_include_directories(${name} PRIVATE ${folder}/..)
      set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${output})
      list(APPEND controllers ${name})
    endif()
  endforeach()
  set(SWARMANOID_CONTROLLERS ${controllers} PARENT_SCOPE)
endfunction()

# swarmanoid_plugins(FOLDER OUTPUT TARGET) does the same for plug-ins of another kind, which link TARGET. SWARMANOID_CONTROLLERS gets
# their names.
function(swarmanoid_plugins folder output target)
  swarmanoid_controllers(${folder} ${output})
  foreach(name IN LISTS SWARMANOID_CONTROLLERS)
    target_link_libraries(${name} PRIVATE ${target})
  endforeach()
  set(SWARMANOID_CONTROLLERS ${SWARMANOID_CONTROLLERS} PARENT_SCOPE)
endfunction()

# swarmanoid_functions(FOLDER OUTPUT) does the same for experiment functions. SWARMANOID_FUNCTIONS gets the names.
function(swarmanoid_functions folder output)
  swarmanoid_plugins(${folder} ${output} Swarmanoid::space_server_role)
  set(SWARMANOID_FUNCTIONS ${SWARMANOID_CONTROLLERS} PARENT_SCOPE)
endfunction()

# swarmanoid_engines(FOLDER OUTPUT) does the same for physics engines. SWARMANOID_ENGINES gets the names.
function(swarmanoid_engines folder output)
  swarmanoid_plugins(${folder} ${output} Swarmanoid::physics_engine)
  set(SWARMANOID_ENGINES ${SWARMANOID_CONTROLLERS} PARENT_SCOPE)
endfunction()

# swarmanoid_renderers(FOLDER OUTPUT) does the same for visualisations. SWARMANOID_RENDERERS gets the names.
function(swarmanoid_renderers folder output)
  swarmanoid_plugins(${folder} ${output} Swarmanoid::render)
  set(SWARMANOID_RENDERERS ${SWARMANOID_CONTROLLERS} PARENT_SCOPE)
endfunction()

# swarmanoid_devices(FOLDER OUTPUT) does the same for simulated sensors and actuators. SWARMANOID_DEVICES gets the names.
function(swarmanoid_devices folder output)
  swarmanoid_plugins(${folder} ${output} Swarmanoid::controller_host_role)
  set(SWARMANOID_DEVICES ${SWARMANOID_CONTROLLERS} PARENT_SCOPE)
endfunction()

# swarmanoid_entities(FOLDER OUTPUT) does the same for kinds of robots and objects. SWARMANOID_ENTITIES gets the names.
function(swarmanoid_entities folder output)
  swarmanoid_plugins(${folder} ${output} Swarmanoid::experiment)
  set(SWARMANOID_ENTITIES ${SWARMANOID_CONTROLLERS} PARENT_SCOPE)
endfunction()

# swarmanoid_driver(NAME SOURCES... [LINK libs...]) adds the library libNAME.so with drivers of a real robot (docs/real_robot.md).
function(swarmanoid_driver name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} MODULE ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE Swarmanoid::real_robot ${ARG_LINK})
endfunction()
