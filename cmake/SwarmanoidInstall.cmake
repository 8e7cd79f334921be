# Installs the headers and the CMake package `Swarmanoid`, so that find_package(Swarmanoid) works in any other folder.
# Libraries and programs install themselves (swarmanoid_library, swarmanoid_program). Included last.
include(CMakePackageConfigHelpers)

set(PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/Swarmanoid)

# What only the programs of the cluster use stays out: DDS is no part of the interface.
install(DIRECTORY common engine_worker controller_host visualiser space_server
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/swarmanoid
  FILES_MATCHING PATTERN "*.h" PATTERN "bus" EXCLUDE PATTERN "engines" EXCLUDE PATTERN "devices" EXCLUDE)

install(EXPORT SwarmanoidTargets NAMESPACE Swarmanoid:: DESTINATION ${PACKAGE_FOLDER})
configure_package_config_file(cmake/SwarmanoidConfig.cmake.in ${CMAKE_BINARY_DIR}/SwarmanoidConfig.cmake
  INSTALL_DESTINATION ${PACKAGE_FOLDER})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/SwarmanoidConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/SwarmanoidConfig.cmake ${CMAKE_BINARY_DIR}/SwarmanoidConfigVersion.cmake
  DESTINATION ${PACKAGE_FOLDER})

install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/swarmanoid)
install(DIRECTORY user/ DESTINATION ${CMAKE_INSTALL_DATADIR}/swarmanoid/user
  FILES_MATCHING REGEX "/(controllers|templates|user_scripts|behavior_toolkit)/")
