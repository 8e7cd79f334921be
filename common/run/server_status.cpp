#include "common/run/server_status.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <tuple>
#include <utility>

namespace swarmanoid
{
namespace
{

// A hash, in 16 hexadecimal digits.
template <class Line>
struct Hash
{
  std::uint64_t Line::*member;
};

// A text without blanks.
template <class Line>
struct Word
{
  std::string Line::*member;
};

// Each kind of line has a word and its fields in their order. At most one field is a text, which may hold blanks.
template <class Line>
struct Form;

template <>
struct Form<ServerState>
{
  static constexpr std::string_view word = "state";
  static constexpr std::tuple fields{&ServerState::phase, &ServerState::waiting_for};
};
template <>
struct Form<ServerTick>
{
  static constexpr std::string_view word = "tick";
  static constexpr std::tuple fields{&ServerTick::tick, &ServerTick::max, &ServerTick::real_time_factor};
};
template <>
struct Form<ServerStall>
{
  static constexpr std::string_view word = "stalled";
  static constexpr std::tuple fields{&ServerStall::name, &ServerStall::seconds};
};
template <>
struct Form<ServerWarning>
{
  static constexpr std::string_view word = "warning";
  static constexpr std::tuple fields{&ServerWarning::text};
};
template <>
struct Form<ServerAsked>
{
  static constexpr std::string_view word = "asked";
  static constexpr std::tuple fields{&ServerAsked::text};
};
template <>
struct Form<ServerError>
{
  static constexpr std::string_view word = "error";
  static constexpr std::tuple fields{&ServerError::text};
};
template <>
struct Form<ServerLeft>
{
  static constexpr std::string_view word = "left";
  static constexpr std::tuple fields{&ServerLeft::name};
};
template <>
struct Form<ServerLost>
{
  static constexpr std::string_view word = "lost";
  static constexpr std::tuple fields{&ServerLost::name};
};
template <>
struct Form<ServerMove>
{
  static constexpr std::string_view word = "move";
  static constexpr std::tuple fields{Word<ServerMove>{&ServerMove::machine}, &ServerMove::name};
};
template <>
struct Form<ServerReset>
{
  static constexpr std::string_view word = "reset";
  static constexpr std::tuple fields{&ServerReset::seed, &ServerReset::paused, &ServerReset::real_time_factor};
};
template <>
struct Form<ServerHosts>
{
  static constexpr std::string_view word = "hosts";
  static constexpr std::tuple fields{&ServerHosts::machines};
};
template <>
struct Form<ServerFinished>
{
  static constexpr std::string_view word = "finished";
  static constexpr std::tuple fields{&ServerFinished::ticks, &ServerFinished::entities,
                                     Hash<ServerFinished>{&ServerFinished::hash}, &ServerFinished::wall_s,
                                     &ServerFinished::real_time_factor};
};

// The words are in the order of ServerState::Phase.
constexpr std::array<std::string_view, 4> kPhases{"loading", "waiting", "running", "paused"};

std::string Written(std::uint64_t value) { return fmt::format("{}", value); }
std::string Written(double value) { return fmt::format("{}", value); }
std::string Written(bool value) { return value ? "1" : "0"; }
std::string Written(ServerState::Phase phase) { return std::string(kPhases[phase]); }
std::string Written(const std::string& text)
{
  std::string line = text;
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return line;
}

template <class Line, class Value>
std::string WrittenField(const Line& line, Value Line::*member)
{
  return Written(line.*member);
}
template <class Line>
std::string WrittenField(const Line& line, Hash<Line> hash)
{
  return fmt::format("{:016x}", line.*hash.member);
}

template <class Line>
std::string WrittenField(const Line& line, Word<Line> word)
{
  return Written(line.*word.member);
}

template <class Number, class... Base>
bool ReadNumber(std::string_view word, Number& value, Base... base)
{
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value, base...);
  return error == std::errc() && end == word.data() + word.size();
}
bool ReadWord(std::string_view word, std::uint64_t& value) { return ReadNumber(word, value); }
// All double fields are times and rates.
bool ReadWord(std::string_view word, double& value)
{
  return ReadNumber(word, value) && std::isfinite(value) && value >= 0;
}
bool ReadWord(std::string_view word, bool& value)
{
  value = word == "1";
  return value || word == "0";
}
bool ReadWord(std::string_view word, ServerState::Phase& phase)
{
  for (std::size_t k = 0; k < kPhases.size(); ++k)
    if (word == kPhases[k])
    {
      phase = static_cast<ServerState::Phase>(k);
      return true;
    }
  return false;
}
template <class Line, class Value>
bool ReadField(std::string_view word, Line& line, Value Line::*member)
{
  return ReadWord(word, line.*member);
}
template <class Line>
bool ReadField(std::string_view word, Line& line, Hash<Line> hash)
{
  return word.size() <= 16 && ReadNumber(word, line.*hash.member, 16);
}

template <class Line>
bool ReadField(std::string_view word, Line& line, Word<Line> field)
{
  line.*field.member = Written(std::string(word));
  return !word.empty();
}

// Removes the word at one end of the text and returns it.
std::string_view TakeFirst(std::string_view& text)
{
  const std::size_t end = text.find(' ');
  const std::string_view word = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  return word;
}
std::string_view TakeLast(std::string_view& text)
{
  const std::size_t blank = text.rfind(' ');
  const std::string_view word = blank == std::string_view::npos ? text : text.substr(blank + 1);
  text = text.substr(0, blank == std::string_view::npos ? 0 : blank);
  return word;
}

template <class Line>
constexpr bool IsText(std::string Line::*)
{
  return true;
}
constexpr bool IsText(...) { return false; }

// Reads the fields before the text from the front and those after it from the back. The rest is the text.
template <class Line, std::size_t kField = 0>
bool ReadFields(std::string_view text, Line& line)
{
  constexpr auto kCount = std::tuple_size_v<decltype(Form<Line>::fields)>;
  if constexpr (kField == kCount)
  {
    return text.empty();
  }
  else if constexpr (constexpr auto field = std::get<kField>(Form<Line>::fields); IsText(field))
  {
    static_assert(kField + 2 >= kCount, "at most one field follows the text");
    if constexpr (kField + 1 < kCount)
    {
      if (!ReadField(TakeLast(text), line, std::get<kField + 1>(Form<Line>::fields)) || text.empty()) return false;
    }
    line.*field = Written(std::string(text));  // may be shown on a terminal
    return true;
  }
  else
  {
    return ReadField(TakeFirst(text), line, field) && ReadFields<Line, kField + 1>(text, line);
  }
}

bool MakesSense(const ServerState& line) { return line.phase == ServerState::kWaiting || line.waiting_for.empty(); }
bool MakesSense(const ServerMove& line) { return !line.name.empty(); }
bool MakesSense(const ServerHosts& line) { return !line.machines.empty(); }
template <class Line>
bool MakesSense(const Line&)
{
  return true;
}

template <class... Lines>
std::optional<ServerStatus> ReadLine(std::string_view text, std::variant<Lines...>*)
{
  const std::string_view word = TakeFirst(text);
  std::optional<ServerStatus> status;
  const auto read = [&]<class Line>(Line line)
  {
    if (word == Form<Line>::word && ReadFields(text, line) && MakesSense(line)) status = std::move(line);
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
        std::string text(Form<Line>::word);
        const auto add = [&](const std::string& field) { text += field.empty() ? "" : " " + field; };
        std::apply([&](const auto&... field) { (add(WrittenField(line, field)), ...); }, Form<Line>::fields);
        return text;
      },
      status);
}

std::optional<ServerStatus> ParseServerStatus(std::string_view line)
{
  return ReadLine(line, static_cast<ServerStatus*>(nullptr));
}

}  // namespace swarmanoid
