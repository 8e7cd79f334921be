// The position of an event of expat in the text, for all releases: from 2.9 on, the functions have other names.
#pragma once

#include <expat.h>

namespace swarmanoid
{

// The bytes before the event that expat reports now; -1 after an error.
inline long long CurrentByteIndex(XML_Parser parser)
{
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
  return XML_GetCurrentByteIndex64(parser);
#else
  return XML_GetCurrentByteIndex(parser);
#endif
}

// The bytes of that event; 0 if it has none.
inline long long CurrentByteCount(XML_Parser parser)
{
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
  return static_cast<long long>(XML_GetCurrentByteCount64(parser));
#else
  return XML_GetCurrentByteCount(parser);
#endif
}

}  // namespace swarmanoid
