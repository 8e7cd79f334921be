// The file behind the editor: saved as a whole or not at all, and looked at for what others write.
#include "launcher/editor/edited_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "common/configuration/configuration_tree.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

void Write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

std::size_t FilesIn(const fs::path& folder)
{
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(EditedFile, WritesTheWholeFileAndKeepsPermissionsAndLinks)
{
  const test::TemporaryFolder folder;
  const fs::path real = folder / "real.xml", link = folder / "link.xml";
  Write(real, "old\r\n");
  chmod(real.c_str(), 0640);
  fs::create_symlink("real.xml", link);
  EditedFile file(link.string());
  EXPECT_EQ(file.Text(), "old\r\n");
  file.Write("new\r\n");
  EXPECT_EQ(test::TextOf(real), "new\r\n");
  EXPECT_EQ(file.Text(), "new\r\n");
  EXPECT_TRUE(fs::is_symlink(link));
  struct stat state
  {
  };
  ASSERT_EQ(stat(real.c_str(), &state), 0);
  EXPECT_EQ(state.st_mode & 07777U, 0640U);
  EXPECT_EQ(FilesIn(folder.Path()), 2U);  // nothing is left beside it
  EXPECT_FALSE(file.HasChanged());
}

TEST(EditedFile, NoticesWhatOthersWrite)
{
  const test::TemporaryFolder folder;
  const fs::path path = folder / "f.xml";
  Write(path, "one");
  EditedFile file(path.string());
  EXPECT_FALSE(file.HasChanged());
  Write(path, "two!");
  EXPECT_TRUE(file.HasChanged());
  EXPECT_TRUE(file.HasChanged());
  Write(path, "one");
  EXPECT_FALSE(file.HasChanged());
  // Editors replace the file by another one, here of the same length.
  Write(path.string() + "~", "own");
  fs::rename(path.string() + "~", path);
  EXPECT_TRUE(file.HasChanged());
  file.Accept(file.OnDisk());
  EXPECT_EQ(file.Text(), "own");
  EXPECT_FALSE(file.HasChanged());
  fs::remove(path);
  EXPECT_TRUE(file.HasChanged());
  file.Write("again");
  EXPECT_EQ(test::TextOf(path), "again");
  EXPECT_FALSE(file.HasChanged());
}

TEST(EditedFile, KeepsTheOldOneIfItCannotWrite)
{
  const test::TemporaryFolder folder;
  const fs::path path = folder / "f.xml";
  Write(path, "old");
  EditedFile file(path.string());
  // A folder in its place cannot be replaced by a file.
  fs::remove(path);
  fs::create_directory(path);
  Write(path / "inside", "kept");
  EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { file.Write("new"); }), testing::HasSubstr("is not saved"));
  EXPECT_EQ(test::TextOf(path / "inside"), "kept");
  EXPECT_EQ(FilesIn(folder.Path()), 1U);
  EXPECT_EQ(file.Text(), "old");
  EXPECT_THROW(EditedFile((folder / "none.xml").string()), ConfigurationError);
}

}  // namespace
}  // namespace swarmanoid
