// Files of pictures.
#include "visualiser/scene/drawn_picture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <stdexcept>
#include <thread>

#include "tests/unit/visualiser/read_png.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

class PictureFileTest : public testing::Test
{
protected:
  static Picture Grey(std::uint8_t value)
  {
    Picture picture;
    picture.width = picture.height = 200;
    picture.pixels.assign(4 * 200 * 200, value);
    return picture;
  }

  const test::TemporaryFolder folder_;
  const std::string path_ = (folder_ / "newest.png").string();
};

TEST_F(PictureFileTest, WhoReadsWhileTheNextIsWrittenGetsAWholeOne)
{
  WritePng(Grey(0), path_);
  std::atomic<bool> over = false;
  std::thread writer(
      [&]
      {
        for (int k = 0; k < 200; ++k) WritePng(Grey(static_cast<std::uint8_t>(k)), path_);
        over = true;
      });
  int read = 0;
  for (; !over; ++read)
  {
    Picture picture = Grey(0);
    EXPECT_NO_THROW(picture = ReadPng(path_));
    EXPECT_EQ(picture.At(0, 0)[0], picture.At(199, 199)[0]);
  }
  writer.join();
  EXPECT_GT(read, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "no drafts";
}

TEST_F(PictureFileTest, WhatCannotBeWrittenLeavesNothing)
{
  fs::create_directory(path_ + ".new");
  EXPECT_THROW(WritePng(Grey(1), path_), std::runtime_error);
  EXPECT_FALSE(fs::exists(path_));
  EXPECT_TRUE(fs::is_directory(path_ + ".new")) << "it is not ours";
}

TEST_F(PictureFileTest, ALinkStaysOne)
{
  fs::create_symlink("there.png", path_);
  WritePng(Grey(7), path_);
  EXPECT_TRUE(fs::is_symlink(path_));
  EXPECT_EQ(ReadPng((folder_ / "there.png").string()).At(3, 3)[1], 7);
}

}  // namespace
}  // namespace swarmanoid
