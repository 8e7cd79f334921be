#include "common/control_interface/init_controller.h"

#include "common/configuration/configuration_reads.h"
#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

// Returns a message such as "the controller 'c' (walker) never reads the parameter 'velocty'; it reads: velocity; did
// you mean 'velocity'?"
ConfigurationError Mistake(const ConfigurationReads::Unread& unread, const ConfigurationNode& root,
                           const std::string& owner)
{
  if (unread.name.empty()) return {unread.location, owner + " never reads the text of <" + root.name + ">"};
  const std::string of = unread.holder == &root ? "" : " of <" + unread.holder->name + ">";
  return {unread.location, owner + " never reads the parameter " + Quoted(unread.name) + of +
                               "; it reads: " + Listed(unread.asked) + DidYouMean(unread.name, unread.asked)};
}

}  // namespace

int InitController(CCI_Controller& controller, const PluginDescription& description, const std::string& id,
                   const TConfigurationTree& parameters)
{
  if (description.declares_parameters || !parameters.Exists()) return controller.Init(parameters);

  const auto reads = std::make_shared<ConfigurationReads>();
  const int result = controller.Init(parameters.RecordedIn(reads));
  if (result != CCI_Controller::RETURN_OK || controller.ReadsParametersLater()) return result;

  const std::vector<ConfigurationReads::Unread> unread = reads->UnreadIn(*parameters.Node());
  if (unread.empty()) return result;
  std::string mistakes;
  for (const ConfigurationReads::Unread& one : unread)
    mistakes += std::string(mistakes.empty() ? "" : "\n") +
                Mistake(one, *parameters.Node(), "the controller '" + id + "' (" + description.label + ")").what();
  throw ConfigurationError(mistakes + "; a controller that asks for it after Init overrides ReadsParametersLater");
}

}  // namespace swarmanoid
