// The form of archives and packages: what is written is read again, and nothing else is taken.
#include "launcher/archive/archive_members.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "common/program/usage_error.h"
#include "common/run/access/digest.h"
#include "launcher/archive/tar_file.h"
#include "launcher/packages/package_manifest.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using ListJson = nlohmann::ordered_json;
using testing::HasSubstr;

std::string RandomBytes(std::size_t count)
{
  std::mt19937 random(static_cast<unsigned>(count));
  std::string bytes(count, '\0');
  for (char& byte : bytes) byte = static_cast<char>(random());
  return bytes;
}

std::string DigestOfBytes(const std::string& bytes)
{
  Sha256 digest;
  digest.Add(bytes);
  return digest.Text();
}

std::string ContentIn(TarReader& tar)
{
  std::string text;
  for (std::span<const char> part = tar.Read(); !part.empty(); part = tar.Read()) text.append(part.data(), part.size());
  return text;
}

class TarFile : public testing::Test
{
protected:
  std::string Path() const { return folder_ / "file.tar.gz"; }
  // Writes the files, and returns the digest of the whole.
  std::string Write(const std::vector<std::pair<std::string, std::string>>& files) const
  {
    TarWriter tar("--output", Path());
    for (const auto& [name, content] : files)
    {
      tar.Begin(name, content.size());
      tar.Write(content);
      tar.End();
    }
    return tar.Close();
  }

  const test::TemporaryFolder folder_;
};

TEST_F(TarFile, HasTheFilesThatWereWritten)
{
  std::vector<std::pair<std::string, std::string>> files;
  for (const std::size_t bytes : {0, 1, 511, 512, 513, 1024, 65535, 65536, 65537, 200'000})
    files.emplace_back("folder/" + std::to_string(bytes), RandomBytes(bytes));
  files.emplace_back(std::string(100, 'a'), "as long as a name may be");
  files.emplace_back("folder/" + std::string(100, 'b'), "with a folder before");
  files.emplace_back(std::string(155, 'c') + "/" + std::string(99, 'd'), "as long as a path may be");
  const std::string digest = Write(files);
  EXPECT_EQ(digest, DigestOfBytes(test::TextOf(Path())));
  TarReader tar(Path());
  for (const auto& [name, content] : files)
  {
    const auto entry = tar.Next();
    ASSERT_TRUE(entry) << name;
    EXPECT_EQ(entry->name, name);
    EXPECT_EQ(entry->bytes, content.size());
    EXPECT_EQ(ContentIn(tar), content) << name;
  }
  EXPECT_FALSE(tar.Next());
}

TEST_F(TarFile, RefusesNamesThatTheFormCannotHold)
{
  for (const std::string& name :
       {std::string(101, 'a'), "folder/" + std::string(101, 'a'), std::string(156, 'a') + "/" + std::string(90, 'b')})
    EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { Write({{name, "x"}}); }), HasSubstr("is too long")) << name;
  EXPECT_FALSE(fs::exists(Path())) << "what is not finished is removed";
}

TEST_F(TarFile, IsNotWrittenOverAnotherFile)
{
  folder_.Write("file.tar.gz", "precious");
  EXPECT_THAT(test::MessageOf<UsageError>([&] { Write({}); }),
              HasSubstr("--output: the file '" + Path() + "' is there"));
  EXPECT_EQ(folder_.Read("file.tar.gz"), "precious");
  EXPECT_THROW(TarWriter("--output", folder_ / "missing" / "a.tar.gz"), UsageError);
}

TEST_F(TarFile, HasAsManyBytesOfAFileAsWereAnnounced)
{
  const auto write = [&](std::size_t announced, const std::string& content)
  {
    TarWriter tar("--output", Path());
    tar.Begin("a", announced);
    tar.Write(content);
    tar.End();
  };
  EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { write(3, "1234"); }), HasSubstr("a file grew"));
  EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { write(3, "12"); }), HasSubstr("a file became shorter"));
  EXPECT_FALSE(fs::exists(Path()));
}

TEST_F(TarFile, IsRefusedIfAnyPartOfItIsMissing)
{
  Write({{"a", RandomBytes(3000)}});
  const std::string whole = test::TextOf(Path());
  const auto read = [&](const std::string& bytes)
  {
    folder_.Write("cut.tar.gz", bytes);
    TarReader tar(folder_ / "cut.tar.gz");
    while (tar.Next()) ContentIn(tar);
  };
  EXPECT_NO_THROW(read(whole));
  for (std::size_t bytes = 0; bytes < whole.size(); bytes += 97)
    EXPECT_THROW(read(whole.substr(0, bytes)), std::runtime_error) << bytes;
  EXPECT_THROW(read(whole.substr(0, whole.size() - 1)), std::runtime_error);
  EXPECT_THROW(read(whole + "x"), std::runtime_error);
  EXPECT_THAT(test::MessageOf<std::runtime_error>([&] { read("plain text"); }), HasSubstr("no tar.gz file"));
}

TEST(ArchiveMembers, NamesStayInTheFolder)
{
  for (const std::string& name :
       {std::string("a"), std::string("a/b.c"), std::string("..a/b.."), std::string(255, 'a')})
    EXPECT_EQ(MemberNameMistake(name), "") << name;
  for (const std::string& name : {std::string(), std::string(256, 'a')})
    EXPECT_THAT(MemberNameMistake(name), HasSubstr("1 to 255 bytes"));
  for (const char* name : {"a\nb", "a\x7f", "a\\b", "\x1f"})
    EXPECT_THAT(MemberNameMistake(name), HasSubstr("control character")) << name;
  EXPECT_THAT(MemberNameMistake("/a"), HasSubstr("absolute"));
  for (const char* name : {"..", ".", "a/..", "../a", "a//b", "a/", "a/./b"})
    EXPECT_THAT(MemberNameMistake(name), HasSubstr("another folder")) << name;
}

TEST(ArchiveMembers, AreReadAgainFromTheirList)
{
  const std::vector<ArchiveMember> members{{"a", 0, "00"}, {"b/c", 1099511627775, "11"}};
  EXPECT_EQ(MembersOf(MembersJson(members)), members);
  const auto mistake = [](const std::vector<ArchiveMember>& list)
  { return test::MessageOf<std::runtime_error>([&] { MembersOf(MembersJson(list)); }); };
  EXPECT_THAT(mistake({{"a", 1099511627776, ""}}), HasSubstr("'a' is too long"));
  EXPECT_THAT(mistake({{"b", 0, ""}, {"a", 0, ""}}), HasSubstr("order"));
  EXPECT_THAT(mistake({{"a", 0, ""}, {"a", 0, ""}}), HasSubstr("order"));
  EXPECT_THAT(mistake({{"../a", 0, ""}}), HasSubstr("is not allowed"));
  EXPECT_EQ(CountIn(ListJson{{"n", 3U}}, "n"), 3U);
  EXPECT_THROW(CountIn(ListJson{{"n", -3}}, "n"), std::runtime_error);
  EXPECT_THROW(CountIn(ListJson{{"n", 0.5}}, "n"), std::runtime_error);
}

TEST(ArchiveMembers, TheFormatHasItsNameAndVersion)
{
  const auto mistake = [](const char* format, unsigned version)
  {
    const ListJson list{{"format", format}, {"version", version}, {"swarmanoid", "9.0"}};
    return test::MessageOf<std::runtime_error>([&] { CheckFormat(list, "swarmanoid archive", 2, "archives"); });
  };
  EXPECT_NO_THROW(
      CheckFormat(ListJson{{"format", "swarmanoid archive"}, {"version", 2U}}, "swarmanoid archive", 2, "archives"));
  EXPECT_THAT(mistake("swarmanoid package", 2), HasSubstr("another name"));
  EXPECT_THAT(mistake("swarmanoid archive", 3), HasSubstr("version 3 of archives, made by Swarmanoid '9.0'"));
  EXPECT_THAT(mistake("swarmanoid archive", 3), HasSubstr("install a newer Swarmanoid"));
  EXPECT_THAT(mistake("swarmanoid archive", 1), testing::Not(HasSubstr("newer")));
}

TEST(PackageNames, HaveTheLettersThatFoldersAndBuildsTake)
{
  for (const std::string& name : {std::string("a"), std::string("wall_follower2"), std::string(40, 'z')})
    EXPECT_EQ(PackageNameMistake(name), "") << name;
  for (const std::string& name : {std::string(), std::string(41, 'a'), std::string("A"), std::string("2a"),
                                  std::string("a-b"), std::string("_a"), std::string("a{"), std::string("a`")})
    EXPECT_NE(PackageNameMistake(name), "") << name;
  for (const std::string& release :
       {std::string("1"), std::string("0.9-rc1"), std::string("9Zz"), std::string(40, '1')})
    EXPECT_EQ(PackageReleaseMistake(release), "") << release;
  for (const std::string& release : {std::string(), std::string(41, '1'), std::string("v1"), std::string("1 2"),
                                     std::string("1_2"), std::string("1/2"), std::string(".1")})
    EXPECT_NE(PackageReleaseMistake(release), "") << release;
  EXPECT_EQ(PackageTextMistake(""), "");
  EXPECT_EQ(PackageTextMistake(std::string(200, 'a')), "");
  EXPECT_NE(PackageTextMistake(std::string(201, 'a')), "");
  EXPECT_NE(PackageTextMistake("two\nlines"), "");
}

TEST(PackageNames, OfFilesAreTextsOrInAFolderOfAUserDirectory)
{
  for (const char* name :
       {"controllers/a/a.cpp", "devices/a", "engines/a", "entities/a", "experiments/a.xml", "functions/a",
        "renderers/a_B-1+.h", "README.md", "README", "LICENSE", "LICENSE.md", "CHANGELOG.md", "CITATION.cff"})
    EXPECT_EQ(PackageFileMistake(name), "") << name;
  for (const char* name : {"a.cpp", "build.sh", "controllers", "src/README.md", "controllers/.a", "controllers/-a",
                           "controllers/a b", "controllers/a;b", "readme.md", "experiments/../a", "/controllers/a"})
    EXPECT_NE(PackageFileMistake(name), "") << name;
}

TEST(PackageManifest, ListsWhatIsInEachFolderAndReadsItself)
{
  PackageManifest manifest{"forage", "1.0", "Alice", "MIT", "Forages.", "2.0", {}};
  for (const char* name : {"README.md", "controllers/forager/bt_forage.h", "controllers/forager/forager.lua",
                           "experiments/forage.xml", "experiments/scripts/walk.lua"})
    manifest.files.push_back({name, 3, "ab"});
  using Content = std::map<std::string, std::set<std::string>>;
  EXPECT_EQ(manifest.Content(), (Content{{"controllers", {"forager"}}, {"experiments", {"forage.xml"}}}));
  EXPECT_FALSE(manifest.HasSources());
  const PackageManifest read = PackageManifest::Parse(manifest.Text());
  EXPECT_EQ(read.name, "forage");
  EXPECT_EQ(read.release, "1.0");
  EXPECT_EQ(read.author, "Alice");
  EXPECT_EQ(read.licence, "MIT");
  EXPECT_EQ(read.summary, "Forages.");
  EXPECT_EQ(read.swarmanoid, "2.0");
  EXPECT_EQ(read.files, manifest.files);
  manifest.files.insert(manifest.files.begin() + 2, {"controllers/forager/forager.cpp", 3, "ab"});
  EXPECT_TRUE(manifest.HasSources());
}

TEST(PackageManifest, HasAtMost256MiBAndTenThousandFiles)
{
  PackageManifest manifest{
      "forage", "1.0", "Alice", "MIT", "", "2.0", {{"controllers/a", 1, ""}, {"controllers/b", 0, ""}}};
  manifest.files[0].bytes = std::uint64_t{256} << 20U;
  EXPECT_NO_THROW(PackageManifest::Parse(manifest.Text()));
  manifest.files[1].bytes = 1;
  EXPECT_THROW(PackageManifest::Parse(manifest.Text()), std::runtime_error);
  manifest.files.clear();
  for (int k = 0; k < 10'000; ++k) manifest.files.push_back({"controllers/" + std::to_string(100'000 + k), 0, ""});
  EXPECT_NO_THROW(PackageManifest::Parse(manifest.Text()));
  manifest.files.push_back({"controllers/9", 0, ""});
  EXPECT_THROW(PackageManifest::Parse(manifest.Text()), std::runtime_error);
}

}  // namespace
}  // namespace swarmanoid
