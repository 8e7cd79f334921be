// The table of control verbs: each verb through each door, with good, missing, extra and bad arguments that are made
// from its row.
#include "common/messages/control_verbs.h"

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "test_folders.h"

namespace swarmanoid
{
namespace
{

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

ControlValue GoodValue(const ControlParameter& parameter)
{
  switch (parameter.type)
  {
    case ArgumentType::kName:
      return std::string("ground über");
    case ArgumentType::kChoice:
      return parameter.choices.back();
    case ArgumentType::kWhole:
    case ArgumentType::kChange:
      return static_cast<std::int64_t>(parameter.minimum + 1);
    case ArgumentType::kNumber:
      return parameter.minimum + 0.125;
    case ArgumentType::kPose:
      return std::vector<double>{1, 2.5, 0, 0, 0, parameter.minimum};
  }
  return {};
}

// Returns a value of the parameter's type outside its range, and a value of another type.
std::vector<ControlValue> BadValues(const ControlParameter& parameter)
{
  const ControlValue other = parameter.type == ArgumentType::kPose ? ControlValue(1.5) : std::vector<double>{1, 2, 3};
  switch (parameter.type)
  {
    case ArgumentType::kName:
      return {std::string(), std::string(1025, 'x'), std::string("a\nb"), std::string("\xff"), other};
    case ArgumentType::kChoice:
      return {std::string("king"), other};
    case ArgumentType::kWhole:
    case ArgumentType::kChange:
      return {static_cast<std::int64_t>(parameter.minimum) - 1, std::int64_t{INT64_MAX}, 0.5, std::string("1"), other};
    case ArgumentType::kNumber:
      return {parameter.minimum - 1, parameter.maximum * 2, std::int64_t{1}, other};
    case ArgumentType::kPose:
      return {std::vector<double>{1, 2}, std::vector<double>(7, 0.0), std::vector<double>{1, 2, parameter.maximum * 2},
              other};
  }
  return {};
}

ControlOrder GoodOrder(const ControlVerb& verb)
{
  ControlOrder order{verb.name};
  for (const ControlParameter& parameter : verb.parameters)
    order.arguments.push_back({parameter.name, GoodValue(parameter)});
  return order;
}

std::vector<std::string> WordsOf(const ControlVerb& verb, const ControlOrder& order)
{
  std::vector<std::string> words;
  for (std::size_t k = 0; k < verb.parameters.size(); ++k)
    if (!verb.parameters[k].is_option) words.push_back(TextOf(verb.parameters[k], order.arguments[k].value));
  return words;
}

std::map<std::string, std::string> OptionsOf(const ControlVerb& verb, const ControlOrder& order)
{
  std::map<std::string, std::string> options;
  for (std::size_t k = 0; k < verb.parameters.size(); ++k)
    if (verb.parameters[k].is_option)
      options[verb.parameters[k].name] = TextOf(verb.parameters[k], order.arguments[k].value);
  return options;
}

std::string RefusalOf(const std::function<void()>& call)
{
  try
  {
    call();
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "";
}

TEST(ControlVerbs, GoodOrdersPassTheCheckAndAreReadAsTheyWereWritten)
{
  for (const ControlVerb& verb : ControlVerbs())
  {
    const ControlOrder order = GoodOrder(verb);
    EXPECT_EQ(OrderError(order, Asker::kNobody), "") << verb.name;
    EXPECT_EQ(ParseOrder(verb, OptionsOf(verb, order), WordsOf(verb, order)), order) << verb.name;
    EXPECT_FALSE(verb.help.empty() || verb.help.ends_with(".")) << verb.name;
    EXPECT_TRUE(TextOf(order).starts_with(verb.name));
    if (verb.parameters.size() == 1 && verb.parameters[0].type == ArgumentType::kName) continue;
    // A name with blanks fits the column of names alone.
    ControlOrder logged = order;
    for (ControlArgument& argument : logged.arguments)
      if (std::holds_alternative<std::string>(argument.value) && argument.name == "machine") argument.value = "alpha";
    EXPECT_EQ(OrderOf(verb, ColumnsOf(logged)), logged) << verb.name;
  }
}

TEST(ControlVerbs, EachMissingExtraAndBadArgumentIsRefused)
{
  for (const ControlVerb& verb : ControlVerbs())
  {
    const ControlOrder good = GoodOrder(verb);
    for (std::size_t k = 0; k < verb.parameters.size(); ++k)
    {
      const ControlParameter& parameter = verb.parameters[k];
      ControlOrder missing = good;
      missing.arguments.erase(missing.arguments.begin() + static_cast<std::ptrdiff_t>(k));
      EXPECT_EQ(OrderError(missing, Asker::kNobody).empty(), parameter.optional) << verb.name << " " << parameter.name;
      for (const ControlValue& value : BadValues(parameter))
      {
        ControlOrder bad = good;
        bad.arguments[k].value = value;
        EXPECT_THAT(OrderError(bad, Asker::kNobody), AllOf(HasSubstr(verb.name + ": "), HasSubstr(FormOf(verb))))
            << parameter.name << " " << value.index();
      }
    }
    ControlOrder extra = good;
    extra.arguments.push_back({"extra", std::string("x")});
    EXPECT_THAT(OrderError(extra, Asker::kNobody), HasSubstr("it takes no 'extra'"));
    if (good.arguments.empty()) continue;
    extra.arguments.back() = good.arguments[0];
    EXPECT_THAT(OrderError(extra, Asker::kNobody), HasSubstr("it has two of"));
  }
}

TEST(ControlVerbs, EachMissingExtraAndBadWordIsRefusedWithTheForm)
{
  for (const ControlVerb& verb : ControlVerbs())
  {
    const ControlOrder good = GoodOrder(verb);
    const auto options = OptionsOf(verb, good);
    const auto refusal = [&](const std::vector<std::string>& words)
    { return RefusalOf([&] { ParseOrder(verb, options, words); }); };
    const std::vector<std::string> words = WordsOf(verb, good);
    std::vector<std::string> extra = words;
    extra.emplace_back("extra");
    EXPECT_THAT(refusal(extra), HasSubstr("write " + FormOf(verb)));
    const bool needs_one = !verb.parameters.empty() && !verb.parameters[0].optional;
    EXPECT_EQ(!refusal({}).empty(), needs_one) << verb.name;
    EXPECT_THAT(RefusalOf(
                    [&] {
                      ParseOrder(verb, {{"height", "1"}}, words);
                    }),
                HasSubstr(verb.name + ": it takes no 'height'"));
    for (std::size_t k = 0; k < words.size(); ++k)
    {
      if (verb.parameters[k].type == ArgumentType::kName) continue;
      std::vector<std::string> bad = words;
      bad[k] = "nan";
      EXPECT_THAT(refusal(bad), HasSubstr("write " + FormOf(verb)));
    }
  }
}

TEST(ControlVerbs, AskersMayUseTheVerbsOfTheirRankAndBelow)
{
  EXPECT_NE(FindControlVerb("stop", Asker::kOperator), nullptr);
  EXPECT_EQ(FindControlVerb("reset", Asker::kOperator), nullptr);
  EXPECT_NE(FindControlVerb("reset", Asker::kMember), nullptr);
  EXPECT_EQ(FindControlVerb("share", Asker::kMember), nullptr);
  EXPECT_NE(FindControlVerb("share"), nullptr);
  EXPECT_EQ(FindControlVerb("failed"), nullptr);
  EXPECT_THAT(OrderError({"paus"}), AllOf(HasSubstr("pause, resume, step"), HasSubstr("did you mean 'pause'?")));
}

TEST(ControlVerbs, ChangesAreWrittenWithTheirSign)
{
  const ControlVerb& hosts = *FindControlVerb("hosts");
  const auto change = [&](const std::vector<std::string>& words)
  { return ParseOrder(hosts, {}, words).Get<std::int64_t>("change"); };
  EXPECT_EQ(change({"+2"}), 2);
  EXPECT_EQ(change({"-1", "beta"}), -1);
  EXPECT_EQ(change({"again"}), 0);
  for (const char* word : {"2", "+0", "0", "+-1", "+", "+1001", "+1.5", ""})
    EXPECT_THAT(RefusalOf([&] { change({word}); }), HasSubstr("write hosts +N/-N/again [MACHINE]")) << word;
  EXPECT_THAT(RefusalOf([&] { change({"again", "beta"}); }), HasSubstr("hosts: again takes no machine"));
}

TEST(ControlVerbs, TheColumnsOfAnEventAreTheNameAndTheRest)
{
  const auto columns = [](const ControlOrder& order)
  {
    const OrderColumns read = ColumnsOf(order);
    return read.entity + "," + read.numbers;
  };
  EXPECT_EQ(columns({"move", {{"entity", "fb_0"}, {"pose", std::vector<double>{1.5, 0.1, 0}}}}), "fb_0,1.5 0.1 0");
  EXPECT_EQ(columns({"step", {{"ticks", std::int64_t{7}}}}), ",7");
  EXPECT_EQ(columns({"reset", {{"seed", std::int64_t{9007199254740993}}}}), "9007199254740993,");
  EXPECT_EQ(columns({"hosts", {{"change", std::int64_t{1}}, {"machine", "beta"}}}), "beta,+1");
  EXPECT_EQ(columns({"move-host", {{"host", std::int64_t{1}}, {"machine", "beta"}}}), "1,beta");
  EXPECT_EQ(columns({"share", {{"grant", "0a"}, {"role", "open"}, {"ends", std::int64_t{0}}}}), "0a,open 0");
}

TEST(ControlVerbs, ThePageOfTheCommandHasTheTable)
{
  std::ifstream file(SWARMANOID_SOURCE_FOLDER "/docs/command.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  EXPECT_THAT(page, HasSubstr(ControlVerbTable(Asker::kMember))) << "put the table into docs/command.md";
}

}  // namespace
}  // namespace swarmanoid
