// Parameters that a controller never reads are mistakes of the file, unless it declared them or reads them later.
#include "common/control_interface/init_controller.h"

#include <gtest/gtest.h>

#include "common/configuration/xml_reader.h"

namespace swarmanoid
{
namespace
{

class Walker : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    tree_ = t_tree;
    velocity_ = t_tree.GetNumber("velocity", 0.1);
    t_tree.Child("gains").GetNumber("kp", 1);
    return t_tree.GetBoolean("fail", false) ? RETURN_ERROR : RETURN_OK;
  }
  void ControlStep() override {}
  bool ReadsParametersLater() const override { return later_; }

  TConfigurationTree tree_;
  double velocity_ = 0;
  bool later_ = false;
};

const PluginDescription kUndeclared{.label = "walker", .declares_parameters = false};

std::string ErrorOf(Walker& walker, const std::string& content, const PluginDescription& description = kUndeclared)
{
  try
  {
    const TConfigurationTree tree(ReadXml("<parameters>\n" + content + "</parameters>", "f.xml"));
    return std::to_string(InitController(walker, description, "w", tree));
  }
  catch (const ConfigurationError& error)
  {
    return error.what();
  }
}

std::string ErrorOf(const std::string& content)
{
  Walker walker;
  return ErrorOf(walker, content);
}

constexpr const char* kCure = "; a controller that asks for it after Init overrides ReadsParametersLater";

TEST(InitController, WhatIsReadIsFine)
{
  EXPECT_EQ(ErrorOf("<velocity>2</velocity><gains><kp>3</kp></gains>"), "0");
  EXPECT_EQ(ErrorOf(""), "0");
  Walker walker;
  EXPECT_EQ(InitController(walker, kUndeclared, "w", TConfigurationTree()), 0);
}

TEST(InitController, WhatIsNeverReadIsNamedWithThePlaceAndTheNearestName)
{
  EXPECT_EQ(ErrorOf("<velocty>2</velocty>"),
            std::string("f.xml:2:1: the controller 'w' (walker) never reads the parameter 'velocty'; it reads: fail, "
                        "gains, velocity; did you mean 'velocity'?") +
                kCure);
  EXPECT_EQ(ErrorOf("<gains kq='1'/>"),
            std::string("f.xml:2:8: the controller 'w' (walker) never reads the parameter 'kq' of <gains>; it reads: kp"
                        "; did you mean 'kp'?") +
                kCure);
  EXPECT_EQ(ErrorOf("fast"),
            std::string("f.xml:1:1: the controller 'w' (walker) never reads the text of <parameters>") + kCure);
}

TEST(InitController, AllThatIsNeverReadIsNamedAtOnce)
{
  EXPECT_EQ(ErrorOf("<a/>\n<b/>"),
            std::string("f.xml:2:1: the controller 'w' (walker) never reads the parameter 'a'; "
                        "it reads: fail, gains, velocity\nf.xml:3:1: the controller 'w' (walker) "
                        "never reads the parameter 'b'; it reads: fail, gains, velocity") +
                kCure);
}

TEST(InitController, AControllerMayReadLater)
{
  Walker walker;
  walker.later_ = true;
  EXPECT_EQ(ErrorOf(walker, "<colour>red</colour>"), "0");
  EXPECT_EQ(walker.tree_.GetColour("colour"), 0xff0000U);
}

TEST(InitController, WhatWasDeclaredNeedsNotBeRead)
{
  Walker walker;
  EXPECT_EQ(ErrorOf(walker, "<colour>red</colour>", {.label = "walker"}), "0");
}

TEST(InitController, AControllerThatRefusesIsAskedNoMore)
{
  EXPECT_EQ(ErrorOf("<fail>yes</fail><velocty>2</velocty>"), "1");
}

TEST(InitController, AMissingParameterComesWithWhatWasPerhapsMeant)
{
  class Strict : public Walker
  {
    int Init(const TConfigurationTree t_tree) override
    {
      t_tree.GetNumber("velocity");
      return RETURN_OK;
    }
  };
  Strict strict;
  EXPECT_EQ(ErrorOf(strict, "<velocty>2</velocty>"),
            "f.xml:2:1: <parameters> lacks the parameter 'velocity'; it has 'velocty': is that meant?");
}

}  // namespace
}  // namespace swarmanoid
