find_package(PNG REQUIRED)
target_link_libraries(unit_devices PRIVATE PNG::PNG)
