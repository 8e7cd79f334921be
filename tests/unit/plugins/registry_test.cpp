// Plug-ins that are described in one place and get their code in another.
#include <gmock/gmock.h>

#include <stdexcept>

#include "common/plugins/registry.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

struct Plugin
{
  virtual ~Plugin() = default;
};
using Registry = PluginRegistry<Plugin>;

void Describe(PluginKind kind, const char* label, const char* implementation)
{
  PluginCatalogue::Instance().Add(kind, {.label = label, .implementation = implementation, .brief = "a brief"});
}

const auto make_plugin = [] { return std::make_unique<Plugin>(); };

template <class Call>
std::string MistakeOf(const Call& call)
{
  return test::MessageOf<std::logic_error>(call);
}

TEST(PluginRegistry, CodeIsFoundWithTheDescriptionOfTheCatalogue)
{
  Registry registry(PluginKind::kSensor);
  Describe(PluginKind::kSensor, "bound", "simple_bound");
  registry.Bind("bound", "simple_bound", make_plugin);
  const Registry::Entry* entry = registry.Find("bound", "simple_bound");
  ASSERT_NE(entry, nullptr);
  EXPECT_EQ(&entry->description, PluginCatalogue::Instance().Find(PluginKind::kSensor, "bound", "simple_bound"));
  EXPECT_NE(entry->create(), nullptr);
  EXPECT_EQ(registry.Find("bound"), nullptr);
}

TEST(PluginRegistry, CodeOfWhatNobodyDescribedIsRefused)
{
  Registry registry(PluginKind::kActuator);
  Describe(PluginKind::kActuator, "wheels", "simple_wheels");
  Describe(PluginKind::kSensor, "wheels", "round_wheels");
  EXPECT_EQ(MistakeOf([&] { registry.Bind("wheels", "round_wheels", make_plugin); }),
            "actuator 'wheels' (round_wheels) is not described");
  EXPECT_EQ(registry.Find("wheels", "round_wheels"), nullptr);
}

TEST(PluginRegistry, OneDescriptionHasOneCode)
{
  Registry registry(PluginKind::kEngine);
  Describe(PluginKind::kEngine, "solver", "");
  registry.Bind("solver", "", make_plugin);
  EXPECT_EQ(MistakeOf([&] { registry.Bind("solver", "", make_plugin); }), "physics engine 'solver' has code already");
}

TEST(PluginRegistry, ADescriptionWithoutCodeIsFound)
{
  Registry registry(PluginKind::kRenderer);
  registry.Add({.label = "with_code"}, make_plugin);
  EXPECT_EQ(MistakeOf([&] { registry.RequireCode(); }), "");
  Describe(PluginKind::kRenderer, "without_code", "");
  EXPECT_EQ(MistakeOf([&] { registry.RequireCode(); }), "visualisation 'without_code' has no code");
  registry.Bind("without_code", "", make_plugin);
  EXPECT_EQ(MistakeOf([&] { registry.RequireCode(); }), "");
}

}  // namespace
}  // namespace swarmanoid
