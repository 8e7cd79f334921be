#include "common/run/server_status.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace swarmanoid
{
namespace
{

// The words are in the order of ServerState::Phase.
constexpr std::array<std::string_view, 4> kPhases{"loading", "waiting", "running", "paused"};

// Texts may be shown on a terminal.
std::string OneLine(std::string_view text)
{
  std::string line(text);
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return line;
}

class LineWriter
{
public:
  explicit LineWriter(std::string_view word) : line_(word) {}
  void Number(std::uint64_t value) { Text(fmt::format("{}", value)); }
  void Number(double value) { Text(fmt::format("{}", value)); }
  void Number(bool value) { Text(value ? "1" : "0"); }
  void Hash(std::uint64_t value) { Text(fmt::format("{:016x}", value)); }
  void Choice(ServerState::Phase phase) { Text(kPhases[phase]); }
  void Word(const std::string& word) { Text(word); }
  void Text(std::string_view text)
  {
    if (!text.empty()) line_ += " " + OneLine(text);
  }
  const std::string& Line() const { return line_; }

private:
  std::string line_;
};

class LineReader
{
public:
  explicit LineReader(std::string_view rest) : rest_(rest) {}
  void Number(std::uint64_t& value) { Require(Read(Take(), value)); }
  // All double fields are times and rates.
  void Number(double& value) { Require(Read(Take(), value) && std::isfinite(value) && value >= 0); }
  void Number(bool& value)
  {
    const std::string_view word = Take();
    value = word == "1";
    Require(value || word == "0");
  }
  void Hash(std::uint64_t& value)
  {
    const std::string_view word = Take();
    Require(word.size() <= 16 && Read(word, value, 16));
  }
  void Choice(ServerState::Phase& phase)
  {
    const auto found = std::ranges::find(kPhases, Take());
    Require(found != kPhases.end());
    phase = static_cast<ServerState::Phase>(found - kPhases.begin());
  }
  void Word(std::string& word)
  {
    word = OneLine(Take());
    Require(!word.empty());
  }
  void Text(std::string& text) { text = OneLine(std::exchange(rest_, {})); }
  // Returns whether all fields had good values, and nothing is left.
  bool IsGood() const { return good_ && rest_.empty(); }

  // Removes the first word of the rest and returns it.
  std::string_view Take()
  {
    const std::size_t end = std::min(rest_.find(' '), rest_.size());
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return word;
  }

private:
  template <class Value, class... Base>
  static bool Read(std::string_view word, Value& value, Base... base)
  {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base...);
    return error == std::errc() && end == word.data() + word.size();
  }
  void Require(bool good) { good_ = good_ && good; }

  std::string_view rest_;
  bool good_ = true;
};

bool MakesSense(const ServerState& line) { return line.phase == ServerState::kWaiting || line.waiting_for.empty(); }
bool MakesSense(const ServerStall& line) { return !line.name.empty(); }
bool MakesSense(const ServerMove& line) { return !line.name.empty(); }
bool MakesSense(const ServerHosts& line) { return !line.text.empty(); }
template <class Line>
bool MakesSense(const Line&)
{
  return true;
}

template <class... Lines>
std::optional<ServerStatus> ReadLine(std::string_view text, std::variant<Lines...>*)
{
  std::optional<ServerStatus> status;
  const auto read = [&]<class Line>(Line line)
  {
    LineReader archive(text);
    if (archive.Take() != Line::word) return;
    Line::Visit(archive, line);
    if (archive.IsGood() && MakesSense(line)) status = std::move(line);
  };
  (read(Lines{}), ...);
  return status;
}

}  // namespace

std::string ServerStatusLine(const ServerStatus& status)
{
  return std::visit(
      []<class Line>(const Line& line)
      {
        LineWriter archive(Line::word);
        Line::Visit(archive, line);
        return archive.Line();
      },
      status);
}

std::optional<ServerStatus> ParseServerStatus(std::string_view line)
{
  return ReadLine(line, static_cast<ServerStatus*>(nullptr));
}

}  // namespace swarmanoid
