#include "common/configuration/xml_outline.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>

#include "common/configuration/expat_position.h"
#include "common/configuration/xml_mistake.h"
#include "common/configuration/xml_reader.h"

namespace swarmanoid
{
namespace
{

// The text has passed ReadXml, so the reader meets no mistakes.
class OutlineReader
{
public:
  explicit OutlineReader(std::string_view text)
      : text_(text),
        mark_(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0),
        parser_(XML_ParserCreate("UTF-8"), XML_ParserFree)
  {
    if (!parser_) throw std::bad_alloc();
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), Handler<&OutlineReader::Start, const XML_Char*, const XML_Char**>,
                          Handler<&OutlineReader::End, const XML_Char*>);
    XML_SetCommentHandler(parser_.get(), Handler<&OutlineReader::Comment, const XML_Char*>);
    XML_SetProcessingInstructionHandler(parser_.get(),
                                        Handler<&OutlineReader::Instruction, const XML_Char*, const XML_Char*>);
  }

  XmlElement Read()
  {
    const std::string_view text = text_.substr(mark_);
    const XML_Status status = XML_Parse(parser_.get(), text.data(), static_cast<int>(text.size()), 1);
    if (failure_) std::rethrow_exception(failure_);
    if (status != XML_STATUS_OK) throw std::logic_error("the text was read, and has no outline");
    return std::move(root_);
  }

private:
  // Expat is a C library: no exception may pass through it.
  template <auto Method, class... Arguments>
  static void Handler(void* user, Arguments... arguments)
  {
    auto* const self = static_cast<OutlineReader*>(user);
    if (self->failure_) return;
    try
    {
      const auto begin = static_cast<std::size_t>(CurrentByteIndex(self->parser_.get())) + self->mark_;
      const auto count = static_cast<std::size_t>(CurrentByteCount(self->parser_.get()));
      (self->*Method)(TextSpan{begin, begin + count}, arguments...);
    }
    catch (...)
    {
      self->failure_ = std::current_exception();
      XML_StopParser(self->parser_.get(), XML_FALSE);
    }
  }

  void Start(TextSpan place, const XML_Char* name, const XML_Char** attributes)
  {
    XmlElement element;
    element.name = name;
    element.whole = element.start = place;
    element.content = {place.end, place.end};
    if (*attributes != nullptr)
      for (const std::size_t offset : AttributeOffsets(text_, place.begin))
      {
        const std::size_t open = text_.find_first_of("\"'", offset);
        const std::size_t close = text_.find(text_[open], open + 1);
        element.attributes.push_back({*attributes, {offset, close + 1}, {open + 1, close}});
        attributes += 2;
      }
    open_.push_back(std::move(element));
  }

  // For <name/>, expat reports an end without a length.
  void End(TextSpan place, const XML_Char*)
  {
    XmlElement element = std::move(open_.back());
    open_.pop_back();
    if (place.end > place.begin)
    {
      element.content.end = place.begin;
      element.whole.end = place.end;
    }
    if (open_.empty())
      root_ = std::move(element);
    else
      open_.back().children.push_back(std::move(element));
  }

  void Comment(TextSpan place, const XML_Char*) { Note(place); }
  void Instruction(TextSpan place, const XML_Char*, const XML_Char*) { Note(place); }
  void Note(TextSpan place)
  {
    if (!open_.empty()) open_.back().notes.push_back(place);
  }

  std::string_view text_;
  std::size_t mark_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  std::vector<XmlElement> open_;
  XmlElement root_;
  std::exception_ptr failure_;
};

}  // namespace

const XmlElement::Attribute* XmlElement::FindAttribute(std::string_view wanted) const
{
  const auto found = std::ranges::find(attributes, wanted, &Attribute::name);
  return found == attributes.end() ? nullptr : &*found;
}

const XmlElement* XmlElement::FindChild(std::string_view wanted) const
{
  const auto found = std::ranges::find(children, wanted, &XmlElement::name);
  return found == children.end() ? nullptr : &*found;
}

XmlElement OutlineOf(std::string_view text, const std::string& file_name)
{
  ReadXml(text, file_name);
  return OutlineReader(text).Read();
}

const XmlElement* ElementAt(const XmlElement& root, std::span<const std::size_t> path)
{
  const XmlElement* element = &root;
  for (const std::size_t child : path)
  {
    if (child >= element->children.size()) return nullptr;
    element = &element->children[child];
  }
  return element;
}

}  // namespace swarmanoid
