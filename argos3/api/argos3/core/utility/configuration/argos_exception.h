// CARGoSException and the macros that throw it.
#pragma once

#include <exception>
#include <sstream>
#include <string>

namespace argos
{

class CARGoSException : public std::exception
{
public:
  // `nested` is the cause; its text follows the message.
  explicit CARGoSException(const std::string& message, std::exception* nested = nullptr)
      : text_(nested == nullptr ? message : message + ": " + nested->what())
  {
  }
  const char* what() const noexcept override { return text_.c_str(); }

private:
  std::string text_;
};

}  // namespace argos

// A build with NDEBUG removes it, as it removes assert.
#ifndef NDEBUG
#define ARGOS_ASSERT(CONDITION, MESSAGE)            \
  {                                                 \
    if (!(CONDITION)) THROW_ARGOSEXCEPTION(MESSAGE) \
  }
#else
#define ARGOS_ASSERT(CONDITION, MESSAGE)
#endif
#define THROW_ARGOSEXCEPTION(MESSAGE)                  \
  {                                                    \
    std::ostringstream argos_message;                  \
    argos_message << MESSAGE;                          \
    throw argos::CARGoSException(argos_message.str()); \
  }
#define THROW_ARGOSEXCEPTION_NESTED(MESSAGE, NESTED)              \
  {                                                               \
    std::ostringstream argos_message;                             \
    argos_message << MESSAGE;                                     \
    throw argos::CARGoSException(argos_message.str(), &(NESTED)); \
  }
