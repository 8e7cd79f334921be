# cmake -DESBUILD= -DGZIP= -DPAGE=<source> -DBUILD=<folder> -DOUTPUT=<folder> -P build_page.cmake
# This script fetches three.js from the registry of npm and bundles the page with esbuild. Without a network the build continues
# without the page, and the next build tries again.
cmake_minimum_required(VERSION 3.25)

# `npm view three@VERSION dist.integrity` prints this sum in base 64.
set(THREE three-0.187.0)
set(THREE_SHA512 422bbb47e0a687c0acb59b18d6e24e4969d595fa3b66d34b57b985f0996d9372c1dc0b43bbd71166572744a90093c638cfa28ac37e73ed8ed4addee3598f1eb4)
set(archive ${BUILD}/${THREE}.tgz)
set(url https://registry.npmjs.org/three/-/${THREE}.tgz)

function(read_sum)
  set(sum "" PARENT_SCOPE)
  if(EXISTS ${archive})
    file(SHA512 ${archive} read)
    set(sum ${read} PARENT_SCOPE)
  endif()
endfunction()

file(MAKE_DIRECTORY ${BUILD})
read_sum()
if(NOT sum STREQUAL THREE_SHA512)
  file(DOWNLOAD ${url} ${archive} STATUS status TLS_VERIFY ON INACTIVITY_TIMEOUT 60)
  read_sum()
  if(NOT sum STREQUAL THREE_SHA512)
    list(GET status 0 failed)
    list(GET status 1 why)
    if(NOT failed)
      set(why "what came is not the expected file")
    endif()
    file(REMOVE ${archive})
    message("web_render is left out: cannot fetch ${url}: ${why}. The next build tries again; or bring the file by hand, as ${archive}")
    return()
  endif()
endif()
set(modules ${BUILD}/node_modules)
if(NOT EXISTS ${modules}/${THREE})
  file(REMOVE_RECURSE ${modules} ${BUILD}/package)
  file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${BUILD})
  file(MAKE_DIRECTORY ${modules})
  file(RENAME ${BUILD}/package ${modules}/three)
  file(TOUCH ${modules}/${THREE})
endif()

# Parts of an earlier bundle have other names, so they are removed.
file(REMOVE_RECURSE ${OUTPUT}/index.html)
file(GLOB earlier ${OUTPUT}/*.js ${OUTPUT}/*.css ${OUTPUT}/*.js.gz ${OUTPUT}/*.css.gz)
if(earlier)
  file(REMOVE ${earlier})
endif()
# With splitting, the browser loads the three-dimensional view only when it is needed.
execute_process(
  COMMAND ${CMAKE_COMMAND} -E env NODE_PATH=${modules} ${ESBUILD} ${PAGE}/src/main.js ${PAGE}/src/style.css ${PAGE}/src/view/graphics_worker.js
    --bundle --splitting --minify --format=esm --target=es2022 --legal-comments=none --log-level=warning
    --entry-names=[name] --outdir=${OUTPUT} --metafile=${BUILD}/parts.json
  WORKING_DIRECTORY ${BUILD} RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "the web page cannot be bundled")
endif()
# Pages that have their run contain all scripts, since they have no server.
execute_process(
  COMMAND ${CMAKE_COMMAND} -E env NODE_PATH=${modules} ${ESBUILD} ${PAGE}/src/main.js
    --bundle --minify --format=esm --target=es2022 --legal-comments=none --log-level=warning --outfile=${BUILD}/standalone.js
  WORKING_DIRECTORY ${BUILD} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${GZIP} --best --no-name --stdout ${BUILD}/standalone.js OUTPUT_FILE ${OUTPUT}/standalone.js.gz COMMAND_ERROR_IS_FATAL ANY)
file(GLOB bundled ${OUTPUT}/*.js ${OUTPUT}/*.css)
execute_process(COMMAND ${GZIP} --best --no-name --keep --force ${bundled} COMMAND_ERROR_IS_FATAL ANY)
file(READ ${modules}/three/LICENSE licence)
file(WRITE ${OUTPUT}/licences.txt "This page contains three.js (https://threejs.org).\n\n${licence}")

# The page requests the direct imports of main.js together with it. index.html is written last, because it tells the build that all
# files exist.
file(READ ${BUILD}/parts.json parts)
string(JSON count LENGTH "${parts}" outputs)
set(links)
foreach(index RANGE 1 ${count})
  math(EXPR index "${index} - 1")
  string(JSON output MEMBER "${parts}" outputs ${index})
  if(output MATCHES "(^|/)main\\.js$")
    string(JSON imports LENGTH "${parts}" outputs ${output} imports)
    foreach(at RANGE 1 ${imports})
      math(EXPR at "${at} - 1")
      string(JSON kind GET "${parts}" outputs ${output} imports ${at} kind)
      string(JSON path GET "${parts}" outputs ${output} imports ${at} path)
      get_filename_component(name ${path} NAME)
      if(kind STREQUAL "import-statement")
        string(APPEND links "<link rel=\"modulepreload\" href=\"${name}\" />\n    ")
      endif()
    endforeach()
  endif()
endforeach()
file(COPY ${PAGE}/static/ DESTINATION ${OUTPUT} PATTERN index.html EXCLUDE)
file(READ ${PAGE}/static/index.html html)
string(REPLACE "<script" "${links}<script" html "${html}")
file(WRITE ${OUTPUT}/index.html "${html}")
