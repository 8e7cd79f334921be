// Archives for formats whose fields are stated once, in a function that visits them (checkpoint_format.h). One archive
// writes the fields to bytes; the other reads them.
#pragma once

#include <cstdint>

#include "common/serialisation/bytes.h"

namespace swarmanoid
{

class FieldWriter
{
public:
  explicit FieldWriter(ByteWriter& bytes) : bytes_(bytes) {}
  void Number(std::uint64_t value) { bytes_.Put(value); }
  void Number(std::uint32_t value) { bytes_.Put(value); }
  void Text(const std::string& text) { bytes_.PutText(text); }
  template <class T>
  void Array(const std::vector<T>& values)
  {
    bytes_.PutArray(values);
  }
  template <class T, class Visit>
  void List(const std::vector<T>& entries, const Visit& visit)
  {
    Number(entries.size());
    for (const T& entry : entries) visit(entry);
  }

private:
  ByteWriter& bytes_;
};

class FieldReader
{
public:
  explicit FieldReader(std::span<const char> bytes) : bytes_(bytes) {}
  void Number(std::uint64_t& value) { value = bytes_.Get<std::uint64_t>(); }
  void Number(std::uint32_t& value) { value = bytes_.Get<std::uint32_t>(); }
  void Text(std::string& text) { text = bytes_.GetText(); }
  template <class T>
  void Array(std::vector<T>& values)
  {
    values = bytes_.GetArray<T>();
  }
  // If the stated count is too large, the reader fails at the end of the bytes.
  template <class T, class Visit>
  void List(std::vector<T>& entries, const Visit& visit)
  {
    for (auto count = bytes_.Get<std::uint64_t>(); count > 0; --count) visit(entries.emplace_back());
  }
  bool AtEnd() const { return bytes_.AtEnd(); }

private:
  ByteReader bytes_;
};

}  // namespace swarmanoid
