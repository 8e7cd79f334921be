#include "common/control_interface/ci_controller.h"

#include "common/control_interface/ci_state_machine.h"

namespace swarmanoid
{

template <>
PluginRegistry<CCI_Controller>& PluginRegistry<CCI_Controller>::Instance()
{
  static PluginRegistry registry(PluginKind::kController);
  return registry;
}

std::string CCI_Controller::StateName() const { return StateNameOf(dynamic_cast<const CCI_StateMachine*>(this)); }

ControllerRegistration::ControllerRegistration(Create create, const char* class_name, PluginDescription description)
{
  if (description.brief.empty()) description.brief = std::string("controller of class ") + class_name;
  PluginRegistry<CCI_Controller>::Instance().Add(std::move(description), create);
}

ControllerRegistration::ControllerRegistration(Create create, const char* class_name, const char* label,
                                               const char* brief)
    : ControllerRegistration(
          create, class_name,
          PluginDescription{.label = label, .brief = brief != nullptr ? brief : "", .declares_parameters = false})
{
}

}  // namespace swarmanoid
