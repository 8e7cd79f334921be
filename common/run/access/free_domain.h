// Chooses a DDS domain that no process on this machine uses. The launcher and tests use it.
#pragma once

namespace swarmanoid
{

// A domain kept from other callers of this class until the object ends. Throws BusError if all are taken.
class FreeDomain
{
public:
  FreeDomain();
  ~FreeDomain();
  FreeDomain(const FreeDomain&) = delete;
  FreeDomain& operator=(const FreeDomain&) = delete;

  int Id() const { return id_; }

private:
  int id_ = -1;
  int lock_ = -1;
};

}  // namespace swarmanoid
