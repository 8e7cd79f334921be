// ClusterTest: a folder, a DDS domain and an experiment for each test of real clusters.
#pragma once

#include <gmock/gmock.h>

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "common/messages/control_verbs.h"
#include "common/run/access/free_domain.h"
#include "tests/cluster/child_process.h"
#include "tests/eventually.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{

using test::Eventually;

// Reads "step 7" as `swarmanoid control` does.
inline ControlOrder OrderOf(const std::string& text)
{
  std::istringstream stream(text);
  std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  return ParseOrder(*FindControlVerb(words[0]), {}, {words.begin() + 1, words.end()});
}

class ClusterTest : public testing::Test
{
protected:
  ClusterTest();
  ~ClusterTest() override;

  // Writes an experiment with 12 diffusing footbots in a walled arena, shared by 1 to 3 engines (e0 …).
  // `visualisation`: an element of <visualisations>. Returns its file, <name>.xml.
  std::string WriteExperiment(const std::string& name, int engines, int ticks, const std::string& visualisation = "");

  ChildProcess StartServer(const std::string& file, const std::vector<std::string>& options = {});
  ChildProcess StartEngine(const std::string& experiment, int engine);
  ChildProcess StartHost(const std::string& experiment, int host);
  // Starts all engines and hosts.
  std::vector<ChildProcess> StartWorkers(const std::string& experiment, int engines, int hosts);
  ChildProcess Start(const std::string& program, const std::vector<std::string>& options);

  std::string DomainText() const { return std::to_string(domain_.Id()); }
  std::string Read(const std::string& file) const;
  // Waits until the hash log has that many ticks. Returns false if it never does.
  bool Reaches(std::ptrdiff_t ticks, const std::string& hash_log = "hashes.txt") const;
  // Sends a request as `swarmanoid control` does. Returns whether it was executed.
  bool Ask(const std::string& experiment, const std::string& verb) const;
  // Returns the hashes of the experiment in one process, one in each line.
  std::string HashesOfSingleProcess(const std::string& file);
  // Checks that no process has left files in shared memory.
  void ExpectNothingLeft() const;

  test::TemporaryFolder temporary_;
  const std::string folder_ = temporary_.Path();
  std::string shared_folder_;
  FreeDomain domain_;
  std::vector<std::string> options_;  // options of every program
  int started_ = 0;
};

}  // namespace swarmanoid
