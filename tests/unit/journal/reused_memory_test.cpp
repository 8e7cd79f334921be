#include "common/serialisation/reused_memory.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace swarmanoid
{
namespace
{

TEST(ReusedMemory, KeepsItsBytesWhenItGrowsAndMoves)
{
  ReusedMemory room;
  EXPECT_EQ(room.Bytes(), nullptr);
  std::size_t filled = 0;
  for (const std::size_t size : {std::size_t{10}, std::size_t{5}, std::size_t{3000}, std::size_t{4} << 20U})
  {
    char* const bytes = room.AtLeast(size);
    for (; filled < size; ++filled) bytes[filled] = static_cast<char>(filled % 101);
  }
  const auto address = [](const char* bytes) { return reinterpret_cast<std::uintptr_t>(bytes); };
  const std::uintptr_t place = address(room.Bytes());
  EXPECT_EQ(address(room.AtLeast(17)), place) << "there was enough";
  ReusedMemory other = std::move(room);
  EXPECT_EQ(address(other.Bytes()), place);
  room = std::move(other);
  for (std::size_t k = 0; k < filled; ++k) ASSERT_EQ(room.Bytes()[k], static_cast<char>(k % 101)) << k;
  EXPECT_NE(address(other.AtLeast(1)), place) << "what was moved has memory of its own";
}

}  // namespace
}  // namespace swarmanoid
