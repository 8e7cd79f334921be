#include "common/configuration/xml_reader.h"

#include <fmt/format.h>
#include <strings.h>

#include <algorithm>
#include <climits>
#include <exception>
#include <new>
#include <vector>

#include "common/configuration/expat_position.h"
#include "common/configuration/place_counter.h"
#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_mistake.h"

namespace swarmanoid
{
namespace
{

// Builds the tree from the events of expat.
class TreeReader
{
public:
  TreeReader(std::string_view text, const std::shared_ptr<const std::string>& file, const XmlLimits& limits)
      : text_(text), places_(text, file), limits_(limits), parser_(XML_ParserCreate("UTF-8"), XML_ParserFree)
  {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetXmlDeclHandler(parser_.get(), Handler<&TreeReader::Declaration, const XML_Char*, const XML_Char*, int>);
    XML_SetElementHandler(parser_.get(), Handler<&TreeReader::Start, const XML_Char*, const XML_Char**>,
                          Handler<&TreeReader::End, const XML_Char*>);
    XML_SetCharacterDataHandler(parser_.get(), Handler<&TreeReader::Characters, const XML_Char*, int>);
    XML_SetDefaultHandler(parser_.get(), Handler<&TreeReader::Other, const XML_Char*, int>);
  }

  std::shared_ptr<const ConfigurationNode> Read()
  {
    // Expat would read a text with this start as UTF-16, whatever encoding it is told.
    constexpr std::string_view kUtf16("\0\xfe\xff", 3);
    const std::size_t wide = text_.substr(0, 2).find_first_of(kUtf16);
    if (wide != std::string_view::npos) Fail(wide, "a byte that is not UTF-8 text; save the file as UTF-8");

    const XML_Status status = XML_Parse(parser_.get(), text_.data(), static_cast<int>(text_.size()), 1);
    if (failure_) std::rethrow_exception(failure_);
    if (status != XML_STATUS_OK) Refuse(XML_GetErrorCode(parser_.get()));
    return root_;
  }

private:
  // Expat is a C library: no exception may pass through it. After the first exception the parser continues to the end
  // of a tag.
  template <auto Method, class... Arguments>
  static void Handler(void* user, Arguments... arguments)
  {
    auto* const self = static_cast<TreeReader*>(user);
    if (self->failure_) return;
    try
    {
      const auto offset = static_cast<std::size_t>(CurrentByteIndex(self->parser_.get()));
      (self->*Method)(offset, arguments...);
      self->markup_ = offset + static_cast<std::size_t>(CurrentByteCount(self->parser_.get()));
    }
    catch (...)
    {
      self->failure_ = std::current_exception();
      XML_StopParser(self->parser_.get(), XML_FALSE);
    }
  }

  [[noreturn]] void Fail(std::size_t offset, const std::string& message)
  {
    throw ConfigurationError(places_.At(offset), message);
  }

  [[noreturn]] void Refuse(XML_Error error)
  {
    if (error == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
    const auto offset = static_cast<std::size_t>(std::max<long long>(CurrentByteIndex(parser_.get()), 0));
    const auto line = [this](std::size_t at) { return places_.At(at).line; };
    const XmlMistake mistake = ExplainRefusal(text_, {error, offset, markup_, section_, tags_, line});
    Fail(mistake.offset, mistake.message);
  }

  void Declaration(std::size_t offset, const XML_Char* version, const XML_Char* encoding, int /*standalone*/)
  {
    const std::string_view number(version);
    if (!number.starts_with("1.") || number.size() == 2 || number.find_first_not_of("0123456789", 2) != number.npos)
      Refuse(XML_ERROR_XML_DECL);
    const bool is_ascii = std::none_of(text_.begin(), text_.end(), [](char c) { return (c & 0x80) != 0; });
    if (encoding == nullptr || strcasecmp(encoding, "UTF-8") == 0 || is_ascii) return;
    Fail(offset, fmt::format("the encoding {} is not read; save the file as UTF-8, and write encoding=\"UTF-8\"",
                             Quoted(encoding)));
  }

  void Start(std::size_t offset, const XML_Char* name, const XML_Char** attributes)
  {
    if (static_cast<int>(open_.size()) >= limits_.depth)
      Fail(offset, fmt::format("elements are nested deeper than {} levels", limits_.depth));
    if (++elements_ > limits_.elements)
      Fail(offset, fmt::format("more than {} elements; use <distribute> for many entities", limits_.elements));
    auto node = std::make_shared<ConfigurationNode>();
    node->name = name;
    node->location = places_.At(offset);
    if (*attributes != nullptr) AddAttributes(*node, offset, attributes);
    tags_.push_back(offset);
    open_.push_back(std::move(node));
  }

  void AddAttributes(ConfigurationNode& node, std::size_t tag, const XML_Char** attributes)
  {
    for (const std::size_t offset : AttributeOffsets(text_, tag))
    {
      if (++attributes_ > limits_.attributes || static_cast<int>(node.attributes.size()) >= limits_.attributes_of_one)
      {
        Fail(offset, fmt::format("too many attributes: at most {} in one element and {} in all",
                                 limits_.attributes_of_one, limits_.attributes));
      }
      node.attributes.push_back({attributes[0], attributes[1], places_.At(offset)});
      attributes += 2;
    }
  }

  void End(std::size_t /*offset*/, const XML_Char* /*name*/)
  {
    std::shared_ptr<ConfigurationNode> node = std::move(open_.back());
    open_.pop_back();
    tags_.pop_back();
    node->text = std::string(TrimBlanks(node->text));
    if (open_.empty())
      root_ = std::move(node);
    else
      open_.back()->children.push_back(std::move(node));
  }

  void Characters(std::size_t /*offset*/, const XML_Char* text, int count)
  {
    open_.back()->text.append(text, static_cast<std::size_t>(count));
  }

  // Handles comments, processing instructions and the borders of CDATA sections. It also gets the first word of a
  // document type, which could declare entities.
  void Other(std::size_t offset, const XML_Char* text, int count)
  {
    const std::string_view markup(text, static_cast<std::size_t>(count));
    if (markup == "<![CDATA[") section_ = offset;
    if (markup == "<!DOCTYPE") Refuse(XML_ERROR_SYNTAX);
  }

  std::string_view text_;
  PlaceCounter places_;
  const XmlLimits& limits_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  std::vector<std::size_t> tags_;  // the offsets of the open elements
  std::vector<std::shared_ptr<ConfigurationNode>> open_;
  std::shared_ptr<const ConfigurationNode> root_;
  std::size_t markup_ = 0;   // the begin of the markup or text that is not reported yet
  std::size_t section_ = 0;  // the begin of the last CDATA section
  std::size_t elements_ = 0;
  std::size_t attributes_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

std::shared_ptr<const ConfigurationNode> ReadXml(std::string_view text, const std::string& file_name,
                                                 const XmlLimits& limits)
{
  const auto file = std::make_shared<const std::string>(file_name);
  const std::size_t most_bytes = std::min<std::size_t>(limits.bytes, INT_MAX);
  if (text.size() > most_bytes)
  {
    throw ConfigurationError({file, 0, 0},
                             fmt::format("the file has {} bytes; at most {} are read", text.size(), most_bytes));
  }
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return TreeReader(text, file, limits).Read();
}

std::string ReadTextFile(const std::string& path, std::size_t most_bytes)
{
  try
  {
    return ReadRegularFile(path, most_bytes);
  }
  catch (const FileError& error)
  {
    throw ConfigurationError({std::make_shared<const std::string>(path), 0, 0},
                             std::string("the file cannot be read: ") + error.what());
  }
}

}  // namespace swarmanoid
