// Converts, splits and replaces texts.
#pragma once

#include <argos3/core/utility/configuration/argos_exception.h>
#include <argos3/core/utility/datatypes/datatypes.h>

namespace argos
{

template <class T>
std::string ToString(const T& value)
{
  std::ostringstream text;
  text << std::boolalpha << value;
  return text.str();
}
template <class T>
T FromString(const std::string& text)
{
  T value{};
  std::istringstream stream(text);
  stream >> std::boolalpha >> value;
  return value;
}

// Reads `count` values with `delimiter` between them. Throws CARGoSException if there are fewer.
template <class T>
void ParseValues(std::istream& input, UInt32 count, T* values, char delimiter = '\n')
{
  std::string field;
  for (UInt32 i = 0; i < count; ++i)
  {
    if (!std::getline(input, field, delimiter)) THROW_ARGOSEXCEPTION("expected " << count << " values, found " << i);
    // A field without a value leaves the number as it is, as in ARGoS3.
    std::istringstream stream(field);
    stream >> values[i];
  }
  input.clear();
}
template <class T>
void ParseValues(const std::string& text, UInt32 count, T* values, char delimiter = '\n')
{
  std::istringstream stream(text);
  ParseValues(stream, count, values, delimiter);
}

void Tokenize(const std::string& text, std::vector<std::string>& tokens, const std::string& delimiters = " ");
std::string StringToUpperCase(const std::string& text);
std::string StringToLowerCase(const std::string& text);
void Replace(std::string& text, const std::string& original, const std::string& substitute);
// Returns whether the text matches `pattern`, an extended regular expression.
bool MatchPattern(const std::string& text, const std::string& pattern);
// Replaces $NAME by the value of that environment variable; an unset one stays unchanged.
std::string& ExpandEnvVariables(std::string& text);

}  // namespace argos
