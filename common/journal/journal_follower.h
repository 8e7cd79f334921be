// JournalFollower: the journal of a run that may still go on, for those who look back meanwhile. It skips blocks that
// are damaged. Used by one thread of any process of the machine on which the run's folder is.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/configuration/regular_file.h"
#include "common/journal/journal_blocks.h"

namespace swarmanoid
{

class JournalFollower : public JournalBlocks
{
public:
  // `path`: as for JournalReader; the file need not be there yet.
  explicit JournalFollower(std::string path) : path_(std::move(path)) {}

  // Takes in what was written, and what was deleted, since the last call. Throws std::runtime_error if it cannot be
  // read.
  void Refresh();
  // False until the first block was read.
  bool IsBegun() const { return !places_.empty(); }
  const JournalStart& Start() const { return start_; }
  const std::vector<JournalPlace>& Places() const override { return places_; }
  std::vector<char> Content(const JournalPlace& place) const override;
  std::uint64_t FirstTick() const { return FirstTickOf(start_, places_); }
  std::uint64_t EndTick() const { return EndTickOf(start_, places_); }

private:
  // Takes in what begins at offset_. False if the rest of the file is no whole block yet.
  bool ReadBlock(const RegularFile& file);

  std::string path_;
  JournalStart start_;
  bool has_start_ = false;
  std::vector<JournalPlace> places_;
  std::uint32_t segment_ = 0;
  std::uint64_t offset_ = 0;  // of what was not read yet, in the newest segment
};

}  // namespace swarmanoid
