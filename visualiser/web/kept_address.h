// The port and the token of a page, kept from one start of an experiment to the next, so that a page that is open goes
// on when the experiment is started again. Used by web_render; the file is the user's alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace swarmanoid
{

class KeptAddress
{
public:
  // Opens the file of an experiment in `folder`, which is made if needed, and keeps others from it while it lives: of
  // two runs of one experiment at the same time the second keeps nothing. An empty folder keeps nothing.
  KeptAddress(const std::filesystem::path& folder, std::string_view experiment);
  ~KeptAddress();
  KeptAddress(const KeptAddress&) = delete;
  KeptAddress& operator=(const KeptAddress&) = delete;

  // Of the last start; 0 and empty if there was none.
  std::uint16_t Port() const { return port_; }
  const std::string& Token() const { return token_; }
  // For the next start. False if it cannot be kept: `Trouble` says why.
  bool Keep(std::uint16_t port, const std::string& token);
  const std::string& Trouble() const { return trouble_; }

private:
  void Read();

  int file_ = -1;
  std::uint16_t port_ = 0;
  std::string token_;
  std::string trouble_;
};

// Where a user's programs keep what outlives them: swarmanoid/web in XDG_STATE_HOME, or else in ~/.local/state. Empty
// if neither is known.
std::filesystem::path StateFolder();

}  // namespace swarmanoid
