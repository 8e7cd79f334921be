# Installs the headers and the CMake package `Swarmanoid`, so that find_package(Swarmanoid) works in any other folder.
# Libraries and programs install themselves (swarmanoid_library, swarmanoid_program). Included last.
include(CMakePackageConfigHelpers)

set(PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/Swarmanoid)

# What only the programs of the cluster use stays out: DDS is no part of the interface.
install(DIRECTORY common roles engine_worker controller_host visualiser space_server
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/swarmanoid
  FILES_MATCHING PATTERN "*.h" PATTERN "bus" EXCLUDE PATTERN "engines" EXCLUDE PATTERN "devices" EXCLUDE)
# Of the devices, what those of users are made from.
install(FILES controller_host/devices/device_streams.h controller_host/devices/noise.h controller_host/devices/value_devices.h
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/swarmanoid/controller_host/devices)

install(FILES launcher/simulation.h launcher/simulator.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/swarmanoid/launcher)
install(DIRECTORY user/behavior_toolkit DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/swarmanoid/user FILES_MATCHING PATTERN "*.h")

install(EXPORT SwarmanoidTargets NAMESPACE Swarmanoid:: DESTINATION ${PACKAGE_FOLDER})
configure_package_config_file(cmake/SwarmanoidConfig.cmake.in ${CMAKE_BINARY_DIR}/SwarmanoidConfig.cmake
  INSTALL_DESTINATION ${PACKAGE_FOLDER})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/SwarmanoidConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/SwarmanoidConfig.cmake ${CMAKE_BINARY_DIR}/SwarmanoidConfigVersion.cmake
  cmake/SwarmanoidUser.cmake cmake/config.h.in DESTINATION ${PACKAGE_FOLDER})

# User directories within the source tree build against the build folder, without installing.
export(EXPORT SwarmanoidTargets NAMESPACE Swarmanoid:: FILE ${CMAKE_BINARY_DIR}/SwarmanoidTargets.cmake)
configure_file(cmake/SwarmanoidUser.cmake ${CMAKE_BINARY_DIR}/SwarmanoidUser.cmake COPYONLY)
configure_file(cmake/config.h.in ${CMAKE_BINARY_DIR}/config.h.in COPYONLY)

# What drivers of robots are made from; and the messages that the ros2 drivers speak.
install(FILES real_robot/driver.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/swarmanoid/real_robot)
install(DIRECTORY idl DESTINATION ${CMAKE_INSTALL_DATADIR}/swarmanoid)

# Experiments, and what a user copies.
install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/swarmanoid)
foreach(folder controllers entities functions templates)
  install(DIRECTORY user/${folder} DESTINATION ${CMAKE_INSTALL_DATADIR}/swarmanoid/user
    USE_SOURCE_PERMISSIONS PATTERN ".clang-format" EXCLUDE)
endforeach()
install(DIRECTORY user/user_scripts DESTINATION ${CMAKE_INSTALL_DATADIR}/swarmanoid/user USE_SOURCE_PERMISSIONS)
