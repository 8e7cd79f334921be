# The tests compare the terrains with these reference libraries.
find_package(octomap 1.9 REQUIRED)
find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)
find_package(ZLIB REQUIRED)
target_link_libraries(unit_space PRIVATE octomap octomath PNG::PNG JPEG::JPEG ZLIB::ZLIB)
