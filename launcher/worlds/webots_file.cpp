#include "launcher/worlds/webots_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "common/configuration/place_counter.h"
#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

constexpr std::string_view kHeader = "#VRML_SIM ";
constexpr int kMostLevels = 64;
constexpr std::size_t kMostNodes = 2'000'000;

struct Token
{
  enum class Kind
  {
    kEnd,
    kName,
    kNumber,
    kText,  // its text is without quotes
    kSign   // { } [ ]
  };
  Kind kind = Kind::kEnd;
  std::string text;
  std::size_t offset = 0;

  bool Is(std::string_view sign) const { return kind == Kind::kSign && text == sign; }
  bool IsName(std::string_view name) const { return kind == Kind::kName && text == name; }
};

class Parser
{
public:
  Parser(std::string_view text, const std::string& file)
      : text_(text), places_(text, std::make_shared<const std::string>(file))
  {
    Advance();
  }

  std::shared_ptr<const ConfigurationNode> Read()
  {
    auto root = std::make_shared<ConfigurationNode>();
    root->name = "world";
    root->location = places_.At(0);
    while (token_.kind != Token::Kind::kEnd)
    {
      if (token_.IsName("EXTERNPROTO") || token_.IsName("IMPORTABLE"))
        SkipImport();
      else if (token_.IsName("PROTO"))
        Fail("a PROTO in a world cannot be read; convert the world with Webots, or take the PROTO out");
      else
        root->children.push_back(ReadNode());
    }
    return root;
  }

private:
  [[noreturn]] void Fail(const std::string& message) { throw ConfigurationError(places_.At(token_.offset), message); }
  std::string Shown() const { return token_.kind == Token::Kind::kEnd ? "the end of the file" : Quoted(token_.text); }

  static bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ','; }
  static bool IsSign(char c) { return c == '{' || c == '}' || c == '[' || c == ']'; }

  void SkipBlanks()
  {
    while (at_ < text_.size())
    {
      if (text_[at_] == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (IsBlank(text_[at_]))
        ++at_;
      else
        return;
    }
  }

  void Advance()
  {
    SkipBlanks();
    token_ = {Token::Kind::kEnd, {}, at_};
    if (at_ >= text_.size()) return;
    const char first = text_[at_];
    if (IsSign(first))
    {
      token_.kind = Token::Kind::kSign;
      token_.text = text_[at_++];
      return;
    }
    if (first == '"') return ReadText();
    const std::size_t start = at_;
    while (at_ < text_.size() && !IsBlank(text_[at_]) && !IsSign(text_[at_]) && text_[at_] != '"' && text_[at_] != '#')
      ++at_;
    token_.text = text_.substr(start, at_ - start);
    const bool is_number = (first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.';
    token_.kind = is_number ? Token::Kind::kNumber : Token::Kind::kName;
    if (is_number && !ParseNumber(token_.text)) Fail(fmt::format("{} is no number", Shown()));
  }

  void ReadText()
  {
    token_.kind = Token::Kind::kText;
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_)
    {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
      token_.text += text_[at_];
    }
    if (at_ >= text_.size()) Fail("a text without a closing quote");
    ++at_;
  }

  void Expect(std::string_view sign, const char* where)
  {
    if (!token_.Is(sign)) Fail(fmt::format("{} instead of '{}' {}", Shown(), sign, where));
    Advance();
  }

  std::string TakeName(const char* what)
  {
    if (token_.kind != Token::Kind::kName) Fail(fmt::format("{} instead of {}", Shown(), what));
    std::string name = std::move(token_.text);
    Advance();
    return name;
  }

  void SkipImport()
  {
    while (token_.kind == Token::Kind::kName) Advance();
    if (token_.kind != Token::Kind::kText) Fail(fmt::format("{} instead of the address of a PROTO", Shown()));
    Advance();
  }

  // Counts nodes, also those of USE, which could repeat each other without end.
  void Count(std::size_t nodes)
  {
    count_ += nodes;
    if (count_ > kMostNodes) Fail(fmt::format("more than {} nodes, with those of USE", kMostNodes));
  }

  // Reads "DEF name Type {…}", "Type {…}" or "USE name".
  std::shared_ptr<const ConfigurationNode> ReadNode()
  {
    if (token_.IsName("USE"))
    {
      Advance();
      const std::size_t offset = token_.offset;
      const std::string name = TakeName("a name after USE");
      const auto found = defined_.find(name);
      if (found == defined_.end())
        throw ConfigurationError(places_.At(offset),
                                 fmt::format("USE {}: no DEF before it has this name", Quoted(name)));
      Count(found->second.second);
      return found->second.first;
    }
    std::string defined;
    const std::size_t offset = token_.offset;
    if (token_.IsName("DEF"))
    {
      Advance();
      defined = TakeName("a name after DEF");
    }
    auto node = std::make_shared<ConfigurationNode>();
    node->location = places_.At(offset);
    node->name = TakeName("a node");
    if (!defined.empty()) node->attributes.push_back({"DEF", defined, node->location});
    const std::size_t before = count_;
    Count(1);
    if (++level_ > kMostLevels) Fail(fmt::format("more than {} nodes within each other", kMostLevels));
    Expect("{", fmt::format("after {}", Quoted(node->name)).c_str());
    while (!token_.Is("}")) ReadField(*node);
    Advance();
    --level_;
    if (!defined.empty()) defined_[defined] = {node, count_ - before};
    return node;
  }

  void ReadField(ConfigurationNode& node)
  {
    const bool is_hidden = token_.IsName("hidden");
    if (is_hidden) Advance();
    const SourceLocation place = places_.At(token_.offset);
    const std::string name = TakeName(fmt::format("a field of {}, or '}}'", node.name).c_str());
    ConfigurationNode field;
    field.name = name;
    field.location = place;
    bool has_nodes = false;
    if (token_.Is("["))
    {
      Advance();
      while (!token_.Is("]"))
      {
        if (token_.kind == Token::Kind::kEnd) Fail(fmt::format("the end of the file within the list of '{}'", name));
        has_nodes |= ReadValue(field);
      }
      Advance();
    }
    else
    {
      has_nodes = ReadValue(field);
      // A vector is several numbers without brackets.
      while (!has_nodes && token_.kind == Token::Kind::kNumber) ReadValue(field);
    }
    if (is_hidden) return;
    if (has_nodes)
      node.children.push_back(std::make_shared<const ConfigurationNode>(std::move(field)));
    else
      node.attributes.push_back({name, std::move(field.text), place});
  }

  // Reads one value of a field. Returns whether it is a node.
  bool ReadValue(ConfigurationNode& field)
  {
    const bool is_plain = token_.kind == Token::Kind::kNumber || token_.kind == Token::Kind::kText ||
                          token_.IsName("TRUE") || token_.IsName("FALSE");
    if (is_plain)
    {
      if (!field.text.empty()) field.text += token_.kind == Token::Kind::kText ? '\n' : ' ';
      field.text += token_.text;
      Advance();
      return false;
    }
    if (token_.IsName("NULL"))
    {
      Advance();
      return true;
    }
    if (token_.IsName("IS")) Fail("IS belongs to a PROTO, which cannot be read");
    if (token_.kind != Token::Kind::kName) Fail(fmt::format("{} instead of a value of '{}'", Shown(), field.name));
    field.children.push_back(ReadNode());
    return true;
  }

  std::string_view text_;
  PlaceCounter places_;
  std::size_t at_ = 0;
  Token token_;
  int level_ = 0;
  std::size_t count_ = 0;
  std::map<std::string, std::pair<std::shared_ptr<const ConfigurationNode>, std::size_t>> defined_;
};

}  // namespace

bool IsWebotsFile(std::string_view text) { return text.starts_with(kHeader); }

std::shared_ptr<const ConfigurationNode> ReadWebotsFile(std::string_view text, const std::string& file_name)
{
  return Parser(text, file_name).Read();
}

}  // namespace swarmanoid
