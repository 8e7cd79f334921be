# Installs the headers, the CMake package `Swarmanoid` and the pkg-config files, so that controllers can be built in any other
# folder. It also installs the pages. swarmanoid_library and swarmanoid_program install libraries and programs. This file is
# included after all of them.
include(CMakePackageConfigHelpers)

set(PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/Swarmanoid)
set(HEADER_FOLDER ${CMAKE_INSTALL_INCLUDEDIR}/swarmanoid)

install(CODE "
  set(SOURCE \"${CMAKE_SOURCE_DIR}\")
  set(GENERATED \"${CMAKE_BINARY_DIR}/generated\")
  set(DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${HEADER_FOLDER}\")
  include(\"${CMAKE_SOURCE_DIR}/cmake/InstallHeaders.cmake\")" COMPONENT dev)

install(EXPORT SwarmanoidTargets NAMESPACE Swarmanoid:: DESTINATION ${PACKAGE_FOLDER} COMPONENT dev)
configure_package_config_file(cmake/SwarmanoidConfig.cmake.in ${CMAKE_BINARY_DIR}/SwarmanoidConfig.cmake
  INSTALL_DESTINATION ${PACKAGE_FOLDER})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/SwarmanoidConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/SwarmanoidConfig.cmake ${CMAKE_BINARY_DIR}/SwarmanoidConfigVersion.cmake
  cmake/SwarmanoidUser.cmake cmake/config.h.in DESTINATION ${PACKAGE_FOLDER} COMPONENT dev)

# These pkg-config files are for users without CMake: swarmanoid for controllers, swarmanoid-simulation for everything else.
foreach(name swarmanoid swarmanoid-simulation)
  string(REPLACE ";" " " PKG_CONFIG_OPTIONS "${SWARMANOID_EXACT}")
  file(RELATIVE_PATH PKG_CONFIG_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  configure_file(cmake/${name}.pc.in ${CMAKE_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${CMAKE_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endforeach()

# User directories within the source tree build against the build folder, without installing.
export(EXPORT SwarmanoidTargets NAMESPACE Swarmanoid:: FILE ${CMAKE_BINARY_DIR}/SwarmanoidTargets.cmake)
configure_file(cmake/SwarmanoidUser.cmake ${CMAKE_BINARY_DIR}/SwarmanoidUser.cmake COPYONLY)
configure_file(cmake/config.h.in ${CMAKE_BINARY_DIR}/config.h.in COPYONLY)

# The IDL files are the messages of the ros2 drivers.
install(DIRECTORY idl DESTINATION ${CMAKE_INSTALL_DATADIR}/swarmanoid COMPONENT dev PATTERN generate.py EXCLUDE)

# These are the experiments, and the samples and templates that users copy.
install(DIRECTORY configs DESTINATION ${CMAKE_INSTALL_DATADIR}/swarmanoid)
foreach(folder controllers entities functions templates)
  install(DIRECTORY user/${folder} DESTINATION ${CMAKE_INSTALL_DATADIR}/swarmanoid/user
    USE_SOURCE_PERMISSIONS PATTERN ".clang-format" EXCLUDE)
endforeach()
install(DIRECTORY user/user_scripts DESTINATION ${CMAKE_INSTALL_DATADIR}/swarmanoid/user USE_SOURCE_PERMISSIONS)

# The programs write their manual pages themselves, from their tables of options.
foreach(program swarmanoid swarmanoid_robot)
  install(CODE "
    set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man1\")
    file(MAKE_DIRECTORY \"\${folder}\")
    execute_process(COMMAND \"$<TARGET_FILE:${program}>\" --man-pages \"\${folder}\" COMMAND_ERROR_IS_FATAL ANY)")
endforeach()
# The schema of experiment files comes from the tables of all plug-ins of the build. Plug-ins of the user are not among them.
install(CODE "
  set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/swarmanoid\")
  file(MAKE_DIRECTORY \"\${folder}\")
  execute_process(COMMAND \"${CMAKE_COMMAND}\" -E env --unset=SWARMANOID_PLUGIN_PATH \"$<TARGET_FILE:swarmanoid>\" list schema
    WORKING_DIRECTORY \"${CMAKE_BINARY_DIR}\" OUTPUT_FILE \"\${folder}/experiment.xsd\" COMMAND_ERROR_IS_FATAL ANY)")
install(FILES launcher/completion/swarmanoid.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME swarmanoid)
install(FILES launcher/completion/_swarmanoid DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES launcher/completion/swarmanoid.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)

install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/swarmanoid COMPONENT links)  # Debian packages have a file `copyright` instead
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/swarmanoid COMPONENT doc)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/swarmanoid COMPONENT doc PATTERN notebooks EXCLUDE)

# The examples of the pages, for users to copy: the notebooks, and a user directory with all that `swarmanoid new` makes in it.
set(EXAMPLES_FOLDER ${CMAKE_INSTALL_DATADIR}/doc/swarmanoid/examples)
install(DIRECTORY docs/notebooks DESTINATION ${EXAMPLES_FOLDER} COMPONENT doc)
install(CODE "
  set(PROGRAM \"$<TARGET_FILE:swarmanoid>\")
  set(DESTINATION \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${EXAMPLES_FOLDER}/own_code\")
  include(\"${CMAKE_SOURCE_DIR}/cmake/InstallExamples.cmake\")" COMPONENT doc)
