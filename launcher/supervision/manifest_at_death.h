// ManifestAtDeath: completes the manifest of a run whose process dies of somebody's code, or is killed by the user:
// then nobody returns to write it. For runs in this process, and for programs of users that are the space server of a
// cluster.
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

  // What a signal handler needs, made before.
  struct Prepared;

private:
  std::unique_ptr<const Prepared> prepared_;
};

}  // namespace swarmanoid
