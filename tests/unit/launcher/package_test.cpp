// Packages of users: what is packed is installed with the same bytes, and nothing of a damaged or hostile package is.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/program/usage_error.h"
#include "common/run/access/digest.h"
#include "launcher/archive/tar_file.h"
#include "launcher/packages/install_package.h"
#include "launcher/packages/installed_packages.h"
#include "launcher/packages/make_package.h"
#include "test_folders.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

void WriteTo(const fs::path& path, const std::string& text)
{
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

std::string DigestOfText(const std::string& text)
{
  Sha256 digest;
  digest.Add(text);
  return digest.Text();
}

PackRequest RequestFor(const fs::path& directory, const fs::path& output, const std::string& release,
                       const std::string& author = "Alice", const std::string& licence = "MIT")
{
  PackRequest request;
  request.directory = directory;
  request.output = output;
  request.release = release;
  request.author = author;
  request.licence = licence;
  return request;
}

class Packages : public testing::Test
{
protected:
  // A user directory with a controller, a script beside an experiment, and files that packages leave out.
  fs::path Directory()
  {
    const fs::path directory = Home() / "alice";
    WriteTo(directory / "controllers/forager/forager.cpp", "int forager;\n");
    WriteTo(directory / "controllers/forager/bt_forage.h", "int behaviour;\n");
    WriteTo(directory / "experiments/forage.xml", "<ahss-config/>\n");
    WriteTo(directory / "experiments/scripts/walk.lua", "-- walk\n");
    WriteTo(directory / "README.md", "Forages.\n");
    WriteTo(directory / ".swarmanoid", "/opt\n");
    WriteTo(directory / "controllers/forager/.hidden", "x");
    WriteTo(directory / "simulation_build/controllers/libforager.so",
            "\x7f"
            "ELF");
    WriteTo(directory / "build.sh", "exit\n");
    return directory;
  }

  MadePackage Packed(const std::string& release = "1.0")
  {
    return MakePackage(RequestFor(Directory(), Home() / ("alice-" + release + ".tar.gz"), release));
  }

  fs::path Into()
  {
    fs::create_directories(Home() / "into");
    return Home() / "into";
  }

  InstalledPackage Install(const std::string& package, bool replace = false)
  {
    return InstallPackage({package, Into(), replace, SWARMANOID_SOURCE_FOLDER "/user/templates/user_directory"});
  }

  template <class Error = PackageError>
  std::string Refusal(const std::string& package, bool replace = false)
  {
    return test::MessageOf<Error>([&] { Install(package, replace); });
  }

  // Writes a package of these members, whose manifest lists them unless another one is given.
  std::string Hostile(const std::vector<std::pair<std::string, std::string>>& members, std::string manifest = "")
  {
    if (manifest.empty()) manifest = ManifestOf(members);
    const std::string path = Home() / "hostile.tar.gz";
    fs::remove(path);
    TarWriter tar("--output", path);
    const auto write = [&](const std::string& name, const std::string& text)
    {
      tar.Begin(name, text.size());
      tar.Write(text);
      tar.End();
    };
    write("p/package.json", manifest);
    for (const auto& [name, text] : members) write("p/" + name, text);
    tar.Close();
    return path;
  }

  static std::string ManifestOf(const std::vector<std::pair<std::string, std::string>>& members)
  {
    PackageManifest manifest{"evil", "1.0", "Eve", "MIT", "", "2.0", {}};
    for (const auto& [name, text] : members) manifest.files.push_back({name, text.size(), DigestOfText(text)});
    return manifest.Text();
  }

  void NothingIsInstalled() { EXPECT_TRUE(fs::is_empty(Into())); }

  fs::path Home() const { return folder_.Path(); }

private:
  const test::TemporaryFolder folder_{"package"};
};

TEST_F(Packages, AreInstalledAsTheyWerePacked)
{
  const MadePackage made = Packed();
  EXPECT_THAT(made.manifest.Content(),
              ElementsAre(Pair("controllers", ElementsAre("forager")), Pair("experiments", ElementsAre("forage.xml"))));
  EXPECT_EQ(made.manifest.name, "alice");
  EXPECT_EQ(made.manifest.files.size(), 5U);
  const InstalledPackage installed = Install(made.path);
  EXPECT_EQ(installed.folder, Into() / "alice");
  for (const ArchiveMember& file : made.manifest.files)
    EXPECT_EQ(test::TextOf(fs::path(installed.folder) / file.name), test::TextOf(Directory() / file.name)) << file.name;
  EXPECT_FALSE(fs::exists(Into() / "alice/controllers/forager/.hidden"));
  EXPECT_FALSE(fs::exists(Into() / "alice/simulation_build"));
  EXPECT_THAT(test::TextOf(Into() / "alice/build.sh"), HasSubstr("CMAKE_PREFIX_PATH")) << "that of the installation";
  const auto packages = PackagesIn(Into());
  ASSERT_EQ(packages.size(), 1U);
  EXPECT_THAT(packages[0].changed, IsEmpty());
  EXPECT_THAT(packages[0].added, IsEmpty());
  EXPECT_EQ(packages[0].manifest.files, made.manifest.files);
}

TEST_F(Packages, OfEqualContentAreEqual)
{
  const std::string first = Packed().digest;
  fs::remove(Home() / "alice-1.0.tar.gz");
  EXPECT_EQ(Packed().digest, first);
}

TEST_F(Packages, AreInstalledFromAFolderToo)
{
  const MadePackage made = Packed();
  EXPECT_EQ(Install(Directory()).manifest.files, made.manifest.files);
  EXPECT_FALSE(fs::exists(Into() / "alice/.hidden"));
  fs::remove_all(Into() / "alice");
  WriteTo(Home() / "alice/README.md", "Changed.\n");
  EXPECT_THAT(Refusal((Home() / "alice").string()), HasSubstr("files differ from its package.json: README.md"));
  NothingIsInstalled();
}

TEST_F(Packages, AreFoundByNameInTheFoldersOfTheVariable)
{
  const std::string first = Packed().path;
  const std::string elsewhere = Home() / "shared";
  fs::create_directories(elsewhere);
  fs::rename(first, elsewhere + "/alice-1.0.tar.gz");
  unsetenv("SWARMANOID_PACKAGES");
  EXPECT_THAT(Refusal<UsageError>("alice"), HasSubstr("SWARMANOID_PACKAGES, which is not set"));
  setenv("SWARMANOID_PACKAGES", ("/nowhere:" + elsewhere).c_str(), 1);
  EXPECT_THAT(Refusal<UsageError>("alic"), HasSubstr("no package of that name"));
  EXPECT_EQ(Install("alice").manifest.release, "1.0");
  fs::rename(Packed("1.1").path, elsewhere + "/alice-1.1.tar.gz");
  EXPECT_THAT(Refusal<UsageError>("alice", true), HasSubstr("several packages 'alice'"));
  unsetenv("SWARMANOID_PACKAGES");
}

TEST_F(Packages, AreReplacedOnlyOnRequestAndUnchanged)
{
  Install(Packed().path);
  const std::string second = Packed("1.1").path;
  EXPECT_THAT(Refusal<UsageError>(second), HasSubstr("alice 1.0 is installed already"));
  WriteTo(Into() / "alice/controllers/forager/forager.cpp", "int mine;\n");
  EXPECT_THAT(Refusal<UsageError>(second, true),
              HasSubstr("has changed or added files: controllers/forager/forager.cpp"));
  EXPECT_EQ(test::TextOf(Into() / "alice/controllers/forager/forager.cpp"), "int mine;\n");
  WriteTo(Into() / "alice/controllers/forager/forager.cpp", "int forager;\n");
  WriteTo(Into() / "alice/controllers/mine/mine.cpp", "int mine;\n");
  EXPECT_THAT(Refusal<UsageError>(second, true), HasSubstr("added files: controllers/mine/mine.cpp"));
  EXPECT_THAT(PackagesIn(Into()).at(0).added, ElementsAre("controllers/mine/mine.cpp"));
  fs::remove_all(Into() / "alice/controllers/mine");
  EXPECT_EQ(Install(second, true).manifest.release, "1.1");
  EXPECT_EQ(PackagesIn(Into()).at(0).manifest.release, "1.1");
  EXPECT_EQ(std::distance(fs::directory_iterator(Into()), fs::directory_iterator()), 1) << "nothing is left over";
}

TEST_F(Packages, DoNotReplaceWhatIsNoPackage)
{
  WriteTo(Into() / "alice/thesis.tex", "years of work");
  EXPECT_THAT(Refusal<UsageError>(Packed().path, true), HasSubstr("is no installed package"));
  EXPECT_EQ(test::TextOf(Into() / "alice/thesis.tex"), "years of work");
}

TEST_F(Packages, WithFilesInOtherPlacesAreRefused)
{
  for (const std::string name :
       {"../evil.cpp", "controllers/../../evil.cpp", "/tmp/evil.cpp", "controllers//evil.cpp", "controllers/a\\b.cpp",
        "controllers/./a.cpp", "CMakeLists.txt", "build.sh", ".bashrc", "controllers/.git/config", "controllers/-rf",
        "controllers/a b.cpp", "controllers/$(x).cpp", "controllers/a;b.cpp", "simulation_build/liba.so",
        "package.json", "controllers", ""})
  {
    EXPECT_THAT(Refusal(Hostile({}, ManifestOf({{name, "text"}}))), HasSubstr("is not allowed")) << name;
    NothingIsInstalled();
  }
}

TEST_F(Packages, ThatDifferFromTheirListAreRefused)
{
  const std::pair<std::string, std::string> one{"controllers/a/a.cpp", "int a;"}, two{"controllers/b/b.cpp", "int b;"};
  EXPECT_THAT(Refusal(Hostile({one}, ManifestOf({one, two}))), HasSubstr("its end where its list has"));
  EXPECT_THAT(Refusal(Hostile({one, two}, ManifestOf({one}))), HasSubstr("its list lacks"));
  EXPECT_THAT(Refusal(Hostile({two, one}, ManifestOf({one, two}))), HasSubstr("where its list has"));
  EXPECT_THAT(Refusal(Hostile({{one.first, "int x;"}}, ManifestOf({one}))), HasSubstr("is damaged: its SHA-256"));
  EXPECT_THAT(Refusal(Hostile({{one.first, "int a; "}}, ManifestOf({one}))), HasSubstr("where its list has"));
  EXPECT_THAT(Refusal(Hostile({}, ManifestOf({two, one}))), HasSubstr("not in the order of their names"));
  EXPECT_THAT(Refusal(Hostile({}, ManifestOf({one, one}))), HasSubstr("not in the order of their names"));
  EXPECT_THAT(Refusal(Hostile({{"controllers/a", "x"}, {"controllers/a/b", "y"}})), HasSubstr("cannot be installed"));
  EXPECT_THAT(Refusal(Hostile({{"controllers/a/a.cpp",
                                "\x7f"
                                "ELF…"}})),
              HasSubstr("program code"));
  NothingIsInstalled();
}

TEST_F(Packages, OfAnySizeAreBounded)
{
  const auto with_bytes = [](std::uint64_t bytes) {
    return PackageManifest{"evil", "1.0", "Eve", "MIT", "", "2.0", {{"controllers/a", bytes, "0"}}}.Text();
  };
  EXPECT_THAT(Refusal(Hostile({}, with_bytes(kMostPackageBytes + 1))), HasSubstr("a package has at most"));
  EXPECT_THAT(Refusal(Hostile({}, with_bytes(std::uint64_t{1} << 40U))), HasSubstr("is too long"));
  PackageManifest many{"evil", "1.0", "Eve", "MIT", "", "2.0", {}};
  for (std::size_t k = 0; k <= kMostPackageFiles; ++k)
    many.files.push_back({fmt::format("controllers/{:06}", k), 0, "0"});
  EXPECT_THAT(Refusal(Hostile({}, many.Text())), HasSubstr("files; a package has at most 10000"));
}

TEST_F(Packages, WithWrongManifestsAreRefused)
{
  const std::string good = ManifestOf({});
  const auto changed = [&](const std::string& from, const std::string& to)
  {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return Refusal(Hostile({}, text));
  };
  EXPECT_THAT(changed("\"evil\"", "\"../evil\""), HasSubstr("its name '../evil' is not allowed"));
  EXPECT_THAT(changed("\"evil\"", "\"\""), HasSubstr("its name '' is not allowed"));
  EXPECT_THAT(changed("\"evil\"", "7"), HasSubstr("no manifest of a package"));
  EXPECT_THAT(changed("\"1.0\"", "\"$(x)\""), HasSubstr("its release '$(x)' is not allowed"));
  EXPECT_THAT(changed("\"Eve\"", "\"Eve\\u001b[2J\""), HasSubstr("it must be one line of text"));
  EXPECT_THAT(changed("\"swarmanoid package\"", "\"swarmanoid archive\""), HasSubstr("its format has another name"));
  EXPECT_THAT(changed("\"version\": 1", "\"version\": 2"), HasSubstr("install a newer Swarmanoid"));
  EXPECT_THAT(changed("\"files\": []", "\"files\": 3"), HasSubstr("no manifest of a package"));
  EXPECT_THAT(changed("\"licence\"", "\"license\""), HasSubstr("no manifest of a package"));
  EXPECT_THAT(Refusal(Hostile({}, "{")), HasSubstr("no manifest of a package"));
  NothingIsInstalled();
}

TEST_F(Packages, ThatAreNoTarGzAreRefused)
{
  WriteTo(Home() / "text.tar.gz", "just text");
  EXPECT_THAT(Refusal((Home() / "text.tar.gz").string()), HasSubstr("it is no tar.gz file"));
  std::string bytes = test::TextOf(Packed().path);
  WriteTo(Home() / "cut.tar.gz", bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(Refusal((Home() / "cut.tar.gz").string()), HasSubstr("cannot be installed"));
  EXPECT_THAT(Refusal<UsageError>((Home() / "absent.tar.gz").string()), HasSubstr("there is no file"));
  NothingIsInstalled();
}

TEST_F(Packages, CannotBeMadeOfLinksAndPrograms)
{
  const fs::path directory = Directory();
  const auto refusal = [&](const PackRequest& request)
  { return test::MessageOf<UsageError>([&] { MakePackage(request); }); };
  const PackRequest request = RequestFor(directory, Home() / "x.tar.gz", "1.0");
  fs::create_symlink("/etc/passwd", directory / "controllers/forager/secret");
  EXPECT_THAT(refusal(request), HasSubstr("'controllers/forager/secret': it is a link"));
  fs::remove(directory / "controllers/forager/secret");
  WriteTo(directory / "controllers/forager/prebuilt.so",
          "\x7f"
          "ELF");
  EXPECT_THAT(refusal(request), HasSubstr("'controllers/forager/prebuilt.so': it is program code"));
  fs::remove(directory / "controllers/forager/prebuilt.so");
  WriteTo(directory / "experiments/my file.xml", "x");
  EXPECT_THAT(refusal(request), HasSubstr("'experiments/my file.xml': names in packages"));
  fs::remove(directory / "experiments/my file.xml");
  PackRequest other = request;
  other.licence = "";
  EXPECT_THAT(refusal(other), HasSubstr("--licence: the package needs it"));
  other = request;
  other.name = "Alice's";
  EXPECT_THAT(refusal(other), HasSubstr("--name: 'Alice"));
  other = request;
  other.release = "one";
  EXPECT_THAT(refusal(other), HasSubstr("--release: 'one'"));
  EXPECT_FALSE(fs::exists(Home() / "x.tar.gz"));
  MakePackage(request);
  EXPECT_THAT(refusal(request), HasSubstr("is there already"));
  // The next release keeps what the first one said.
  const MadePackage next = MakePackage(RequestFor(directory, Home() / "y.tar.gz", "1.1", "", ""));
  EXPECT_EQ(next.manifest.author, "Alice");
  fs::create_directories(Home() / "empty");
  other = request;
  other.directory = Home() / "empty";
  EXPECT_THAT(refusal(other), HasSubstr("has no controller, experiment or anything else"));
}

}  // namespace
}  // namespace swarmanoid
