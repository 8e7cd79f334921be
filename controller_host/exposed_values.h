// ExposedValues: the memory of a device of one robot that faults change (docs/faults.md). A batch fills it in Expose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace swarmanoid
{

class ExposedValues
{
public:
  struct Number
  {
    double* place;
    double when_dead;
  };
  // Removes the entries of a list for which `kept` is 0.
  using Keep = void (*)(void* list, std::span<const std::uint8_t> kept);

  // Adds numbers, in the order of the device's columns. Numbers without a column may follow.
  void Add(std::span<double> numbers)
  {
    for (double& number : numbers) numbers_.push_back({&number, 0});
  }
  void Add(double& number, double when_dead = 0) { numbers_.push_back({&number, when_dead}); }
  // Sets the list of the device: what it reads or sends, with a length that differs between ticks.
  template <class Entry>
  void SetList(std::vector<Entry>& list)
  {
    SetList(list.size(), &list,
            [](void* of, std::span<const std::uint8_t> kept)
            {
              auto& entries = *static_cast<std::vector<Entry>*>(of);
              std::size_t next = 0;
              for (std::size_t i = 0; i < kept.size(); ++i)
                if (kept[i] != 0) entries[next++] = entries[i];
              entries.resize(next);
            });
  }
  void SetList(std::size_t length, void* list, Keep keep)
  {
    length_ = length;
    list_ = list;
    keep_ = keep;
  }

  void Clear()
  {
    numbers_.clear();
    SetList(0, nullptr, nullptr);
  }
  std::span<const Number> Numbers() const { return numbers_; }
  bool HasList() const { return keep_ != nullptr; }
  std::size_t Length() const { return length_; }
  void KeepEntries(std::span<const std::uint8_t> kept) const { keep_(list_, kept); }

private:
  std::vector<Number> numbers_;
  std::size_t length_ = 0;
  void* list_ = nullptr;
  Keep keep_ = nullptr;
};

}  // namespace swarmanoid
