// What a robot has for range and bearing, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/entity.h>
#include <argos3/core/utility/datatypes/byte_array.h>

namespace argos
{

class CRABEquippedEntity : public CEntity
{
public:
  explicit CRABEquippedEntity(CEntity* parent) : CEntity(parent, "rab_0") {}
  // These throw CARGoSException outside loop functions, and for a robot that is not in the arena.
  // What it sent in the latest step; zeros if it sends nothing.
  const CByteArray& GetData();
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
  CByteArray data_;
};

}  // namespace argos
