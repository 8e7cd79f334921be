// Tests the session of an editor, with a page that only listens: requests, the messages after each, and the file on
// disk.
#include "launcher/editor/edit_session.h"
#include "common/space/space.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "simulation/register_all.h"
#include "test_folders.h"
#include "tests/eventually.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using Json = nlohmann::json;
using test::Eventually;
using testing::HasSubstr;

class ListeningPage : public EditorPage
{
public:
  void Open(const Parameters&, const std::string&, EditorRequests&) override {}
  std::string Url() const override { return {}; }
  std::string Fingerprint() const override { return {}; }
  std::string Warning() const override { return {}; }
  void Show(const CSwarmanoidSpace& space, const Assignment&) override
  {
    ++shown;
    places.clear();
    for (std::size_t e = 0; e < space.Size(); ++e) places[space.GetEntity(e).GetId()] = space.GetPose(e).position;
  }
  void Tell(const std::string& text) override { document = Json::parse(text); }
  void ShowRun(const std::string& url) override { run = url; }
  void Idle() override {}

  std::string run;
  int shown = 0;
  std::map<std::string, Vector3> places;
  Json document;
};

class EditSessionTest : public testing::Test
{
protected:
  EditSessionTest()
  {
    RegisterBuiltins();
    Write(text_);
    session_ = std::make_unique<EditSession>(file_, page_);
    session_->Begin();
  }

  void Write(const std::string& text) { std::ofstream(file_, std::ios::binary) << text; }
  std::string OnDisk() const { return test::TextOf(file_); }
  Json Ask(const Json& request)
  {
    const std::string reply = session_->Carry(request.dump());
    return reply.empty() ? Json() : Json::parse(reply);
  }
  std::string RefusalOf(const std::string& request)
  {
    return test::MessageOf<std::invalid_argument>([&] { session_->Carry(request); });
  }
  Json Edit(Json change)
  {
    change["do"] = "edit";
    change["revision"] = page_.document["revision"];
    return Ask(change);
  }
  std::string PathOf(const std::string& id)
  {
    for (const Json& path : page_.document["paths"])
      if (Ask({{"do", "form"}, {"path", path}})["name"] == id) return path;
    return "none";
  }

  test::TemporaryFolder folder_;
  std::string text_ = test::TextOf(SWARMANOID_SOURCE_FOLDER "/configs/sample_footbot.xml");
  std::string file_ = folder_ / "f.xml";
  ListeningPage page_;
  std::unique_ptr<EditSession> session_;
};

TEST_F(EditSessionTest, TellsAndShowsEachChange)
{
  ASSERT_TRUE(page_.document["saved"]);
  ASSERT_TRUE(page_.document["mistakes"].empty()) << page_.document["mistakes"];
  ASSERT_FALSE(page_.places.empty());
  const std::string id = page_.places.begin()->first;
  const std::string path = PathOf(id);
  const int shown = page_.shown;
  Edit({{"change", "place"}, {"places", {{{"path", path}, {"position", {0.5, 0.75, 0}}, {"heading", 45}}}}});
  EXPECT_EQ(page_.shown, shown + 1);
  EXPECT_EQ(page_.places[id].head<2>(), Vector2(0.5, 0.75));
  EXPECT_FALSE(page_.document["saved"]);
  EXPECT_EQ(page_.document["undo"], "place " + id);
  EXPECT_EQ(OnDisk(), text_);

  // A change of a text that is not there any more.
  EXPECT_THAT(RefusalOf(R"({"do": "edit", "revision": 1, "change": "remove", "paths": ["2/0"]})"),
              HasSubstr("changed meanwhile"));
  Ask({{"do", "undo"}});
  EXPECT_TRUE(page_.document["saved"]);
  EXPECT_EQ(page_.document["redo"], "place " + id);
  EXPECT_EQ(RefusalOf(R"({"do": "undo"})"), "there is nothing to undo");

  const Json arena = page_.document["arena"];
  Edit({{"change", "add"}, {"path", arena}, {"tag", "footbot"}, {"at", {0.25, 0.5}}});
  const Json form = Ask({{"do", "form"}, {"path", page_.document["added"]}});
  EXPECT_EQ(form["tag"], "footbot");
  EXPECT_TRUE(form["removable"]);
  EXPECT_EQ(form["revision"], page_.document["revision"]);
}

TEST_F(EditSessionTest, FormsComeFromTheTables)
{
  const Json form = Ask({{"do", "form"}, {"path", page_.document["arena"]}});
  const auto found =
      std::ranges::find_if(form["parameters"], [](const Json& each) { return each["name"] == "optimization"; });
  ASSERT_NE(found, form["parameters"].end());
  EXPECT_EQ((*found)["type"], "choice");
  EXPECT_EQ((*found)["choices"], (Json{"2D", "3D", "octree"}));
  // All kinds can be placed.
  EXPECT_EQ(page_.document["kinds"].size(),
            EntityKindCount() + 4);  // <distribute>, <reserve>, <floor_field> and <wind>, too
  EXPECT_THAT(RefusalOf(R"({"do": "form", "path": "9/9"})"), HasSubstr("not there"));
}

TEST_F(EditSessionTest, SavesOverOthersOnlyIfAsked)
{
  const std::string path = PathOf(page_.places.begin()->first);
  Edit({{"change", "set"}, {"path", path}, {"name", "position"}, {"value", "0.5, 0.5, 0"}});
  Write(text_ + "<!-- of others -->\n");
  EXPECT_THAT(RefusalOf(R"({"do": "save"})"), HasSubstr("somebody else has changed"));
  EXPECT_TRUE(page_.document["changed_on_disk"]);
  EXPECT_EQ(OnDisk(), text_ + "<!-- of others -->\n");
  Ask({{"do", "save"}, {"anyway", true}});
  EXPECT_TRUE(page_.document["saved"]);
  EXPECT_FALSE(page_.document["changed_on_disk"]);
  EXPECT_THAT(OnDisk(), HasSubstr("0.5, 0.5, 0"));
  EXPECT_THAT(OnDisk(), testing::Not(HasSubstr("of others")));
}

TEST_F(EditSessionTest, ReadsWhatOthersWriteIfNothingIsChangedHere)
{
  Write(text_ + "<!-- of others -->\n");
  EXPECT_TRUE(Eventually(
      [&]
      {
        session_->Idle();
        return page_.document["undo"] == "read the file again";
      }));
  EXPECT_TRUE(page_.document["saved"]);
  Ask({{"do", "undo"}});
  EXPECT_FALSE(page_.document["saved"]);

  // A file that is no experiment is not read, and the present text stays.
  Ask({{"do", "save"}});
  Write("<ahss-config>");
  EXPECT_TRUE(Eventually(
      [&]
      {
        session_->Idle();
        return page_.document["changed_on_disk"] == true;
      }));
  EXPECT_THAT(RefusalOf(R"({"do": "reload"})"), HasSubstr("f.xml"));
  EXPECT_EQ(session_->GetExperiment().Text(), text_);
}

TEST_F(EditSessionTest, ShowsAndSavesScriptsOfControllersAndNoOtherFiles)
{
  EXPECT_TRUE(page_.document["scripts"].empty());
  EXPECT_EQ(page_.document["run"]["phase"], "none");
  EXPECT_EQ(page_.document["run"]["token"], "");
  const std::string script = folder_ / "avoid.lua";
  std::ofstream(script) << "step = nil\n";
  std::ofstream(folder_ / "evade.py") << "step = None\n";
  std::ofstream(folder_ / "other.lua") << "secret\n";
  const std::size_t at = text_.find("<parameters");
  ASSERT_NE(at, std::string::npos);
  const std::size_t end = text_.find('>', at) + 1;
  std::string changed = text_;
  changed.replace(
      at, end - at,
      "<parameters><argos3 script=\"avoid.lua\" again=\"./avoid.lua\" none=\"no.lua\" python=\"evade.py\"/>" +
          std::string(text_[end - 2] == '/' ? "</parameters>" : ""));
  Write(changed);
  Ask({{"do", "reload"}});
  const Json scripts = page_.document["scripts"];
  ASSERT_EQ(scripts.size(), 2U) << scripts;
  EXPECT_EQ(scripts[1]["name"], "evade.py");
  EXPECT_EQ(scripts[0]["name"], "avoid.lua");
  const std::string file = scripts[0]["file"];
  EXPECT_EQ(file, std::filesystem::canonical(script).string());

  const Json request{{"do", "save_script"}, {"file", file}, {"text", "function step() end\n"}};
  EXPECT_THAT(RefusalOf(request.dump()), HasSubstr("read the script first"));
  Json shown = Ask({{"do", "script"}, {"file", file}});
  EXPECT_EQ(shown["type"], "script");
  EXPECT_EQ(shown["text"], "step = nil\n");
  EXPECT_EQ(Ask(request)["text"], "function step() end\n");
  EXPECT_EQ(test::TextOf(script), "function step() end\n");

  std::ofstream(script) << "of another program\n";
  EXPECT_THAT(RefusalOf(request.dump()), HasSubstr("another program has changed"));
  EXPECT_EQ(test::TextOf(script), "of another program\n");
  Json anyway = request;
  anyway["anyway"] = true;
  Ask(anyway);
  EXPECT_EQ(test::TextOf(script), "function step() end\n");
  std::ofstream(script) << "\xff";
  EXPECT_THAT(RefusalOf(Json{{"do", "script"}, {"file", file}}.dump()), HasSubstr("UTF-8"));

  for (const std::string& other : std::vector<std::string>{folder_ / "other.lua", file_, "/etc/passwd", ""})
    for (const char* verb : {"script", "save_script"})
      EXPECT_THAT(RefusalOf(Json{{"do", verb}, {"file", other}, {"text", "x"}, {"anyway", true}}.dump()),
                  HasSubstr("no controller of the experiment has this script"))
          << other;
  EXPECT_EQ(test::TextOf(folder_ / "other.lua"), "secret\n");
}

TEST_F(EditSessionTest, AFileWithMistakesDoesNotRun)
{
  Write("<ahss-config><arena size=\"1, 1, 1\"/></ahss-config>");
  Ask({{"do", "reload"}});
  EXPECT_THAT(RefusalOf(R"({"do": "run"})"), HasSubstr("mend the mistakes"));
  EXPECT_EQ(page_.document["run"]["phase"], "none");
}

TEST_F(EditSessionTest, RefusesWhatIsNoRequest)
{
  for (const char* request :
       {"", "[]", "{}", R"({"do": 1})", R"({"do": "edit"})", R"({"do": "edit", "revision": -1})",
        R"({"do": "run", "speed": "x"})", R"({"do": "script"})", R"({"do": "save_script", "file": "x"})",
        R"({"do": "form", "path": "a"})", R"({"do": "form", "path": "99999999999999999999999"})"})
    EXPECT_NE(RefusalOf(request), "") << request;
  for (const char* change :
       {R"({})", R"({"change": "x"})", R"({"change": "set", "path": "", "name": 1, "value": ""})",
        R"({"change": "set", "path": "2", "name": "size"})", R"({"change": "place", "places": [1]})",
        R"({"change": "place", "places": [{"path": "2/0", "position": [1, 2]}]})",
        R"({"change": "place", "places": [{"path": "2/0", "position": [1, 2, 1e300]}]})",
        R"({"change": "place", "places": [{"path": "2/0", "heading": "x"}]})",
        R"({"change": "add", "path": "2", "tag": "no"})", R"({"change": "remove", "paths": [2]})",
        R"({"change": "rewrite", "path": "2", "xml": "<"})", R"({"change": "write out", "path": "2/0"})"})
  {
    Json request = Json::parse(change);
    request["do"] = "edit";
    request["revision"] = page_.document["revision"];
    EXPECT_NE(RefusalOf(request.dump()), "") << change;
  }
  EXPECT_TRUE(page_.document["saved"]);
  EXPECT_EQ(session_->GetExperiment().Text(), text_);
}

}  // namespace
}  // namespace swarmanoid
