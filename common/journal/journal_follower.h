// JournalFollower: reads the journal of a run that may still continue, for renderers that look back meanwhile. It skips
// damaged blocks. One thread of any process on the machine of the run's folder uses it.
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
  // `path`: as for JournalReader; the file need not exist yet.
  explicit JournalFollower(std::string path) : path_(std::move(path)) {}

  // Reads blocks that were written, and drops blocks that were deleted, since the last call. Throws std::runtime_error
  // if the files cannot be read.
  void Refresh();
  // Returns false until the first block has been read.
  bool IsBegun() const { return !places_.empty(); }
  const JournalStart& Start() const { return start_; }
  const std::vector<JournalPlace>& Places() const override { return places_; }
  std::vector<char> Content(const JournalPlace& place) const override;
  std::uint64_t FirstTick() const { return FirstTickOf(start_, places_); }
  std::uint64_t EndTick() const { return EndTickOf(start_, places_); }

private:
  // Reads the block at offset_. Returns false if the rest of the file is no whole block yet.
  bool ReadBlock(const RegularFile& file);

  std::string path_;
  JournalStart start_;
  bool has_start_ = false;
  std::vector<JournalPlace> places_;
  std::uint32_t segment_ = 0;
  std::uint64_t offset_ = 0;  // position of the first unread byte in the newest segment
};

}  // namespace swarmanoid
