#include "studies/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"

namespace swarmanoid
{

struct Expression::Node
{
  std::string operation;  // empty: a value or a name
  ExpressionValue value = 0.0;
  std::size_t name = 0;
  bool is_name = false;
  std::vector<std::unique_ptr<Node>> operands;
};

namespace
{

using ExpressionNode = std::unique_ptr<Expression::Node>;
using NamedValues = std::function<ExpressionValue(std::size_t)>;

constexpr int kDeepestExpression = 100;

bool IsWordCharacter(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == ':';
}

class ExpressionParser
{
public:
  ExpressionParser(std::string_view text, const std::vector<std::string>& names) : text_(text), names_(names)
  {
    Next();
  }

  ExpressionNode Parse()
  {
    ExpressionNode node = ParseLevel(0);
    if (!token_.empty()) Fail(fmt::format("{} is not expected here", Quoted(token_)));
    return node;
  }

private:
  // From the weakest to the strongest.
  static bool IsOperation(int level, const std::string& token)
  {
    static const std::vector<std::vector<std::string>> kLevels{
        {"or"}, {"and"}, {"<", "<=", ">", ">=", "==", "!="}, {"+", "-"}, {"*", "/", "%"}};
    const auto& operations = kLevels[static_cast<std::size_t>(level)];
    return std::find(operations.begin(), operations.end(), token) != operations.end();
  }

  [[noreturn]] void Fail(const std::string& what) const
  {
    throw ExpressionError(fmt::format("{}, at character {} of {}", what, start_ + 1, Quoted(text_)));
  }

  void Next()
  {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
    start_ = at_;
    is_text_ = false;
    if (at_ == text_.size()) return token_.clear();
    if (text_[at_] == '\'')
    {
      const std::size_t end = text_.find('\'', at_ + 1);
      if (end == std::string_view::npos) Fail("a text has no second '");
      token_ = text_.substr(at_, end + 1 - at_);
      is_text_ = true;
      at_ = end + 1;
      return;
    }
    std::size_t length = 1;
    if (IsWordCharacter(text_[at_]))
    {
      // 1e-3 is one number.
      const bool number = text_[at_] >= '0' && text_[at_] <= '9';
      while (at_ + length < text_.size() &&
             (IsWordCharacter(text_[at_ + length]) ||
              (number && std::string_view("+-").find(text_[at_ + length]) != std::string_view::npos &&
               std::string_view("eE").find(text_[at_ + length - 1]) != std::string_view::npos)))
        ++length;
    }
    else if (std::string_view("<>=!").find(text_[at_]) != std::string_view::npos && at_ + 1 < text_.size() &&
             text_[at_ + 1] == '=')
    {
      length = 2;
    }
    token_ = text_.substr(at_, length);
    at_ += length;
  }

  ExpressionNode ParseLevel(int level)
  {
    constexpr int kOperand = 5;
    if (level == kOperand) return ParseOperand();
    ExpressionNode left = ParseLevel(level + 1);
    while (!is_text_ && IsOperation(level, token_))
    {
      auto node = std::make_unique<Expression::Node>();
      node->operation = token_;
      Next();
      node->operands.push_back(std::move(left));
      node->operands.push_back(ParseLevel(level + 1));
      left = std::move(node);
    }
    return left;
  }

  ExpressionNode ParseOperand()
  {
    if (++depth_ > kDeepestExpression) Fail("too many parentheses");
    auto node = std::make_unique<Expression::Node>();
    if (is_text_)
    {
      node->value = token_.substr(1, token_.size() - 2);
      Next();
    }
    else if (token_ == "(")
    {
      Next();
      node = ParseLevel(0);
      if (token_ != ")" || is_text_) Fail("a ( has no )");
      Next();
    }
    else if (token_ == "-" || token_ == "not")
    {
      node->operation = token_ == "-" ? "negative" : "not";
      // "not" is weaker than a comparison, a sign stronger than all.
      const int level = token_ == "-" ? 5 : 2;
      Next();
      node->operands.push_back(ParseLevel(level));
    }
    else if (const auto number = ParseNumber(token_); number && !token_.empty())
    {
      node->value = *number;
      Next();
    }
    else
    {
      node->is_name = true;
      node->name = NumberOfName();
      Next();
    }
    --depth_;
    return node;
  }

  std::size_t NumberOfName() const
  {
    if (token_.empty()) Fail("a number, a name or a text is missing");
    const auto found = std::find(names_.begin(), names_.end(), token_);
    if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
    Fail(fmt::format("there is no {}; there are: {}{}; a text stands in '…'", Quoted(token_), Listed(names_),
                     DidYouMean(token_, names_)));
  }

  std::string_view text_;
  const std::vector<std::string>& names_;
  std::size_t at_ = 0;
  std::size_t start_ = 0;  // of the token
  std::string token_;      // empty: the end
  bool is_text_ = false;
  int depth_ = 0;
};

double NumberIn(const ExpressionValue& value, const std::string& operation)
{
  if (const double* number = std::get_if<double>(&value)) return *number;
  throw ExpressionError(
      fmt::format("{} is a text; '{}' takes numbers", Quoted(std::get<std::string>(value)), operation));
}

ExpressionValue Evaluate(const Expression::Node& node, const NamedValues& value_of);

double Evaluated(const Expression::Node& node, std::size_t operand, const NamedValues& value_of)
{
  return NumberIn(Evaluate(*node.operands[operand], value_of), node.operation);
}

double Compared(const Expression::Node& node, const NamedValues& value_of)
{
  const ExpressionValue left = Evaluate(*node.operands[0], value_of);
  const ExpressionValue right = Evaluate(*node.operands[1], value_of);
  const std::string& operation = node.operation;
  if (operation == "==") return left == right ? 1 : 0;
  if (operation == "!=") return left != right ? 1 : 0;
  const double a = NumberIn(left, operation);
  const double b = NumberIn(right, operation);
  const bool holds = operation == "<" ? a < b : operation == "<=" ? a <= b : operation == ">" ? a > b : a >= b;
  return holds ? 1 : 0;
}

ExpressionValue Evaluate(const Expression::Node& node, const NamedValues& value_of)
{
  if (node.is_name) return value_of(node.name);
  const std::string& operation = node.operation;
  if (operation.empty()) return node.value;
  const auto operand = [&](std::size_t i) { return Evaluated(node, i, value_of); };
  if (operation == "or") return operand(0) != 0 || operand(1) != 0 ? 1.0 : 0.0;
  if (operation == "and") return operand(0) != 0 && operand(1) != 0 ? 1.0 : 0.0;
  if (operation == "not") return operand(0) == 0 ? 1.0 : 0.0;
  if (operation == "negative") return -operand(0);
  if (operation == "+") return operand(0) + operand(1);
  if (operation == "-") return operand(0) - operand(1);
  if (operation == "*") return operand(0) * operand(1);
  if (operation == "/") return operand(0) / operand(1);
  if (operation == "%") return std::fmod(operand(0), operand(1));
  return Compared(node, value_of);
}

}  // namespace

Expression::Expression(std::string_view text, const std::vector<std::string>& names)
    : root_(ExpressionParser(text, names).Parse())
{
}

Expression::~Expression() = default;
Expression::Expression(Expression&&) noexcept = default;

bool Expression::Holds(const std::function<ExpressionValue(std::size_t name)>& value_of) const
{
  return NumberIn(Evaluate(*root_, value_of), "the condition") != 0;
}

}  // namespace swarmanoid
