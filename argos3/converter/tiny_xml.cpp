// TinyXML (tinyxmlparser.cpp of ARGoS3) has fewer rules than XML 1.0. A text is a sequence of nodes, and the first
// characters of a node decide what it is: a declaration, a comment, character data, an element, or something unknown
// that ends at the next '>'. This reader follows the same order of decisions, so it reads what TinyXML reads. What
// TinyXML refuses ends it.
#include "argos3/converter/tiny_xml.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <utility>

#include "common/configuration/place_counter.h"
#include "common/configuration/utf8.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"

namespace swarmanoid::argos3
{
namespace
{

// TinyXML refuses the text.
struct Refused
{
};

bool IsSpace(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool StartsName(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || (c & 0x80) != 0; }
bool ContinuesName(char c) { return StartsName(c) || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == ':'; }

void AppendUtf8(std::string& text, unsigned long code)
{
  const auto add = [&](unsigned long byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return add(code);
  const int further = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  add((further == 1 ? 0xc0U : further == 2 ? 0xe0U : 0xf0U) | code >> (6U * static_cast<unsigned>(further)));
  for (int k = further - 1; k >= 0; --k) add(0x80U | (code >> (6U * static_cast<unsigned>(k)) & 0x3fU));
}

class TinyXmlReader
{
public:
  TinyXmlReader(std::string_view text, const std::string& file_name, std::vector<Diagnostic>& notes)
      : text_(text), places_(text, std::make_shared<const std::string>(file_name)), notes_(notes)
  {
  }

  std::shared_ptr<const ConfigurationNode> Read()
  {
    std::shared_ptr<const ConfigurationNode> root;
    for (SkipSpace(); At("<"); SkipSpace())
      if (auto element = ReadNode(nullptr); root == nullptr) root = std::move(element);
    if (root == nullptr) throw Refused();
    return root;
  }

private:
  bool At(std::string_view start) const { return text_.substr(at_).starts_with(start); }
  bool AtEnd() const { return at_ >= text_.size(); }
  char Here() const
  {
    if (AtEnd()) throw Refused();
    return text_[at_];
  }
  void SkipSpace()
  {
    while (!AtEnd() && IsSpace(text_[at_])) ++at_;
  }
  // Returns the text up to `end`, and goes on behind it.
  std::string_view Until(std::string_view end)
  {
    const std::size_t found = text_.find(end, at_);
    if (found == std::string_view::npos) throw Refused();
    const std::string_view before = text_.substr(at_, found - at_);
    at_ = found + end.size();
    return before;
  }
  void Note(std::size_t offset, const std::string& what)
  {
    notes_.push_back({places_.At(offset), what + "; ARGoS3 reads it, and so does this program"});
  }

  // Reads the node at a '<'. Returns an element; nullptr for any other node. `parent` gets character data.
  std::shared_ptr<const ConfigurationNode> ReadNode(ConfigurationNode* parent)
  {
    const std::size_t start = at_;
    if (At("<?xml"))
    {
      Until(">");
      if (start != 0) Note(start, "the XML declaration is not at the start of the file");
    }
    else if (At("<!--"))
    {
      at_ += 4;
      const std::string_view comment = Until("-->");
      if (comment.find("--") != std::string_view::npos || comment.ends_with('-'))
        Note(start, "the comment contains '--', which ends comments of XML");
    }
    else if (At("<![CDATA["))
    {
      at_ += 9;
      const std::string_view data = Until("]]>");
      if (parent != nullptr) parent->text += Decoded(data, false);
    }
    else if (at_ + 1 < text_.size() && StartsName(text_[at_ + 1]))
      return ReadElement();
    else
    {
      const bool is_instruction = At("<?");
      Until(">");
      if (!is_instruction) Note(start, "what starts with '<!' here ends at the next '>'");
    }
    return nullptr;
  }

  std::shared_ptr<const ConfigurationNode> ReadElement()
  {
    const XmlLimits limits;
    if (++depth_ > limits.depth || ++elements_ > limits.elements) throw Refused();
    auto node = std::make_shared<ConfigurationNode>();
    node->location = places_.At(at_++);
    node->name = ReadName();
    bool is_separate = false;
    for (;; is_separate = false)
    {
      while (IsSpace(Here()))
      {
        ++at_;
        is_separate = true;
      }
      if (At("/>"))
      {
        at_ += 2;
        --depth_;
        return node;
      }
      if (Here() == '>') break;
      ReadAttribute(*node, is_separate);
    }
    ++at_;
    for (SkipSpace(); !At("</"); SkipSpace())
    {
      if (Here() == '<')
      {
        if (auto child = ReadNode(node.get())) node->children.push_back(std::move(child));
        continue;
      }
      const std::size_t end = std::min(text_.find('<', at_), text_.size());
      node->text += Decoded(text_.substr(at_, end - at_), true);
      at_ = end;
    }
    node->text = std::string(TrimBlanks(node->text));
    const std::string end = "</" + node->name + ">";
    if (!At(end)) throw Refused();
    at_ += end.size();
    --depth_;
    return node;
  }

  std::string ReadName()
  {
    const std::size_t start = at_;
    if (!StartsName(Here())) throw Refused();
    while (!AtEnd() && ContinuesName(text_[at_])) ++at_;
    return Decoded(text_.substr(start, at_ - start), false);
  }

  void ReadAttribute(ConfigurationNode& node, bool is_separate)
  {
    const std::size_t start = at_;
    ConfigurationNode::Attribute attribute{ReadName(), "", places_.At(start)};
    const std::string shown = Quoted(attribute.name) + " of <" + node.name + ">";
    SkipSpace();
    if (Here() != '=') throw Refused();
    ++at_;
    SkipSpace();
    const char quote = Here();
    if (quote == '"' || quote == '\'')
    {
      ++at_;
      attribute.value = Decoded(Until(std::string_view(&quote, 1)), true);
    }
    else
    {
      const std::size_t value = at_;
      while (!IsSpace(Here()) && Here() != '/' && Here() != '>')
        if (text_[at_] == '"' || text_[at_] == '\'')
          throw Refused();
        else
          ++at_;
      attribute.value = Decoded(text_.substr(value, at_ - value), false);
      Note(start, "the value of " + shown + " has no quotes");
    }
    if (!is_separate) Note(start, "there is no blank before " + shown);
    if (static_cast<int>(node.attributes.size()) >= XmlLimits{}.attributes_of_one) throw Refused();
    for (const ConfigurationNode::Attribute& other : node.attributes)
      if (other.name == attribute.name) throw Refused();
    node.attributes.push_back(std::move(attribute));
  }

  // Returns the text as UTF-8, with the characters of entities if they are read. Bytes that are no UTF-8 are Latin-1.
  std::string Decoded(std::string_view raw, bool reads_entities)
  {
    std::string decoded;
    while (!raw.empty())
    {
      const auto byte = static_cast<unsigned char>(raw.front());
      if (byte < 0x20 && !IsSpace(raw.front())) throw Refused();
      if (reads_entities && byte == '&')
      {
        raw.remove_prefix(ReadEntity(raw, decoded));
        continue;
      }
      const std::size_t length = Utf8Length(raw);
      if (length == 0)
      {
        Note(Offset(raw), "a byte is not UTF-8 text");
        AppendUtf8(decoded, byte);
      }
      else if (IsSpace(raw.front()))
        decoded += ' ';
      else
        decoded += raw.substr(0, length);
      raw.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return decoded;
  }

  std::size_t Offset(std::string_view part) const { return static_cast<std::size_t>(part.data() - text_.data()); }

  // Appends the character of the entity at the front, and returns its length. TinyXML leaves out the '&' of others.
  std::size_t ReadEntity(std::string_view raw, std::string& decoded)
  {
    constexpr std::array<std::pair<std::string_view, char>, 5> kEntities{
        {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};
    for (const auto& [name, character] : kEntities)
      if (raw.starts_with(name))
      {
        decoded += character;
        return name.size();
      }
    if (raw.starts_with("&#"))
    {
      const std::size_t end = raw.find(';');
      const bool is_hexadecimal = raw.size() > 2 && raw[2] == 'x';
      if (end == std::string_view::npos) throw Refused();
      const std::string digits(raw.substr(is_hexadecimal ? 3 : 2, end - (is_hexadecimal ? 3 : 2)));
      char* rest = nullptr;
      const unsigned long code = std::strtoul(digits.c_str(), &rest, is_hexadecimal ? 16 : 10);
      const bool is_character = (code >= 0x20 && code < 0xd800) || (code >= 0xe000 && code < 0x110000) ||
                                code == '\t' || code == '\n' || code == '\r';
      if (digits.empty() || *rest != '\0' || !is_character) throw Refused();
      AppendUtf8(decoded, code);
      return end + 1;
    }
    Note(Offset(raw), "the '&' starts no character, and is left out");
    return 1;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::size_t elements_ = 0;
  PlaceCounter places_;
  std::vector<Diagnostic>& notes_;
};

}  // namespace

std::shared_ptr<const ConfigurationNode> ReadTinyXml(std::string_view text, const std::string& file_name,
                                                     std::vector<Diagnostic>& notes)
{
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  std::vector<Diagnostic> found;
  try
  {
    auto root = TinyXmlReader(text, file_name, found).Read();
    notes.insert(notes.end(), found.begin(), found.end());
    return root;
  }
  catch (const Refused&)
  {
    return nullptr;
  }
}

}  // namespace swarmanoid::argos3
