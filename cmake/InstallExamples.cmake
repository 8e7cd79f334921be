# Makes the user directory DESTINATION with one of each thing that the pages about own code make by `swarmanoid new`.
# cmake/SwarmanoidInstall.cmake runs this script at each installation, with PROGRAM (`swarmanoid`) and DESTINATION.
file(REMOVE_RECURSE "${DESTINATION}")
get_filename_component(folder "${DESTINATION}" DIRECTORY)
file(MAKE_DIRECTORY "${folder}")

# Runs `swarmanoid new ARGUMENTS` in a folder.
function(new folder)
  execute_process(COMMAND "${PROGRAM}" new ${ARGN} WORKING_DIRECTORY "${folder}" OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()

new("${folder}" user "${DESTINATION}")
# Copies of the samples are elsewhere. The directory is for any installation, and is not under version control.
file(GLOB samples "${DESTINATION}/controllers/*" "${DESTINATION}/functions/*" "${DESTINATION}/experiments/*")
file(REMOVE_RECURSE ${samples} "${DESTINATION}/.swarmanoid" "${DESTINATION}/.gitignore")
new("${DESTINATION}" controller walker)
new("${DESTINATION}" behavior-controller sky_watch --robot eyebot)
new("${DESTINATION}" lua avoid)
new("${DESTINATION}" device compass)
new("${DESTINATION}" entity rover)
new("${DESTINATION}" functions spreading)
new("${DESTINATION}" engine gliding)
new("${DESTINATION}" renderer plan)
