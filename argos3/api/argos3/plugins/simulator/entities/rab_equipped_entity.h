// The range-and-bearing equipment of a robot, as loop functions see it.
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
  // Return the position of its antenna, 0.1 m above the base of the robot, and the robot's heading.
  const CVector3& GetPosition() const override;
  const CQuaternion& GetOrientation() const override;
  CEmbodiedEntity& GetEntityBody() const;
  // Returns the bytes that it sent in the latest step; zeros if it sends nothing. Bytes written into the result are
  // sent, as by SetData, when the current function of the loop functions ends. These functions throw CARGoSException
  // outside loop functions, and for a robot outside the arena.
  CByteArray& GetData();
  // Sends the bytes: others receive them in the next step, unless its controller sends other bytes until then. Throws
  // CARGoSException for a size other than that of its messages.
  void SetData(const CByteArray& data);
  void ClearData() { SetData(CByteArray(GetMsgSize())); }
  // Sends zeros, if the robot sends.
  void Reset() override;
  size_t GetMsgSize() const;
  // Returns m, as in the experiment file.
  Real GetRange() const;
  // Throws CARGoSException for another range, since the range of the file is valid for the whole run.
  void SetRange(Real range);
  std::string GetTypeDescription() const override { return "rab"; }

private:
  std::shared_ptr<CByteArray> data_ = std::make_shared<CByteArray>();
};

}  // namespace argos
