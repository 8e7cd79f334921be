// LOG and LOGERR: lines for people. Lines of robots go to the log of their process with robot and tick; those of loop
// functions go to standard error. A line is written when it ends.
#pragma once

#include <argos3/core/utility/datatypes/datatypes.h>
#include <argos3/core/utility/logging/argos_colored_text.h>

#include <ostream>

namespace argos
{

class CARGoSLog
{
public:
  explicit CARGoSLog(const char* prefix);

  template <class T>
  CARGoSLog& operator<<(const T& value)
  {
    std::ostringstream text;
    text << std::boolalpha << value;
    Append(text.str());
    return *this;
  }
  // Handles std::endl and other manipulators.
  CARGoSLog& operator<<(std::ostream& (*manipulator)(std::ostream&));
  void Flush() {}
  void DisableColoredOutput() {}
  void EnableColoredOutput() {}
  bool IsColoredOutput() const { return false; }
  // Does nothing, since lines of different threads are never mixed.
  void AddThreadSafeBuffer() {}
  // Writes all later lines of this process to a file. Throws CARGoSException if it cannot be written.
  void RedirectToFile(const std::string& file);
  // If the stream gets another buffer, all lines of this process go there.
  std::ostream& GetStream() { return stream_; }

private:
  void Append(const std::string& text);

  const char* prefix_;
  std::ostream stream_;
  std::streambuf* own_;  // nullptr: lines go to the log
  std::ofstream file_;
};

extern CARGoSLog LOG;
extern CARGoSLog LOGERR;

// RLOG and RLOGERR are for controllers.
#define RLOG argos::LOG << "[" << GetId() << "] "
#define RLOGERR argos::LOGERR << "[" << GetId() << "] "

}  // namespace argos
