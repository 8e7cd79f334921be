// A datagram that CheckRtps accepts is read within its bounds by a reader that trusts each length in it, in the order
// and by the arithmetic of Fast DDS, and counts no further than a run can.
#include <cstdlib>
#include <cstring>
#include <span>

#include "common/bus/dds/check_rtps.h"
#include "tests/fuzz/fuzz_driver.h"
#include "tests/unit/bus/rtps_datagrams.h"

namespace swarmanoid
{
namespace
{

void Promise(bool kept)
{
  if (!kept) std::abort();
}

// Reads in front of itself, and has to find what it reads. Numbers have 32 bits, which overflow as they do there.
class Reader
{
public:
  Reader(std::span<const char> bytes, bool little) : bytes_(bytes), little_(little) {}

  std::uint32_t At() const { return at_; }
  void Skip(std::uint32_t count)
  {
    Promise(count <= bytes_.size() - at_);
    at_ += count;
  }
  std::uint64_t Take(unsigned count)
  {
    Promise(count <= bytes_.size() - at_);
    std::uint64_t value = 0;
    for (unsigned k = 0; k < count; ++k)
      value |= std::uint64_t{static_cast<unsigned char>(bytes_[at_ + (little_ ? k : count - 1 - k)])} << (8 * k);
    at_ += count;
    return value;
  }
  std::uint16_t Short() { return static_cast<std::uint16_t>(Take(2)); }
  std::uint32_t Word() { return static_cast<std::uint32_t>(Take(4)); }
  std::int64_t Number()
  {
    const std::uint64_t high = Take(4);
    return static_cast<std::int64_t>((high << 32U) | Take(4));
  }
  std::span<const char> Rest() const { return bytes_.subspan(at_); }

private:
  std::span<const char> bytes_;
  bool little_;
  std::uint32_t at_ = 0;
};

void ReadText(Reader& from)
{
  const std::uint32_t length = from.Word();
  Promise(length > 0 && length <= from.Rest().size());
  // It is used as a string of C.
  Promise(std::memchr(from.Rest().data(), 0, length) != nullptr);
  from.Skip(std::min<std::uint32_t>((length + 3U) & ~3U, static_cast<std::uint32_t>(from.Rest().size())));
}

void ReadParameter(unsigned id, std::span<const char> value, bool little)
{
  Reader from(value, little);
  Promise(id < 0x1001 || id > 0x1006);
  if (id == 0x05 || id == 0x07 || id == 0x62) ReadText(from);
  if (id == 0x29 || id == 0x59)
    for (std::uint64_t left = std::uint64_t{from.Word()} * (id == 0x59 ? 2 : 1); left > 0; --left) ReadText(from);
  if (id == 0x73)
    for (std::uint32_t left = from.Word(); left > 0; --left) from.Short();
  if (id == 0x8006)
    for (std::uint32_t left = from.Word(); left > 0; --left) from.Take(8);
  if (id == 0x2c || id == 0x2d || id == 0x2e) from.Skip(from.Word());
  if (id == 0x50 || id == 0x5a || id == 0x70) from.Skip(16);
  if (id >= 0x2f && id <= 0x33) from.Skip(24);
  if (id == 0x69 || id == 0x72 || id == 0x75) Promise(value.size() <= 4096);
}

// The bytes of a list, with its end.
std::uint32_t ReadList(std::span<const char> list, bool little)
{
  Reader from(list, little);
  while (true)
  {
    const unsigned id = from.Short();
    const unsigned length = from.Short();
    if (id == 1) return from.At();
    const std::span<const char> value = from.Rest();
    from.Skip(length);
    ReadParameter(id, value.first(length), little);
  }
}

void ReadSet(Reader& from)
{
  const std::uint32_t bits = from.Word();
  Promise(bits <= 256);
  from.Skip((bits + 31) / 32 * 4);
}

// Returns the size of a payload as Fast DDS computes it, by subtraction in 32 bits.
std::uint32_t PayloadOf(std::size_t submessage, unsigned to_qos, std::uint32_t qos)
{
  return static_cast<std::uint32_t>(submessage) - (4U + to_qos + qos);
}

void ReadData(unsigned kind, unsigned flags, std::span<const char> body, bool little)
{
  Reader from(body, little);
  from.Skip(2);
  const unsigned to_qos = from.Short();
  from.Skip(4);
  const auto writer = from.Rest().first(4);
  from.Skip(4);
  const std::int64_t number = from.Number();
  Promise(number > 0 && number + 256 > 0);
  std::uint32_t start = 0;
  std::uint32_t size = 0;
  std::uint32_t sample = 0;
  if (kind == 0x16)
  {
    start = from.Word();
    Promise(from.Short() == 1);
    size = from.Short();
    sample = from.Word();
    Promise(sample > 0 && sample <= kMemberLimits.sample_bytes && size >= 4);
  }
  Promise(to_qos + 4 == from.At());
  const std::uint32_t qos = (flags & 2U) != 0 ? ReadList(from.Rest(), little) : 0;
  from.Skip(qos);
  const std::uint32_t payload = PayloadOf(body.size(), to_qos, qos);
  const bool is_builtin = (static_cast<unsigned char>(writer[3]) & 0xc0U) == 0xc0U;
  if (kind == 0x16)
  {
    Promise(!is_builtin);
    // The sample must have room for the list of missing fragments, at the beginning of each, and for the copy of this
    // one.
    const std::uint64_t fragments = (std::uint64_t{sample} + size - 1) / size;
    Promise(((fragments - 1) * size + 3) / 4 * 4 + 4 <= std::uint64_t{sample} + 3);
    const std::uint32_t offset = (start - 1) * size;
    const std::uint32_t count = start < fragments ? size : sample - offset;
    Promise(start >= 1 && start <= fragments && offset < sample && count <= sample - offset);
    Promise(payload >= count && count <= from.Rest().size());
    return;
  }
  if ((flags & 12U) == 0) return;
  Promise(payload > 0 && payload == from.Rest().size());
  const auto is = [&](const char* id) { return std::memcmp(writer.data(), id, 4) == 0; };
  if (is("\0\2\0\xc2")) Promise(payload >= 20);
  if (is("\0\1\0\xc2") || is("\0\0\3\xc2") || is("\0\0\4\xc2")) ReadList(from.Rest().subspan(4), from.Rest()[1] == 3);
}

void ReadSubmessage(unsigned kind, unsigned flags, std::span<const char> body, bool little)
{
  Reader from(body, little);
  switch (kind)
  {
    case 0x06:
    case 0x08:
    {
      from.Skip(8);
      const std::int64_t start = kind == 0x08 ? from.Number() : 0;
      const std::int64_t base = from.Number();
      Promise(base >= 0 && base + 256 > base && (kind == 0x06 || base - 1 >= start - 1));
      if (kind == 0x08) Promise(start > 0 && base > 0 && base - start <= 10'000);
      ReadSet(from);
      if (kind == 0x06) from.Word();
      return;
    }
    case 0x07:
    {
      from.Skip(8);
      const std::int64_t first = from.Number();
      const std::int64_t last = from.Number();
      from.Word();
      Promise(first > 0 && first <= kMemberLimits.heartbeat_first && last >= first - 1 && last + 257 > last);
      return;
    }
    case 0x09:
      if ((flags & 2U) == 0) from.Skip(8);
      return;
    case 0x0c:
      from.Skip(20);
      return;
    case 0x0e:
      from.Skip(12);
      return;
    case 0x12:
      from.Skip(8);
      from.Number();
      Promise(from.Word() > 0);
      ReadSet(from);
      from.Word();
      return;
    case 0x15:
    case 0x16:
      return ReadData(kind, flags, body, little);
    default:
      Promise(kind < 0x30 || kind > 0x34);
  }
}

// Goes from one submessage to the next by the rules of Fast DDS.
void ReadDatagram(std::span<const char> datagram)
{
  std::size_t at = 20;
  while (at < datagram.size())
  {
    Promise(datagram.size() - at >= 4);
    const unsigned kind = static_cast<unsigned char>(datagram[at]);
    const unsigned flags = static_cast<unsigned char>(datagram[at + 1]);
    const bool little = (flags & 1U) != 0;
    Reader header(datagram.subspan(at + 2, 2), little);
    std::size_t length = header.Short();
    const bool is_last = length == 0 && kind != 0x09 && kind != 0x01;
    if (is_last) length = datagram.size() - at - 4;
    Promise(length <= datagram.size() - at - 4);
    ReadSubmessage(kind, flags, datagram.subspan(at + 4, length), little);
    if (is_last) return;
    at += 4 + ((length + 3) & ~std::size_t{3});
  }
}

fuzz::Input InputOf(const std::string& bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace

std::vector<fuzz::Input> fuzz::FirstInputs()
{
  std::vector<fuzz::Input> inputs;
  for (const auto& datagrams : {test::LegalDatagrams(), test::AttackDatagrams()})
    for (const test::RtpsDatagram& datagram : datagrams) inputs.push_back(InputOf(datagram.bytes));
  return inputs;
}

std::vector<fuzz::Input> fuzz::Words()
{
  std::vector<fuzz::Input> words;
  for (const test::RtpsDatagram& datagram : test::LegalDatagrams())
    if (datagram.bytes.size() > 20) words.push_back(InputOf(datagram.bytes.substr(20)));
  for (const std::string& word : {test::kListEnd, test::Heartbeat(1, 0), test::SequenceNumber(~std::int64_t{0}),
                                  test::Parameter(0x59, test::Word(2)), test::kListEncapsulation})
    words.push_back(InputOf(word));
  return words;
}

}  // namespace swarmanoid

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count)
{
  using namespace swarmanoid;
  const std::span<const char> datagram{reinterpret_cast<const char*>(bytes), count};
  for (const RtpsLimits& limits : {kMemberLimits, kStrangerLimits})
  {
    const RtpsVerdict verdict = CheckRtps(datagram, limits);
    Promise(verdict.bytes <= count);
    if (verdict.defect == nullptr) ReadDatagram(datagram.first(verdict.bytes));
  }
  return 0;
}
