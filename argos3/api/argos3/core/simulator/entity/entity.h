// CEntity: an entity of the arena, as loop functions see it. There is one object for each entity, as long as the
// experiment runs.
#pragma once

#include <argos3/core/utility/configuration/base_configurable_resource.h>
#include <argos3/core/utility/datatypes/any.h>
#include <argos3/core/utility/math/quaternion.h>
#include <argos3/core/utility/math/vector3.h>
#include <argos3/core/utility/plugins/refused.h>

#include <sys/types.h>

namespace argos
{

class CComposableEntity;

class CEntity : public CBaseConfigurableResource
{
public:
  using TVector = std::vector<CEntity*>;
  using TMap = std::map<std::string, CEntity*>;
  using TMultiMap = std::multimap<std::string, CEntity*>;

  explicit CEntity(CEntity* parent = nullptr) : parent_(parent) {}
  CEntity(CEntity* parent, std::string id) : id_(std::move(id)), parent_(parent) {}

  void Init(TConfigurationNode&) override {}
  void Reset() override {}
  void Destroy() override {}
  const std::string& GetId() const { return id_; }
  void SetId(const std::string& id) { id_ = id; }
  // Returns the type: "foot-bot", "box", "body" …
  virtual std::string GetTypeDescription() const { return "entity"; }
  // Returns the ids of all entities that contain this one, each followed by a dot.
  std::string GetContext() const { return parent_ == nullptr ? "" : parent_->GetContext() + parent_->GetId() + "."; }
  bool HasParent() const { return parent_ != nullptr; }
  // Throws CARGoSException if it has no parent.
  CComposableEntity& GetParent() const;
  // Returns the index of its root in the arena; -1 before it is added.
  ssize_t GetIndex() const { return parent_ == nullptr ? index_ : parent_->GetIndex(); }
  void SetIndex(ssize_t index) { index_ = index; }
  void Enable() { SetEnabled(true); }
  void Disable() { SetEnabled(false); }
  // Sets a flag that only controllers obey. Bodies and devices take part in a run as long as they are in the arena.
  virtual void SetEnabled(bool enabled) { enabled_ = enabled; }
  bool IsEnabled() const { return enabled_; }
  void Update() {}
  CEntity& GetRootEntity() { return parent_ == nullptr ? *this : parent_->GetRootEntity(); }
  const CEntity& GetRootEntity() const { return parent_ == nullptr ? *this : parent_->GetRootEntity(); }

private:
  std::string id_;
  CEntity* parent_;
  bool enabled_ = true;
  ssize_t index_ = -1;
};

// Orders entities as in the arena.
struct SEntityComparator
{
  bool operator()(const CEntity* a, const CEntity* b) const { return a->GetIndex() < b->GetIndex(); }
  bool operator()(const CEntity& a, const CEntity& b) const { return a.GetIndex() < b.GetIndex(); }
};

}  // namespace argos
