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

ControllerRegistration::ControllerRegistration(const char* label, std::unique_ptr<CCI_Controller> (*create)(),
                                               const char* class_name, const char* brief)
{
  PluginDescription description;
  description.label = label;
  description.brief = brief != nullptr ? brief : std::string("controller of class ") + class_name;
  PluginRegistry<CCI_Controller>::Instance().Add(std::move(description), create);
}

}  // namespace swarmanoid
