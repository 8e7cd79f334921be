# cmake -DNODE= -DNPM= -DPAGE=<source> -DBUILD=<folder> -DOUTPUT=<folder> -P build_page.cmake
# Fetches the page's libraries as its lock file says, where that has changed, and bundles the page. Without a network the
# build goes on without it; the next build tries again.
file(MAKE_DIRECTORY ${BUILD})
file(SHA256 ${PAGE}/package-lock.json wanted)
set(fetched)
if(EXISTS ${BUILD}/node_modules/fetched)
  file(READ ${BUILD}/node_modules/fetched fetched)
endif()
if(NOT fetched STREQUAL wanted)
  file(COPY ${PAGE}/package.json ${PAGE}/package-lock.json DESTINATION ${BUILD})
  execute_process(COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error
    WORKING_DIRECTORY ${BUILD} RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE why)
  if(failed)
    message("web_render is left out: npm cannot fetch its libraries (see ${PAGE}/package-lock.json).\n${why}")
    return()
  endif()
  file(WRITE ${BUILD}/node_modules/fetched ${wanted})
endif()

execute_process(COMMAND ${NODE} ${PAGE}/build.mjs ${BUILD}/node_modules ${OUTPUT} RESULT_VARIABLE failed)
if(failed)
  file(REMOVE ${OUTPUT}/index.html)
  message(FATAL_ERROR "the web page cannot be bundled")
endif()
