// Keeps the port and the token of a page from one start of an experiment to the next, so that an open page continues
// when the experiment starts again. Used by web_render. Only the user can access the file.
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
  // Opens the file of an experiment in `folder`, which is made if needed, and locks it while the object lives. If two
  // runs of one experiment overlap, the second keeps nothing. An empty folder keeps nothing.
  KeptAddress(const std::filesystem::path& folder, std::string_view experiment);
  ~KeptAddress();
  KeptAddress(const KeptAddress&) = delete;
  KeptAddress& operator=(const KeptAddress&) = delete;

  // Return the values of the last start; 0 and empty if there was none.
  std::uint16_t Port() const { return port_; }
  const std::string& Token() const { return token_; }
  // Stores the values for the next start. Returns false if that fails; `Trouble` has the reason.
  bool Keep(std::uint16_t port, const std::string& token);
  const std::string& Trouble() const { return trouble_; }

private:
  void Read();

  int file_ = -1;
  std::uint16_t port_ = 0;
  std::string token_;
  std::string trouble_;
};

// Returns the folder for the persistent state of the user's programs: swarmanoid/web in XDG_STATE_HOME, or else in
// ~/.local/state. Empty if neither is known.
std::filesystem::path StateFolder();

}  // namespace swarmanoid
