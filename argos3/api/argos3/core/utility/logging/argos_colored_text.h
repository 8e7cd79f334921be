// Colours of texts on terminals, as stream manipulators: std::cerr << argos::red << "text" << argos::reset. Logs have
// no colours, so LOG leaves them out.
#pragma once

#include <argos3/core/utility/datatypes/datatypes.h>

namespace argos
{

enum EARGoSLogAttributes
{
  ARGOS_LOG_ATTRIBUTE_RESET = 0,
  ARGOS_LOG_ATTRIBUTE_BRIGHT = 1,
  ARGOS_LOG_ATTRIBUTE_DIM = 2,
  ARGOS_LOG_ATTRIBUTE_UNDERSCORE = 3,
  ARGOS_LOG_ATTRIBUTE_BLINK = 5,
  ARGOS_LOG_ATTRIBUTE_REVERSE = 7,
  ARGOS_LOG_ATTRIBUTE_HIDDEN = 8
};

enum EARGoSLogColors
{
  ARGOS_LOG_COLOR_BLACK = 0,
  ARGOS_LOG_COLOR_RED = 1,
  ARGOS_LOG_COLOR_GREEN = 2,
  ARGOS_LOG_COLOR_YELLOW = 3,
  ARGOS_LOG_COLOR_BLUE = 4,
  ARGOS_LOG_COLOR_MAGENTA = 5,
  ARGOS_LOG_COLOR_CYAN = 6,
  ARGOS_LOG_COLOR_WHITE = 7
};

struct SLogColor
{
  SLogColor() = default;
  SLogColor(EARGoSLogAttributes attribute, EARGoSLogColors foreground)
      : Attribute(static_cast<UInt8>(attribute)), Foreground(static_cast<UInt8>(foreground))
  {
  }
  UInt8 Attribute = ARGOS_LOG_ATTRIBUTE_RESET;
  UInt8 Foreground = ARGOS_LOG_COLOR_WHITE;

  friend std::ostream& operator<<(std::ostream& stream, const SLogColor& colour)
  {
    return stream << "\033[" << int{colour.Attribute} << ";" << 30 + int{colour.Foreground} << "m";
  }
};

inline std::ostream& red(std::ostream& stream)
{
  return stream << SLogColor(ARGOS_LOG_ATTRIBUTE_BRIGHT, ARGOS_LOG_COLOR_RED);
}
inline std::ostream& green(std::ostream& stream)
{
  return stream << SLogColor(ARGOS_LOG_ATTRIBUTE_BRIGHT, ARGOS_LOG_COLOR_GREEN);
}
inline std::ostream& yellow(std::ostream& stream)
{
  return stream << SLogColor(ARGOS_LOG_ATTRIBUTE_BRIGHT, ARGOS_LOG_COLOR_YELLOW);
}
inline std::ostream& blue(std::ostream& stream)
{
  return stream << SLogColor(ARGOS_LOG_ATTRIBUTE_BRIGHT, ARGOS_LOG_COLOR_BLUE);
}
inline std::ostream& magenta(std::ostream& stream)
{
  return stream << SLogColor(ARGOS_LOG_ATTRIBUTE_BRIGHT, ARGOS_LOG_COLOR_MAGENTA);
}
inline std::ostream& cyan(std::ostream& stream)
{
  return stream << SLogColor(ARGOS_LOG_ATTRIBUTE_BRIGHT, ARGOS_LOG_COLOR_CYAN);
}
inline std::ostream& white(std::ostream& stream)
{
  return stream << SLogColor(ARGOS_LOG_ATTRIBUTE_BRIGHT, ARGOS_LOG_COLOR_WHITE);
}
inline std::ostream& reset(std::ostream& stream) { return stream << "\033[0m"; }

}  // namespace argos
