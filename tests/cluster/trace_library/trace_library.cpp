// A stranger's library: a process that loads it makes the file that SWARMANOID_TEST_TRACE names.
#include <cstdio>
#include <cstdlib>

namespace
{

struct Trace
{
  Trace()
  {
    if (const char* file = std::getenv("SWARMANOID_TEST_TRACE"))
      if (std::FILE* stream = std::fopen(file, "w")) std::fclose(stream);
  }
};
const Trace trace;

}  // namespace
