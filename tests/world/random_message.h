// An archive (common/bus/topics/cdr.h) that fills any message with random values that may be sent.
#pragma once

#include <cmath>
#include <numeric>
#include <random>
#include <string_view>

#include "common/bus/topics/message_bytes.h"

namespace swarmanoid
{

class RandomMessage
{
public:
  static constexpr bool kReads = true;

  explicit RandomMessage(unsigned seed) : engine_(seed) {}

  template <class Message>
  void Fill(Message& message)
  {
    Fields(*this, message);
  }
  template <class Message>
  void Fill(MessageHeader& header, Message& message)
  {
    Fields(*this, header);
    Fields(*this, header, message);
  }
  double Real()
  {
    return std::ldexp(static_cast<double>(engine_() % 2000001) - 1e6, static_cast<int>(engine_() % 60) - 30);
  }
  // Poses of entities of which some columns have one value.
  std::vector<double> Poses(std::size_t entities, std::uint32_t uniform)
  {
    std::vector<double> poses;
    for (std::uint32_t k = 0; k < kPoseColumns; ++k)
    {
      const double same = k == 2 ? -0.0 : Real();
      for (std::size_t e = 0; e < entities; ++e)
        poses.push_back(uniform >> k & 1U ? same : same + 1 + static_cast<double>(e * (4 - e)));
    }
    return poses;
  }

  void Version(const char*, std::uint32_t& value) { value = kProtocolVersion; }
  void Constant(const char*, std::uint32_t) {}
  template <class T>
  void Integer(const char*, T& value)
  {
    value = static_cast<T>(engine_());
  }
  void Signed(const char*, std::int64_t& value) { value = static_cast<std::int64_t>(engine_()); }
  void Short(const char*, std::uint32_t& value) { value = engine_() % 65536; }
  void Bool(const char*, bool& value) { value = engine_() % 2 == 1; }
  void Number(const char*, double& value) { value = Real(); }
  void Measured(const char*, double& value) { value = engine_() % 2 == 1 ? HUGE_VAL : Real(); }
  template <class Enum>
  void Choice(const char*, Enum& value, Enum last)
  {
    value = static_cast<Enum>(1 + engine_() % static_cast<std::uint32_t>(last));
  }
  void Poses(const char*, std::vector<double>& poses, std::initializer_list<FlagBit> flags)
  {
    poses = Poses(engine_() % 5, static_cast<std::uint32_t>(engine_() % 128));
    Flags("flags", flags);
  }
  std::uint32_t Flags(const char* field, std::initializer_list<FlagBit> flags, std::uint32_t = 0)
  {
    for (const FlagBit& flag : flags) Bool(field, *flag.value);
    return 0;
  }
  void Exact(const char* field, std::string& text) { Line(field, text); }
  void Line(const char*, std::string& text)
  {
    static const std::string kLetters[] = {"a", "Z", " ", "'", "é", "→", "𝄞", "0"};
    text.clear();
    for (std::size_t k = engine_() % 12; k > 0; --k) text += kLetters[engine_() % 8];
  }
  void Lines(const char* field, std::string& text)
  {
    Line(field, text);
    text += "\n";
  }
  void LinesList(const char* field, std::vector<std::string>& texts)
  {
    texts.resize(Length());
    for (std::string& text : texts) Lines(field, text);
  }
  template <class T>
  void Array(const char* field, std::vector<T>& values)
  {
    const std::string_view name = field;
    values.resize(name == "slots" || name == "bytes" ? wanted_ : Length());
    for (T& value : values) value = static_cast<T>(engine_() % 3 + 1);
    if constexpr (std::is_same_v<T, double>)
      for (double& value : values) value = Real();
    // Slots are as many as values, and ascend. Bytes are as many as the sizes say.
    wanted_ = values.size();
    if constexpr (std::is_same_v<T, std::uint32_t>)
    {
      if (name == "slots") std::partial_sum(values.begin(), values.end(), values.begin());
      if (name == "sizes") wanted_ = std::accumulate(values.begin(), values.end(), std::size_t{0});
    }
  }
  template <class T>
  void List(const char*, std::vector<T>& list)
  {
    list.resize(Length());
    for (T& item : list) Fields(*this, item);
  }
  template <class T>
  void Struct(const char*, T& value)
  {
    Fields(*this, value);
  }
  template <class... T>
  void Alternative(const char*, std::variant<T...>& value)
  {
    const std::variant<T...> kinds[] = {T()...};
    value = kinds[engine_() % sizeof...(T)];
  }

private:
  std::size_t Length() { return engine_() % 6; }

  std::mt19937_64 engine_;
  std::size_t wanted_ = 0;
};

}  // namespace swarmanoid
