// Server and worker of a test as if they were processes of their own: within one, messages would be read by the thread
// that writes them.
#pragma once

#include <fastrtps/attributes/LibrarySettingsAttributes.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>

namespace swarmanoid::test
{

class SeparateProcesses
{
public:
  SeparateProcesses() : before_(Profiles::library_settings())
  {
    auto settings = before_;
    settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
    Profiles::library_settings(settings);
  }
  ~SeparateProcesses() { Profiles::library_settings(before_); }
  SeparateProcesses(const SeparateProcesses&) = delete;
  SeparateProcesses& operator=(const SeparateProcesses&) = delete;

private:
  using Profiles = eprosima::fastrtps::xmlparser::XMLProfileManager;

  const eprosima::fastrtps::LibrarySettingsAttributes before_;
};

}  // namespace swarmanoid::test
