// Conditions over the factors of a study: "robots * speed < 5 and controller != 'still'". For <require> and --only.
// One thread.
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
// The value of a name, by its place among the names of the expression.
using NamedValues = std::function<ExpressionValue(std::size_t name)>;

// The text is no expression, or its values do not fit. what() says what is wrong and what would do.
class ExpressionError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

class Expression
{
public:
  // Numbers, 'texts', `names`; or, and, not; < <= > >= == !=; + - * / %; parentheses. Throws ExpressionError.
  Expression(std::string_view text, const std::vector<std::string>& names);

  // Throws ExpressionError if a text is computed with, or compared with a number by order.
  bool Holds(const NamedValues& value_of) const;

  using Term = std::function<ExpressionValue(const NamedValues&)>;

private:
  Term condition_;
};

}  // namespace swarmanoid
