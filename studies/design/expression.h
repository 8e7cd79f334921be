// Conditions over the factors of a study: "robots * speed < 5 and controller != 'still'". They are used for <require>
// and --only. One thread.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace swarmanoid
{

using ExpressionValue = std::variant<double, std::string>;
// Returns the value of a name, given by its index among the names of the expression.
using NamedValues = std::function<ExpressionValue(std::size_t name)>;

// The text is no expression, or its values do not fit. what() gives the mistake and the cure.
class ExpressionError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

class Expression
{
public:
  // Parses numbers, 'texts' and `names`; or, and, not; < <= > >= == !=; + - * / %; parentheses. Throws ExpressionError.
  Expression(std::string_view text, const std::vector<std::string>& names);

  // Throws ExpressionError if a text is an operand of arithmetic, or is compared with a number by order.
  bool Holds(const NamedValues& value_of) const;

  using Term = std::function<ExpressionValue(const NamedValues&)>;

private:
  Term condition_;
};

}  // namespace swarmanoid
