# Installs the public headers: those of this list and all headers that they include. cmake/SwarmanoidInstall.cmake runs this script at
# each installation, with SOURCE and GENERATED (the folders of the sources, and of headers that the build makes) and DESTINATION.
# tests/package/installed_headers.py checks that listings, samples and templates find what they include, and that nothing else is
# installed. A folder stands for all its headers.
cmake_minimum_required(VERSION 3.25)

set(PUBLIC_HEADERS
  # controllers and behaviours
  common/control_interface
  common/math/elementary.h
  user/behavior_toolkit
  # sensors and actuators
  common/plugins/parameter_checks.h
  controller_host/device.h
  controller_host/devices/device_streams.h
  controller_host/devices/noise.h
  controller_host/devices/value_devices.h
  controller_host/on_demand_sensor.h
  controller_host/powered_device.h
  # kinds of robots and objects
  common/experiment/entity_kind.h
  common/experiment/moving_links.h
  common/mesh/convex_hull.h
  # physics engines
  common/plugins/catalogue.h
  common/threads/worker_pool.h
  engine_worker/physics_engine.h
  # experiment functions
  common/space/battery_slots.h
  common/space/entities_by_kind.h
  common/space/publish.h
  common/space/space.h
  space_server/experiment_functions.h
  space_server/robot_messages.h
  # visualisations
  visualiser/render.h
  visualiser/text/text_render.h
  # simulators
  common/activity/failure_report.h
  launcher/simulation.h
  simulation/simulator.h
  # drivers of real robots
  real_robot/driver.h)

# The folders in which users' compilers look for headers.
set(INCLUDE_FOLDERS ${SOURCE} ${GENERATED} ${SOURCE}/common/control_interface ${SOURCE}/user/behavior_toolkit)

set(waiting)
foreach(entry IN LISTS PUBLIC_HEADERS)
  if(IS_DIRECTORY ${SOURCE}/${entry})
    file(GLOB_RECURSE headers ${SOURCE}/${entry}/*.h)
    list(APPEND waiting ${headers})
  else()
    list(APPEND waiting ${SOURCE}/${entry})
  endif()
endforeach()

set(installed)
while(waiting)
  list(POP_FRONT waiting header)
  if(header IN_LIST installed)
    continue()
  endif()
  list(APPEND installed ${header})
  get_filename_component(own_folder ${header} DIRECTORY)
  file(STRINGS ${header} includes REGEX "^ *# *include [\"<].*\\.h[\">]")
  foreach(include IN LISTS includes)
    string(REGEX REPLACE "^ *# *include [\"<]([^\">]+)[\">].*" "\\1" include "${include}")
    foreach(folder ${own_folder} ${INCLUDE_FOLDERS})
      if(EXISTS ${folder}/${include})
        list(APPEND waiting ${folder}/${include})
        break()
      endif()
    endforeach()
  endforeach()
endwhile()

foreach(header IN LISTS installed)
  cmake_path(IS_PREFIX GENERATED ${header} is_generated)
  if(is_generated)
    file(RELATIVE_PATH path ${GENERATED} ${header})
  else()
    file(RELATIVE_PATH path ${SOURCE} ${header})
  endif()
  get_filename_component(folder ${path} DIRECTORY)
  file(INSTALL DESTINATION ${DESTINATION}/${folder} TYPE FILE FILES ${header})
endforeach()
