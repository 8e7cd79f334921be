// Archives for formats whose fields are stated once, in a function that visits them: checkpoint_format.h, or a static
// member `Visit` of the struct. One archive writes the fields to bytes; the other reads them.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "common/serialisation/bytes.h"

namespace swarmanoid
{

class FieldWriter
{
public:
  explicit FieldWriter(ByteWriter& bytes) : bytes_(bytes) {}
  template <class T>
  void Number(const T& value)
  {
    bytes_.Put(value);
  }
  void Text(const std::string& text) { bytes_.PutText(text); }
  template <class T>
  void Array(const std::vector<T>& values)
  {
    bytes_.PutArray(values);
  }
  template <class T, class Visit>
  void List(const std::vector<T>& entries, const Visit& visit)
  {
    bytes_.Put(static_cast<std::uint64_t>(entries.size()));
    for (const T& entry : entries) visit(entry);
  }
  // `visit` gets a key and its value.
  template <class Key, class Value, class Visit>
  void Map(const std::map<Key, Value>& entries, const Visit& visit)
  {
    bytes_.Put(static_cast<std::uint64_t>(entries.size()));
    for (const auto& [key, value] : entries) visit(key, value);
  }

private:
  ByteWriter& bytes_;
};

class FieldReader
{
public:
  explicit FieldReader(ByteReader& bytes) : bytes_(bytes) {}
  template <class T>
  void Number(T& value)
  {
    value = bytes_.Get<T>();
  }
  void Text(std::string& text) { text = bytes_.GetText(); }
  template <class T>
  void Array(std::vector<T>& values)
  {
    bytes_.GetArray(values);
  }
  // If the stated count is too large, the reader fails at the end of the bytes.
  template <class T, class Visit>
  void List(std::vector<T>& entries, const Visit& visit)
  {
    for (auto count = bytes_.Get<std::uint64_t>(); count > 0; --count) visit(entries.emplace_back());
  }
  template <class Key, class Value, class Visit>
  void Map(std::map<Key, Value>& entries, const Visit& visit)
  {
    for (auto count = bytes_.Get<std::uint64_t>(); count > 0; --count)
    {
      Key key{};
      Value value{};
      visit(key, value);
      entries.insert_or_assign(std::move(key), std::move(value));
    }
  }

private:
  ByteReader& bytes_;
};

template <class T>
void WriteFields(ByteWriter& bytes, const T& value)
{
  FieldWriter archive(bytes);
  T::Visit(archive, value);
}

template <class T>
T ReadFields(ByteReader& bytes)
{
  FieldReader archive(bytes);
  T value;
  T::Visit(archive, value);
  return value;
}

}  // namespace swarmanoid
