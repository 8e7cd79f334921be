#include "common/configuration/parameter.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

std::size_t ComponentsOf(ParameterType type) { return type == ParameterType::kVector2 ? 2 : 3; }

std::string WithUnit(double value, const std::string& unit)
{
  return unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

std::string RangeMistake(const ParameterSpec& spec, double value, const std::string& subject)
{
  if (value >= spec.minimum && value <= spec.maximum) return {};
  return fmt::format("{} is {}; it must be {}", subject, WithUnit(value, spec.unit), RangeText(spec));
}

// A large whole number would be rounded to the limit if it were compared as a double.
std::string RangeMistakeOfInteger(const ParameterSpec& spec, long long value, const std::string& subject)
{
  constexpr double kLongest = 9.2e18;  // limits up to this one are whole numbers, too
  const bool is_above = spec.maximum <= kLongest && value > static_cast<long long>(std::floor(spec.maximum));
  const bool is_below = spec.minimum >= -kLongest && value < static_cast<long long>(std::ceil(spec.minimum));
  if (!is_above && !is_below) return RangeMistake(spec, static_cast<double>(value), subject);
  const std::string unit = spec.unit.empty() ? "" : " " + spec.unit;
  return fmt::format("{} is {}{}; it must be {}", subject, value, unit, RangeText(spec));
}

std::string VectorMistake(const ParameterSpec& spec, std::string_view text, const std::string& subject)
{
  const auto numbers = ParseNumbers(text);
  if (!numbers || numbers->size() != ComponentsOf(spec.type))
  {
    return fmt::format("{} is {}; it must be {}", subject, Quoted(text), AllowedText(spec));
  }
  constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};
  for (std::size_t i = 0; i < numbers->size(); ++i)
  {
    std::string mistake = RangeMistake(spec, (*numbers)[i], fmt::format("{} of {}", kAxes[i], subject));
    if (!mistake.empty()) return mistake;
  }
  return {};
}

[[noreturn]] void NotDeclared(std::string_view name)
{
  throw std::logic_error("the parameter '" + std::string(name) + "' is in no table");
}

}  // namespace

std::string RangeText(const ParameterSpec& spec)
{
  const bool low = std::isfinite(spec.minimum);
  const bool high = std::isfinite(spec.maximum);
  if (low && high) return fmt::format("from {} to {}", spec.minimum, WithUnit(spec.maximum, spec.unit));
  if (low) return fmt::format("at least {}", WithUnit(spec.minimum, spec.unit));
  if (high) return fmt::format("at most {}", WithUnit(spec.maximum, spec.unit));
  return {};
}

std::string AllowedText(const ParameterSpec& spec)
{
  const std::string range = RangeText(spec);
  const std::string unit = spec.unit.empty() ? "" : " in " + spec.unit;
  const std::string tail = range.empty() ? "" : ", " + range;
  switch (spec.type)
  {
    case ParameterType::kBoolean:
      return "true or false";
    case ParameterType::kInteger:
      return "a whole number" + unit + tail;
    case ParameterType::kNumber:
      return "a number" + unit + tail;
    case ParameterType::kText:
      return "a text";
    case ParameterType::kChoice:
      return "one of " + Listed(spec.choices);
    case ParameterType::kVector2:
      return "two numbers \"x, y\"" + unit + tail;
    case ParameterType::kVector3:
      return "three numbers \"x, y, z\"" + unit + tail;
    case ParameterType::kPath:
      return "a file name";
    case ParameterType::kColour:
      return "a colour: a name such as red, or #rrggbb, or \"r, g, b\" from 0 to 255";
    case ParameterType::kTree:
      return "free content";
  }
  return {};
}

std::string MistakeIn(const ParameterSpec& spec, std::string_view text, const std::string& subject)
{
  const auto wrong = [&]
  {
    const std::string what = TrimBlanks(text).empty() ? "empty" : Quoted(TrimBlanks(text));
    return fmt::format("{} is {}; it must be {}", subject, what, AllowedText(spec));
  };
  switch (spec.type)
  {
    case ParameterType::kBoolean:
      return ParseBoolean(text) ? std::string() : wrong();
    case ParameterType::kInteger:
    {
      const auto number = ParseInteger(text);
      return number ? RangeMistakeOfInteger(spec, *number, subject) : wrong();
    }
    case ParameterType::kNumber:
    {
      const auto number = ParseNumber(text);
      return number ? RangeMistake(spec, *number, subject) : wrong();
    }
    case ParameterType::kChoice:
    {
      const std::string choice(TrimBlanks(text));
      const bool known = std::find(spec.choices.begin(), spec.choices.end(), choice) != spec.choices.end();
      return known ? std::string() : wrong() + DidYouMean(choice, spec.choices);
    }
    case ParameterType::kVector2:
    case ParameterType::kVector3:
      return VectorMistake(spec, text, subject);
    case ParameterType::kColour:
      return ParseColour(text) ? std::string() : wrong();
    case ParameterType::kPath:
      return TrimBlanks(text).empty() ? wrong() : std::string();
    case ParameterType::kText:
    case ParameterType::kTree:
      return {};
  }
  return {};
}

bool IsNumbered(const ParameterSpec& spec) { return spec.name.ends_with("_n"); }

bool Matches(const ParameterSpec& spec, std::string_view name)
{
  if (!IsNumbered(spec)) return name == spec.name;
  const std::string_view stem = std::string_view(spec.name).substr(0, spec.name.size() - 1);
  if (!name.starts_with(stem)) return false;
  const std::string_view digits = name.substr(stem.size());
  return !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
}

const ParameterSpec& Parameters::SpecOf(std::string_view name) const
{
  for (const ParameterSpec& spec : specs_)
  {
    if (Matches(spec, name)) return spec;
  }
  NotDeclared(name);
}

std::string Parameters::ValueOf(std::string_view name) const
{
  const ParameterSpec& spec = SpecOf(name);
  auto given = tree_.Value(name);
  if (!given && !spec.default_value)
  {
    throw ConfigurationError(tree_.Location(), "<" + tree_.Name() + "> lacks the parameter '" + std::string(name) +
                                                   "': " + AllowedText(spec));
  }
  if (!given) return *spec.default_value;
  const std::string mistake = MistakeIn(spec, *given, "'" + std::string(name) + "'");
  if (!mistake.empty()) throw ConfigurationError(tree_.ValueLocation(name), mistake);
  return *std::move(given);
}

bool Parameters::Boolean(std::string_view name) const { return ParseBoolean(ValueOf(name)).value(); }

long long Parameters::Integer(std::string_view name) const { return ParseInteger(ValueOf(name)).value(); }

double Parameters::Number(std::string_view name) const { return ParseNumber(ValueOf(name)).value(); }

std::string Parameters::Text(std::string_view name) const { return std::string(TrimBlanks(ValueOf(name))); }

Vector2 Parameters::Vector2Of(std::string_view name) const
{
  const auto numbers = ParseNumbers(ValueOf(name)).value();
  return {numbers.at(0), numbers.at(1)};
}

Vector3 Parameters::Vector3Of(std::string_view name) const
{
  const auto numbers = ParseNumbers(ValueOf(name)).value();
  return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

std::uint32_t Parameters::Colour(std::string_view name) const { return ParseColour(ValueOf(name)).value(); }

}  // namespace swarmanoid
