// Angles, texts, colours, elements of files and the log of the API.
#include <argos3/core/utility/configuration/argos_configuration.h>
#include <argos3/core/utility/datatypes/color.h>
#include <argos3/core/utility/logging/argos_log.h>
#include <argos3/core/utility/math/angles.h>
#include <argos3/core/utility/string_utilities.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <regex>

#include "argos3/library/running.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/math/elementary.h"

namespace argos
{
namespace
{

template <class Change>
std::string WithEach(std::string text, Change change)
{
  for (char& c : text) c = static_cast<char>(change(static_cast<unsigned char>(c)));
  return text;
}

struct NamedColour
{
  const char* name;
  CColor colour;
};
constexpr std::size_t kColours = 20;
const std::array<NamedColour, kColours>& NamedColours()
{
  static const std::array<NamedColour, kColours> colours{
      {{"black", CColor::BLACK},   {"white", CColor::WHITE},   {"red", CColor::RED},
       {"green", CColor::GREEN},   {"blue", CColor::BLUE},     {"magenta", CColor::MAGENTA},
       {"cyan", CColor::CYAN},     {"yellow", CColor::YELLOW}, {"orange", CColor::ORANGE},
       {"brown", CColor::BROWN},   {"purple", CColor::PURPLE}, {"gray10", CColor::GRAY10},
       {"gray20", CColor::GRAY20}, {"gray30", CColor::GRAY30}, {"gray40", CColor::GRAY40},
       {"gray50", CColor::GRAY50}, {"gray60", CColor::GRAY60}, {"gray70", CColor::GRAY70},
       {"gray80", CColor::GRAY80}, {"gray90", CColor::GRAY90}}};
  return colours;
}

// Reads "r,g,b" or "r,g,b,a".
CColor Numbered(const std::string& text)
{
  const auto numbers = static_cast<UInt32>(1 + std::count(text.begin(), text.end(), ','));
  int values[4]{0, 0, 0, 255};
  ParseValues<int>(text, numbers < 4 ? 3 : 4, values, ',');
  for (const int value : values)
    if (value < 0 || value > 255) THROW_ARGOSEXCEPTION("'" << text << "' is no colour: each number is 0 to 255");
  return {static_cast<UInt8>(values[0]), static_cast<UInt8>(values[1]), static_cast<UInt8>(values[2]),
          static_cast<UInt8>(values[3])};
}

std::string& PendingLine()
{
  thread_local std::string line;
  return line;
}

// The angles of the sensors in rings of 24, which controllers ask for at each reading.
class RingAngles
{
public:
  RingAngles()
  {
    for (unsigned sensor = 0; sensor < kSensors; ++sensor)
    {
      const Real angle = CRadians(swarmanoid::CCI_FootBotProximitySensor::AngleOf(sensor)).SignedNormalize().GetValue();
      known_[PlaceOf(angle)] = {angle, swarmanoid::SinCosOf(angle)};
    }
  }
  swarmanoid::SinCos Of(Real angle) const
  {
    // The comparison is false for NaN.
    if (angle > -ARGOS_PI && angle < ARGOS_PI)
      if (const Known& known = known_[PlaceOf(angle)]; known.angle == angle) return known.both;
    return swarmanoid::SinCosOf(angle);
  }

private:
  struct Known
  {
    Real angle;
    swarmanoid::SinCos both;
  };
  static constexpr unsigned kSensors = swarmanoid::CCI_FootBotProximitySensor::NUM_SENSORS;
  static constexpr Real kHalf = kSensors / 2.0;
  // The sensors look along the middles of equal parts of a turn.
  static std::size_t PlaceOf(Real angle) { return static_cast<std::size_t>(angle * (kHalf / ARGOS_PI) + kHalf); }

  std::array<Known, kSensors + 1> known_{};
};

}  // namespace

void SinCos(const CRadians& angle, Real& sine, Real& cosine)
{
  static const RingAngles ring;
  const swarmanoid::SinCos both = ring.Of(angle.GetValue());
  sine = both.sin;
  cosine = both.cos;
}

void Tokenize(const std::string& text, std::vector<std::string>& tokens, const std::string& delimiters)
{
  for (std::size_t start = text.find_first_not_of(delimiters); start != std::string::npos;)
  {
    const std::size_t end = text.find_first_of(delimiters, start);
    tokens.push_back(text.substr(start, end - start));
    start = text.find_first_not_of(delimiters, end);
  }
}

std::string StringToUpperCase(const std::string& text)
{
  return WithEach(text, [](int c) { return std::toupper(c); });
}
std::string StringToLowerCase(const std::string& text)
{
  return WithEach(text, [](int c) { return std::tolower(c); });
}

void Replace(std::string& text, const std::string& original, const std::string& substitute)
{
  if (original.empty()) return;
  for (std::size_t at = text.find(original); at != std::string::npos; at = text.find(original, at + substitute.size()))
    text.replace(at, original.size(), substitute);
}

bool MatchPattern(const std::string& text, const std::string& pattern)
{
  return std::regex_search(text, std::regex(pattern, std::regex::extended));
}

std::string& ExpandEnvVariables(std::string& text)
{
  std::string expanded;
  for (std::size_t i = 0; i < text.size();)
  {
    std::size_t end = i + 1;
    while (text[i] == '$' && end < text.size() &&
           (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_'))
      ++end;
    const std::string name = text.substr(i + 1, end - i - 1);
    const char* value = text[i] == '$' ? std::getenv(name.c_str()) : nullptr;
    expanded += value != nullptr ? std::string(value) : text.substr(i, end - i);
    i = end;
  }
  return text = expanded;
}

void CColor::Set(const std::string& name)
{
  for (const NamedColour& named : NamedColours())
    if (name == named.name)
    {
      *this = named.colour;
      return;
    }
  if (name.find(',') == std::string::npos) THROW_ARGOSEXCEPTION("there is no colour '" << name << "'");
  *this = Numbered(name);
}

std::ostream& operator<<(std::ostream& stream, const CColor& colour)
{
  for (const NamedColour& named : NamedColours())
    if (colour == named.colour) return stream << named.name;
  return stream << int{colour.GetRed()} << "," << int{colour.GetGreen()} << "," << int{colour.GetBlue()} << ","
                << int{colour.GetAlpha()};
}

std::istream& operator>>(std::istream& stream, CColor& colour)
{
  std::string text;
  std::getline(stream, text);
  colour.Set(text);
  stream.clear(stream.rdstate() & ~std::ios::failbit);
  return stream;
}

CARGoSLog LOG("");
CARGoSLog LOGERR("error: ");

CARGoSLog::CARGoSLog(const char* prefix) : prefix_(prefix), stream_(std::cerr.rdbuf()), own_(std::cerr.rdbuf()) {}

CARGoSLog& CARGoSLog::operator<<(std::ostream& (*manipulator)(std::ostream&))
{
  std::ostringstream text;
  text << manipulator;
  constexpr const char* kColour = "\033[";
  if (text.str().rfind(kColour, 0) != 0) Append(text.str());
  return *this;
}

void CARGoSLog::RedirectToFile(const std::string& file)
{
  file_.close();
  file_.clear();
  file_.open(file);
  if (!file_) THROW_ARGOSEXCEPTION("the log file '" << file << "' cannot be written");
  stream_.rdbuf(file_.rdbuf());
}

void CARGoSLog::Append(const std::string& text)
{
  std::string& line = PendingLine();
  for (const char c : text)
  {
    if (c != '\n')
    {
      line += c;
      continue;
    }
    if (stream_.rdbuf() == nullptr || stream_.rdbuf() == own_)
      swarmanoid::argos3::Speaker::Say(prefix_ + line);
    else
      stream_ << prefix_ << line << '\n' << std::flush;
    line.clear();
  }
}

void CCI_LEDsActuator::SetSingleColor(UInt32 led, const CColor& colour)
{
  if (led >= m_tSettings.size())
    THROW_ARGOSEXCEPTION("LED " << led << " of " << m_tSettings.size() << "; the first one is 0");
  m_tSettings[led] = colour;
}

void CCI_LEDsActuator::SetAllColors(const CColor& colour) { std::fill(m_tSettings.begin(), m_tSettings.end(), colour); }

void CCI_LEDsActuator::SetAllColors(const TSettings& colours)
{
  if (colours.size() != m_tSettings.size())
    THROW_ARGOSEXCEPTION(colours.size() << " colours for " << m_tSettings.size() << " LEDs");
  m_tSettings = colours;
}

void CCI_LEDsActuator::SetSingleIntensity(UInt32 led, UInt8 intensity)
{
  if (led >= m_tSettings.size())
    THROW_ARGOSEXCEPTION("LED " << led << " of " << m_tSettings.size() << "; the first one is 0");
  m_tSettings[led].SetAlpha(intensity);
}

void CCI_LEDsActuator::SetAllIntensities(UInt8 intensity)
{
  for (CColor& colour : m_tSettings) colour.SetAlpha(intensity);
}

}  // namespace argos
