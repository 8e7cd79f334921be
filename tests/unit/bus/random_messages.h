// Messages with random contents, and whether ours have the bytes of the type that is made from the IDL, both ways.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/bus/dds/for_tests.h"
#include "common/bus/topics/message_type.h"
#include "swarmanoid.h"
#include "swarmanoidPubSubTypes.h"

namespace swarmanoid
{

inline constexpr int kRounds = 100;

class Random
{
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  std::uint64_t Number() { return engine_(); }
  std::uint32_t Number32() { return static_cast<std::uint32_t>(engine_()); }
  std::size_t Length() { return engine_() % 6; }
  bool Flag() { return engine_() % 2 == 1; }
  double Real()
  {
    return std::ldexp(static_cast<double>(engine_() % 2000001) - 1e6, static_cast<int>(engine_() % 60) - 30);
  }
  std::string Text()
  {
    static const std::string kLetters[] = {"a", "Z", " ", "'", "é", "→", "𝄞", "0"};
    std::string text;
    for (std::size_t k = engine_() % 12; k > 0; --k) text += kLetters[engine_() % 8];
    return text;
  }
  std::vector<double> Reals()
  {
    std::vector<double> reals(Length());
    for (double& real : reals) real = Real();
    return reals;
  }
  std::vector<std::uint32_t> Ascending()
  {
    std::vector<std::uint32_t> numbers;
    std::uint32_t number = 0;
    for (std::size_t k = Length(); k > 0; --k)
      numbers.push_back(number += 1 + static_cast<std::uint32_t>(engine_() % 9));
    return numbers;
  }
  std::vector<char> Bytes()
  {
    std::vector<char> bytes(Length());
    for (char& byte : bytes) byte = static_cast<char>(engine_());
    return bytes;
  }

  // Any bytes: what they mean is looked at by TickLimits.
  Drawing Drawn()
  {
    Drawing drawing;
    for (std::size_t k = Length(); k > 0; --k)
      drawing.shapes.push_back(
          {static_cast<DrawnShape::Kind>(1 + engine_() % 10), Number32(), Number32(), Number32(), Number32()});
    for (std::size_t k = Length(); k > 0; --k) drawing.numbers.push_back(static_cast<float>(Real()));
    for (std::size_t k = Length(); k > 0; --k) drawing.texts.push_back(Text());
    return drawing;
  }

private:
  std::mt19937_64 engine_;
};

// Of a state or a view.
template <class Wire>
inline void SetDrawing(const Drawing& drawing, Wire& wire_message)
{
  for (const DrawnShape& shape : drawing.shapes)
  {
    wire::Shape& one = wire_message.shapes().emplace_back();
    one.kind(static_cast<std::uint32_t>(shape.kind));
    one.frame(shape.frame);
    one.colour(shape.colour);
    one.width_16(shape.width_16);
    one.count(shape.count);
  }
  wire_message.shape_numbers(drawing.numbers);
  wire_message.shape_texts(drawing.texts);
}

template <class Support, class Wire>
inline std::string GeneratedBytes(Wire& wire)
{
  static Support support;  // the largest size of a type takes long to count
  Payload payload(100000);
  EXPECT_TRUE(test::GeneratedWrite(support, &wire, payload));
  return {reinterpret_cast<const char*>(payload.data), payload.length};
}

template <class... Parts>
inline std::string OurBytes(const Parts&... parts)
{
  std::string bytes(PayloadSize(parts...), '?');
  WritePayload(bytes.data(), parts...);
  return bytes;
}

// What we write is what the generated type writes, and what we read of it is what we wrote.
template <class Support, class Message, class Wire>
inline void ExpectSame(const Message& message, Wire& wire)
{
  const std::string theirs = GeneratedBytes<Support>(wire);
  ASSERT_EQ(OurBytes(message), theirs);
  Message read;
  ReadPayload<Message>(theirs, read);
  EXPECT_EQ(OurBytes(read), theirs);
}

template <class Support, class Message, class Wire>
inline void ExpectSame(const MessageHeader& header, const Message& message, Wire& wire)
{
  wire.run(header.run);
  wire.tick(header.tick);
  wire.source(static_cast<std::uint16_t>(header.source));
  wire.incarnation(static_cast<std::uint16_t>(header.incarnation));
  const std::string theirs = GeneratedBytes<Support>(wire);
  ASSERT_EQ(OurBytes(header, message), theirs);
  MessageHeader seen;
  Message read;
  const auto choose = [&](const MessageHeader&) { return &read; };
  EXPECT_EQ(ReadTickPayload<Message>(theirs, seen, choose, [](const MessageHeader&, const Message&) {}), &read);
  EXPECT_EQ(OurBytes(seen, read), theirs);
}

inline MessageHeader RandomHeader(Random& random)
{
  return {random.Number(), random.Number(),           random.Number32() % 65536,
          random.Flag(),   random.Number32() % 65536, random.Flag()};
}

inline AttributeChanges RandomChanges(Random& random)
{
  AttributeChanges changes;
  for (const std::uint32_t slot : random.Ascending()) changes.Add(slot, random.Real());
  return changes;
}

inline std::uint32_t FlagsOf(bool first, bool repeated)
{
  return (first ? wire::FLAG_LAST : 0U) | (repeated ? wire::FLAG_REPEATED : 0U);
}

}  // namespace swarmanoid
