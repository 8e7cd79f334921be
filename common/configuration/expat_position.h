// These functions give the position of an event of expat in the text. Expat 2.9 renamed them; this header works with
// all releases.
#pragma once

#include <expat.h>

namespace swarmanoid
{

// Returns the number of bytes before the current event of expat; -1 after an error.
inline long long CurrentByteIndex(XML_Parser parser)
{
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
  return XML_GetCurrentByteIndex64(parser);
#else
  return XML_GetCurrentByteIndex(parser);
#endif
}

// Returns the number of bytes of that event; 0 if it has none.
inline long long CurrentByteCount(XML_Parser parser)
{
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
  return static_cast<long long>(XML_GetCurrentByteCount64(parser));
#else
  return XML_GetCurrentByteCount(parser);
#endif
}

}  // namespace swarmanoid
