// What a robot has for range and bearing, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/positional_entity.h>
#include <argos3/core/utility/datatypes/byte_array.h>
#include <argos3/core/utility/datatypes/set.h>

namespace argos
{

class CEmbodiedEntity;

class CRABEquippedEntity : public CPositionalEntity
{
public:
  using TVector = std::vector<CRABEquippedEntity*>;
  using TSet = CSet<CRABEquippedEntity*, SEntityComparator>;

  explicit CRABEquippedEntity(CEntity* parent) : CPositionalEntity(parent, "rab_0") {}
  // Its antenna, 0.1 m above the base of the robot, and the robot's heading.
  const CVector3& GetPosition() const override;
  const CQuaternion& GetOrientation() const override;
  CEmbodiedEntity& GetEntityBody() const;
  // These throw CARGoSException outside loop functions, and for a robot that is not in the arena.
  // What it sent in the latest step; zeros if it sends nothing.
  // What is written into it is sent, as by SetData, when the function of the loop functions ends that asked.
  CByteArray& GetData();
  // Others receive it in the next step, unless its controller sends something else until then. Throws CARGoSException
  // for another size than that of its messages.
  void SetData(const CByteArray& data);
  void ClearData() { SetData(CByteArray(GetMsgSize())); }
  // Zeros, if it sends anything.
  void Reset() override;
  size_t GetMsgSize() const;
  // m, as in the experiment file.
  Real GetRange() const;
  // Throws CARGoSException for another range: it is that of the file for the whole run.
  void SetRange(Real range);
  std::string GetTypeDescription() const override { return "rab"; }

private:
  std::shared_ptr<CByteArray> data_ = std::make_shared<CByteArray>();
};

}  // namespace argos
