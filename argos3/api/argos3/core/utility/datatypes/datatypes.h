// The number types of ARGoS3. It includes the headers that users' controllers rely on.
#pragma once

#include <argos3/core/config.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <deque>
#include <fstream>
#include <functional>
#include <iomanip>
#include <iostream>
#include <limits>
#include <list>
#include <map>
#include <memory>
#include <numeric>
#include <queue>
#include <random>
#include <set>
#include <sstream>
#include <stack>
#include <string>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

using SInt8 = signed char;
using UInt8 = unsigned char;
using SInt16 = signed short;
using UInt16 = unsigned short;
using SInt32 = signed int;
using UInt32 = unsigned int;
using SInt64 = signed long long;
using UInt64 = unsigned long long;
using Real = double;

namespace argos
{
using ::Real;
using ::SInt16;
using ::SInt32;
using ::SInt64;
using ::SInt8;
using ::UInt16;
using ::UInt32;
using ::UInt64;
using ::UInt8;
}  // namespace argos

// Prints to standard error, as printf.
#ifndef DEBUG
#define DEBUG(...) std::fprintf(stderr, "[DEBUG] " __VA_ARGS__)
#endif
#define DEBUG_FUNCTION_ENTER DEBUG("%s - START\n", __PRETTY_FUNCTION__)
#define DEBUG_FUNCTION_EXIT DEBUG("%s - END\n", __PRETTY_FUNCTION__)
#define TRACE(LINE) \
  LINE;             \
  DEBUG("%s\n", #LINE)
