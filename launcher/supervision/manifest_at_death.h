// ManifestAtDeath: completes the manifest of a run if users' code or the user kills the process, so that the usual end
// is not reached. Runs in this process use it, and so do users' programs that are the space server of a cluster.
#pragma once

#include <memory>

#include "simulation/run_folder.h"

namespace swarmanoid
{

// It is active while the object lives. Only one object may exist at a time.
class ManifestAtDeath
{
public:
  // Takes the manifest as it is now; end, exit code and failure are added at the death.
  ManifestAtDeath(const RunFolder& folder, const Manifest& manifest);
  ~ManifestAtDeath();
  ManifestAtDeath(const ManifestAtDeath&) = delete;
  ManifestAtDeath& operator=(const ManifestAtDeath&) = delete;

  // The signal handler needs this data, which is made in advance.
  struct Prepared;

private:
  std::unique_ptr<const Prepared> prepared_;
};

}  // namespace swarmanoid
