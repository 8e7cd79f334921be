// CMedium: the result of GetMedium of the simulator, for loop functions.
#pragma once

#include <argos3/core/utility/configuration/base_configurable_resource.h>
#include <argos3/core/utility/plugins/refused.h>

namespace argos
{

class CMedium : public CBaseConfigurableResource
{
public:
  using TVector = std::vector<CMedium*>;
  using TMap = std::map<std::string, CMedium*>;

  void Init(TConfigurationNode&) override {}
  void Reset() override {}
  void Destroy() override {}
  // Does nothing, since media have no state here.
  virtual void PostSpaceInit() {}
  // Does nothing, as PostSpaceInit.
  virtual void Update() {}
  const std::string& GetId() const { return id_; }
  void SetId(const std::string& id) { id_ = id; }

private:
  std::string id_;
};

}  // namespace argos
