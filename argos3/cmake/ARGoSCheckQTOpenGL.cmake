# Projects that found ARGoS3 by pkg-config (argos3_simulator) include this file.
find_package(ARGoS REQUIRED HINTS ${ARGOS_PREFIX})
