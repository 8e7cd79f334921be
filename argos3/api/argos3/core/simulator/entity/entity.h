// What stands in the arena, as loop functions see it. One object for each entity, for as long as the experiment runs.
#pragma once

#include <argos3/core/utility/configuration/base_configurable_resource.h>
#include <argos3/core/utility/datatypes/any.h>
#include <argos3/core/utility/math/quaternion.h>
#include <argos3/core/utility/math/vector3.h>

namespace argos
{

class CComposableEntity;

class CEntity : public CBaseConfigurableResource
{
public:
  using TVector = std::vector<CEntity*>;
  using TMap = std::map<std::string, CEntity*>;

  explicit CEntity(CEntity* parent = nullptr) : parent_(parent) {}
  CEntity(CEntity* parent, std::string id) : id_(std::move(id)), parent_(parent) {}

  void Init(TConfigurationNode&) override {}
  void Reset() override {}
  void Destroy() override {}
  const std::string& GetId() const { return id_; }
  void SetId(const std::string& id) { id_ = id; }
  // "foot-bot", "box", "body" …
  virtual std::string GetTypeDescription() const { return "entity"; }
  bool HasParent() const { return parent_ != nullptr; }
  CEntity& GetParent() const { return *parent_; }
  // Entities take part in a run while they are in the arena, whatever this says.
  void Enable() { enabled_ = true; }
  void Disable() { enabled_ = false; }
  void SetEnabled(bool enabled) { enabled_ = enabled; }
  bool IsEnabled() const { return enabled_; }
  void Update() {}
  CEntity& GetRootEntity() { return parent_ == nullptr ? *this : parent_->GetRootEntity(); }

private:
  std::string id_;
  CEntity* parent_;
  bool enabled_ = true;
};

}  // namespace argos
