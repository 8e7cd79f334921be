# The reference of reproducible_math_test.cpp, with 113 bits.
target_link_libraries(unit_math PRIVATE quadmath)
