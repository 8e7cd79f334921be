// Conditions over the factors of a study: "robots * speed < 5 and controller != 'still'". For <require> and --only.
// One thread.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace swarmanoid
{

using ExpressionValue = std::variant<double, std::string>;

// The text is no expression, or its values do not fit. what() says what is wrong and what would do.
class ExpressionError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

class Expression
{
public:
  // Numbers, 'texts', names; or, and, not; < <= > >= == !=; + - * / %; parentheses. Of `names` all that stand in it are
  // known. Throws ExpressionError.
  Expression(std::string_view text, const std::vector<std::string>& names);
  ~Expression();
  Expression(Expression&&) noexcept;

  // `value_of`: of a name, by its place in `names`. Throws ExpressionError if a text is computed with, or compared with
  // a number by order.
  bool Holds(const std::function<ExpressionValue(std::size_t name)>& value_of) const;

  struct Node;

private:
  std::unique_ptr<Node> root_;
};

}  // namespace swarmanoid
