# CPack runs this file between installing and packing. It adds the files that Debian requires in every package.
set(names_core swarmanoid-core)
set(names_pictures swarmanoid)
set(names_dev swarmanoid-dev)
set(names_doc swarmanoid-doc)
set(names_python python3-swarmanoid)

# All files that are written here have one date: that of the sources.
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  set(epoch $ENV{SOURCE_DATE_EPOCH})
else()
  execute_process(COMMAND git -C ${CMAKE_CURRENT_LIST_DIR} log -1 --format=%ct OUTPUT_VARIABLE epoch
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT epoch)
    string(TIMESTAMP epoch "%s" UTC)
  endif()
endif()
execute_process(COMMAND date --utc --rfc-email --date=@${epoch} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component})
  set(folder ${root}/usr/share/doc/${names_${component}})
  file(MAKE_DIRECTORY ${folder})
  configure_file(${CMAKE_CURRENT_LIST_DIR}/copyright ${folder}/copyright COPYONLY)
  file(WRITE ${folder}/changelog "swarmanoid (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n"
    "  * CHANGELOG.md in the package swarmanoid-doc has all changes.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  set(packed ${folder}/changelog)

  file(GLOB_RECURSE files ${root}/usr/share/man/*.1)
  list(APPEND packed ${files})
  execute_process(COMMAND gzip --best --no-name --force ${packed} COMMAND_ERROR_IS_FATAL ANY)

  # The system finds the libraries without a path, so the paths in the files are removed.
  file(GLOB_RECURSE files LIST_DIRECTORIES FALSE ${root}/usr/bin/* ${root}/usr/libexec/* ${root}/usr/lib/*.so ${root}/usr/lib/*.so.*)
  foreach(file IN LISTS files)
    if(IS_SYMLINK ${file})
      continue()
    endif()
    file(READ ${file} magic LIMIT 4 HEX)
    if(magic STREQUAL 7f454c46)
      file(RPATH_REMOVE FILE ${file})
    endif()
  endforeach()
  file(GLOB overrides ${CMAKE_CURRENT_LIST_DIR}/${names_${component}}.lintian-overrides)
  if(overrides)
    configure_file(${overrides} ${root}/usr/share/lintian/overrides/${names_${component}} COPYONLY)
  endif()
endforeach()
