// CCommandLineArgParser: parses the options of a user's program: --name value, --flag, -n value, -f, -fg (several
// flags).
#pragma once

#include <argos3/core/utility/logging/argos_log.h>
#include <argos3/core/utility/string_utilities.h>

#include <memory>

namespace argos
{

class CCommandLineArgParser
{
public:
  virtual ~CCommandLineArgParser() = default;

  // Adds an option without a value. `flag` is false until Parse finds the option. `long_option` has no hyphens in
  // front.
  void AddFlag(char short_option, const std::string& long_option, const std::string& description, bool& flag)
  {
    flag = false;
    Add(short_option, long_option, description, true, flag);
  }
  template <class T>
  void AddArgument(char short_option, const std::string& long_option, const std::string& description, T& value)
  {
    Add(short_option, long_option, description, false, value);
  }
  // Prints the options with their descriptions.
  virtual void PrintUsage(CARGoSLog& log);
  // Throws CARGoSException for an unknown option, one without its value, and any other word.
  virtual void Parse(SInt32 count, char** words);

private:
  struct SOption
  {
    char short_option;
    std::string long_option;
    std::string description;
    bool is_flag;
    std::function<void(const std::string&)> set;
  };
  template <class T>
  void Add(char short_option, const std::string& long_option, const std::string& description, bool is_flag, T& value)
  {
    options_.push_back(
        {short_option, long_option, description, is_flag, [&value](const std::string& text) { Read(text, value); }});
  }
  template <class T>
  static void Read(const std::string& text, T& value)
  {
    value = FromString<T>(text);
  }
  // Keeps the blanks.
  static void Read(const std::string& text, std::string& value) { value = text; }
  template <class Matches>
  const SOption& Find(const std::string& word, Matches matches) const;

  std::vector<SOption> options_;
};

}  // namespace argos
