// A recursive descent parser with one function for all binary operators: kLevels lists them by precedence. Each rule
// returns a Term, a function of the names' values, so that a condition is parsed once and evaluated for each point.
// Numbers stand for truth values: 0 is false.
#include "studies/design/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

using Term = Expression::Term;
using Operation = double (*)(double, double);

constexpr int kDeepestExpression = 100;

bool IsWordCharacter(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' || c == ':';
}

double NumberIn(const ExpressionValue& value, std::string_view operation)
{
  if (const double* number = std::get_if<double>(&value)) return *number;
  throw ExpressionError(
      fmt::format("{} is a text; '{}' takes numbers", Quoted(std::get<std::string>(value)), operation));
}

// The levels ascend from the weakest to the strongest. If the first operand of `or` or `and` decides, Joined does not
// evaluate the second one. The operators == and != accept texts too.
const std::vector<std::map<std::string, Operation, std::less<>>> kLevels{
    {{"or", [](double, double b) { return b != 0 ? 1.0 : 0.0; }}},
    {{"and", [](double, double b) { return b != 0 ? 1.0 : 0.0; }}},
    {{"==", nullptr},
     {"!=", nullptr},
     {"<", [](double a, double b) { return a < b ? 1.0 : 0.0; }},
     {"<=", [](double a, double b) { return a <= b ? 1.0 : 0.0; }},
     {">", [](double a, double b) { return a > b ? 1.0 : 0.0; }},
     {">=", [](double a, double b) { return a >= b ? 1.0 : 0.0; }}},
    {{"+", [](double a, double b) { return a + b; }}, {"-", [](double a, double b) { return a - b; }}},
    {{"*", [](double a, double b) { return a * b; }},
     {"/", [](double a, double b) { return a / b; }},
     {"%", [](double a, double b) { return std::fmod(a, b); }}}};

Term Joined(const std::string& operation, Operation compute, Term left, Term right)
{
  return [operation, compute, left = std::move(left), right = std::move(right)](const NamedValues& value_of)
  {
    const ExpressionValue a = left(value_of);
    if (operation == "or" && NumberIn(a, operation) != 0) return ExpressionValue(1.0);
    if (operation == "and" && NumberIn(a, operation) == 0) return ExpressionValue(0.0);
    const ExpressionValue b = right(value_of);
    if (compute == nullptr) return ExpressionValue((a == b) == (operation == "==") ? 1.0 : 0.0);
    const double x = NumberIn(a, operation);
    return ExpressionValue(compute(x, NumberIn(b, operation)));
  };
}

class ExpressionParser
{
public:
  ExpressionParser(std::string_view text, const std::vector<std::string>& names) : text_(text), names_(names)
  {
    Next();
  }

  Term Parse()
  {
    Term term = ParseLevel(0);
    if (!token_.empty()) Fail(fmt::format("{} is not expected here", Quoted(token_)));
    return term;
  }

private:
  [[noreturn]] void Fail(const std::string& what) const
  {
    throw ExpressionError(fmt::format("{}, at character {} of {}", what, start_ + 1, Quoted(text_)));
  }

  void Next()
  {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
    start_ = at_;
    if (at_ == text_.size()) return token_.clear();
    if (text_[at_] == '\'')
    {
      const std::size_t end = text_.find('\'', at_ + 1);
      if (end == std::string_view::npos) Fail("a text has no second '");
      token_ = text_.substr(at_, end + 1 - at_);
      at_ = end + 1;
      return;
    }
    std::size_t length = 1;
    if (IsWordCharacter(text_[at_]))
    {
      // The exponent belongs to the number: 1e-3 is one number.
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

  Term ParseLevel(std::size_t level)
  {
    if (level == kLevels.size()) return ParseOperand();
    Term left = ParseLevel(level + 1);
    for (auto found = kLevels[level].find(token_); found != kLevels[level].end(); found = kLevels[level].find(token_))
    {
      Next();
      left = Joined(found->first, found->second, std::move(left), ParseLevel(level + 1));
    }
    return left;
  }

  Term ParseOperand()
  {
    if (++depth_ > kDeepestExpression) Fail("too many parentheses");
    Term term;
    if (token_.starts_with('\''))
    {
      term = [text = ExpressionValue(token_.substr(1, token_.size() - 2))](const NamedValues&) { return text; };
      Next();
    }
    else if (token_ == "(")
    {
      Next();
      term = ParseLevel(0);
      if (token_ != ")") Fail("a ( has no )");
      Next();
    }
    else if (token_ == "-")
    {
      Next();
      term = [of = ParseOperand()](const NamedValues& value_of) { return -NumberIn(of(value_of), "-"); };
    }
    else if (token_ == "not")
    {
      Next();
      // `not` is weaker than a comparison.
      term = [of = ParseLevel(2)](const NamedValues& value_of)
      { return NumberIn(of(value_of), "not") == 0 ? 1.0 : 0.0; };
    }
    else if (const auto number = ParseNumber(token_); number && !token_.empty())
    {
      term = [number = *number](const NamedValues&) { return number; };
      Next();
    }
    else
    {
      term = [name = NumberOfName()](const NamedValues& value_of) { return value_of(name); };
      Next();
    }
    --depth_;
    return term;
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
  std::size_t start_ = 0;  // the start of the token
  std::string token_;      // empty: the end
  int depth_ = 0;
};

}  // namespace

Expression::Expression(std::string_view text, const std::vector<std::string>& names)
    : condition_(ExpressionParser(text, names).Parse())
{
}

bool Expression::Holds(const NamedValues& value_of) const
{
  return NumberIn(condition_(value_of), "the condition") != 0;
}

}  // namespace swarmanoid
