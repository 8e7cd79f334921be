// ManifestAtDeath: completes the manifest of a run if users' code or the user kills the process, so that the usual end
// is not reached. Used by runs in this process, and by users' programs that are the space server of a cluster.
#pragma once

#include <memory>

#include "simulation/run_folder.h"

namespace swarmanoid
{

// While an object lives; one at a time.
class ManifestAtDeath
{
public:
  // The manifest as it is now; end, exit code and failure are added.
  ManifestAtDeath(const RunFolder& folder, const Manifest& manifest);
  ~ManifestAtDeath();
  ManifestAtDeath(const ManifestAtDeath&) = delete;
  ManifestAtDeath& operator=(const ManifestAtDeath&) = delete;

  // The data of the signal handler, made in advance.
  struct Prepared;

private:
  std::unique_ptr<const Prepared> prepared_;
};

}  // namespace swarmanoid
