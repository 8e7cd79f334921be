// LOG and LOGERR: lines for people. What robots say goes to the log of their process with robot and tick, what loop
// functions say to standard error. A line is written when it ends.
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
  // std::endl and its like.
  CARGoSLog& operator<<(std::ostream& (*manipulator)(std::ostream&));
  void Flush() {}
  void DisableColoredOutput() {}
  void EnableColoredOutput() {}
  bool IsColoredOutput() const { return false; }
  // Lines of each thread stay together anyway.
  void AddThreadSafeBuffer() {}
  // All lines of this process, from now on. Throws CARGoSException if it cannot be written.
  void RedirectToFile(const std::string& file);
  // Given another buffer, all lines of this process go there.
  std::ostream& GetStream() { return stream_; }

private:
  void Append(const std::string& text);

  const char* prefix_;
  std::ostream stream_;
  std::streambuf* own_;  // none: lines go to the log
  std::ofstream file_;
};

extern CARGoSLog LOG;
extern CARGoSLog LOGERR;

// For RLOG and RLOGERR, in a controller.
#define RLOG argos::LOG << "[" << GetId() << "] "
#define RLOGERR argos::LOGERR << "[" << GetId() << "] "

}  // namespace argos
