// Reading XML: places of elements and attributes, and refusal of malformed, huge, deep and entity-bombed files.
#include "common/configuration/xml_reader.h"
#include "common/configuration/xml_writer.h"
#include "tests/world/message_of.h"

#include <gtest/gtest.h>

#include <string>

namespace swarmanoid
{
namespace
{

std::string ErrorOf(const std::string& text, const XmlLimits& limits = {})
{
  return test::MessageOf<ConfigurationError>([&] { ReadXml(text, "f.xml", limits); });
}

std::string Repeated(const std::string& text, int count)
{
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

TEST(XmlReader, KnowsThePlaceOfElementsAndAttributes)
{
  const auto root = ReadXml(
      "<?xml version='1.0'?>\n<!-- <no a='1'> -->\n<a>\n  <b one = '>' two=\"2\"\n     three='&lt;'/>x</a>", "f.xml");
  EXPECT_EQ(root->location.Text(), "f.xml:3:1");
  const ConfigurationNode& b = *root->children.at(0);
  EXPECT_EQ(b.location.Text(), "f.xml:4:3");
  EXPECT_EQ(b.attributes.at(0).location.Text(), "f.xml:4:6");
  EXPECT_EQ(b.attributes.at(0).value, ">");
  EXPECT_EQ(b.attributes.at(1).location.Text(), "f.xml:4:16");
  EXPECT_EQ(b.attributes.at(2).location.Text(), "f.xml:5:6");
  EXPECT_EQ(b.attributes.at(2).value, "<");
  EXPECT_EQ(root->text, "x");
}

TEST(XmlReader, CountsCharactersNotBytes)
{
  const auto root = ReadXml("\xef\xbb\xbf<a x='äöü€'><b/></a>", "f.xml");
  EXPECT_EQ(root->location.Text(), "f.xml:1:1");
  EXPECT_EQ(root->children.at(0)->location.Text(), "f.xml:1:13");
}

TEST(XmlReader, JoinsTextAroundCommentsAndSections)
{
  EXPECT_EQ(ReadXml("<a> one<!-- x --> two <![CDATA[<&>]]>\r\n</a>", "f.xml")->text, "one two <&>");
}

TEST(XmlReader, NamesMalformedMarkup)
{
  EXPECT_EQ(ErrorOf(""), "f.xml:1:1: the file holds no element");
  EXPECT_EQ(ErrorOf("<!-- x -->"), "f.xml:1:11: the file holds no element");
  EXPECT_EQ(ErrorOf("x<a/>"), "f.xml:1:1: there is text outside the root element");
  EXPECT_EQ(ErrorOf("<a/>\n<b/>"), "f.xml:2:1: a second root element; a file holds one");
  EXPECT_EQ(ErrorOf("<a>\n<b>\n</a>"),
            "f.xml:3:1: </a> does not match <b>, which starts in line 2 and must be closed first");
  EXPECT_EQ(ErrorOf("<a>\n<b>"), "f.xml:2:4: the file ends within <b>, which starts in line 2; add </b>");
  EXPECT_EQ(ErrorOf("<a></a></a>"), "f.xml:1:8: </a> closes nothing");
  EXPECT_EQ(ErrorOf("<a b=1/>"), "f.xml:1:4: an attribute of <a> must read name=\"value\"");
  EXPECT_EQ(ErrorOf("<a b='1' b='2'/>"), "f.xml:1:10: the attribute 'b' of <a> is given twice");
  EXPECT_EQ(ErrorOf("<a b='1'"), "f.xml:1:1: the tag <a does not end; add '>'");
  EXPECT_EQ(ErrorOf("<a b='<'/>"),
            "f.xml:1:7: a '<' within the value of an attribute; write &lt; or close the quotes before");
  EXPECT_EQ(ErrorOf("<a>1 < 2</a>"), "f.xml:1:6: a '<' that starts no element; write &lt; in text");
  EXPECT_EQ(ErrorOf("<a>R&D</a>"), "f.xml:1:5: a bare '&' is not allowed; write &amp;");
  EXPECT_EQ(ErrorOf("<a><!-- x</a>"), "f.xml:1:4: a comment does not end; add -->");
  EXPECT_EQ(ErrorOf("<a>\xff</a>"), "f.xml:1:4: a byte that is not UTF-8 text; save the file as UTF-8");
  EXPECT_EQ(ErrorOf(std::string("<a>\0</a>", 8)), "f.xml:1:4: a byte that is not UTF-8 text; save the file as UTF-8");
  EXPECT_EQ(ErrorOf("<a>&#0;</a>"), "f.xml:1:4: '&#0;' is no character of XML");
}

TEST(XmlReader, NamesMistakesWithinTags)
{
  constexpr const char* kNames =
      " is no name; names have letters, digits, '_', '-', '.' and ':', and start with a letter or '_'";
  EXPECT_EQ(ErrorOf("<a>\n<b!/></a>"), "f.xml:2:2: 'b!'" + std::string(kNames));
  EXPECT_EQ(ErrorOf("<a b='1' c!='1'/>"), "f.xml:1:10: 'c!'" + std::string(kNames));
  EXPECT_EQ(ErrorOf("<1/>"), "f.xml:1:1: a '<' that starts no element; write &lt; in text");
  EXPECT_EQ(ErrorOf("<a \n 1b='1'/>"), "f.xml:2:2: an attribute of <a> must read name=\"value\"");
  EXPECT_EQ(ErrorOf("<a b='1' c"), "f.xml:1:10: an attribute of <a> must read name=\"value\"");
  EXPECT_EQ(ErrorOf("<a b='1' c='2/></a>"), "f.xml:1:10: an attribute of <a> must read name=\"value\"");
  EXPECT_EQ(ErrorOf("<a b='1'c='2'/>"), "f.xml:1:9: a blank must stand between the attributes of <a>");
  EXPECT_EQ(ErrorOf("<a b='/' / c='2'>"), "f.xml:1:10: a '/' must be followed by '>'");
  EXPECT_EQ(ErrorOf("<a><b x='1' <c/></a>"), "f.xml:1:4: the tag <b does not end; add '>'");
  EXPECT_EQ(ErrorOf("<a></a b>"), "f.xml:1:4: an end tag must read </name>");
  EXPECT_EQ(ErrorOf("<a></a"), "f.xml:1:4: an end tag must read </name>");
  EXPECT_EQ(ErrorOf("</a>"), "f.xml:1:1: </a> closes nothing");
}

TEST(XmlReader, NamesReferencesThatAreNone)
{
  EXPECT_EQ(ErrorOf("<a b='1' c='&amp;&#65;&lol;'/>"),
            "f.xml:1:23: unknown entity '&lol;'; allowed: &lt; &gt; &amp; &quot; &apos; &#n;");
  EXPECT_EQ(ErrorOf("<a b='&lt;R&D'/>"), "f.xml:1:12: a bare '&' is not allowed; write &amp;");
  EXPECT_EQ(ErrorOf("<a>&"), "f.xml:1:4: a bare '&' is not allowed; write &amp;");
  EXPECT_EQ(ErrorOf("<a b='&#xd800;'/>"), "f.xml:1:7: '&#xd800;' is no character of XML");
  EXPECT_EQ(ErrorOf("<a>&#x110000;</a>"), "f.xml:1:4: '&#x110000;' is no character of XML");
  EXPECT_EQ(ErrorOf("<a>&#x;</a>"), "f.xml:1:4: '&#x;' is no character of XML");
}

TEST(XmlReader, RefusesWhatOtherParsersRefuse)
{
  EXPECT_EQ(ErrorOf("<!-- new -- old -->\n<a/>"),
            "f.xml:1:10: '--' is not allowed within a comment; write one '-', or '- -'");
  EXPECT_EQ(ErrorOf("<a><!-- <b c='1'> ---></a>"),
            "f.xml:1:19: '--' is not allowed within a comment; write one '-', or '- -'");
  EXPECT_EQ(ErrorOf("<a>1 ]]> 0</a>"), "f.xml:1:6: ']]>' is not allowed in text; write ]]&gt;");
  EXPECT_EQ(ErrorOf("<a><? b?></a>"), "f.xml:1:4: a processing instruction must read <?name …?>");
  EXPECT_EQ(ErrorOf("<a><?b </a>"), "f.xml:1:4: a processing instruction does not end; add ?>");
  EXPECT_EQ(ErrorOf("<a>\n<![CDATA[ <b/></a>"), "f.xml:2:1: a CDATA section does not end; add ]]>");
  EXPECT_EQ(ErrorOf("<![CDATA[x]]><a/>"), "f.xml:1:1: there is text outside the root element");
  EXPECT_EQ(ErrorOf("\n<?xml version='1.0'?><a/>"),
            "f.xml:2:1: an XML declaration (<?xml …?>) must be the first of the file; remove what is before it");
  EXPECT_EQ(ErrorOf("<?xml version='2.0'?><a/>"),
            "f.xml:1:1: an XML declaration must read <?xml version=\"1.0\" encoding=\"UTF-8\"?>");
  EXPECT_EQ(ErrorOf("<?xml?><a/>"),
            "f.xml:1:1: an XML declaration must read <?xml version=\"1.0\" encoding=\"UTF-8\"?>");
}

TEST(XmlReader, ReadsUtf8Alone)
{
  const std::string not_utf8 = "a byte that is not UTF-8 text; save the file as UTF-8";
  // '/' in two bytes and in three, half of a pair of UTF-16, beyond Unicode, cut off, a byte that continues nothing.
  for (const std::string bytes : {"\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82", "\x80"})
  {
    EXPECT_EQ(ErrorOf("<a>ä" + bytes + "</a>"), "f.xml:1:5: " + not_utf8);
    EXPECT_EQ(ErrorOf("<a>\n<b c='" + bytes + "'/></a>"), "f.xml:2:7: " + not_utf8);
    EXPECT_EQ(ErrorOf("<a><!--" + bytes + "--></a>"), "f.xml:1:8: " + not_utf8);
    EXPECT_EQ(ErrorOf("<a><![CDATA[" + bytes + "]]></a>"), "f.xml:1:13: " + not_utf8);
  }
  EXPECT_EQ(ErrorOf("<a>ä\xe2"), "f.xml:1:5: " + not_utf8);
  for (const char control : {'\1', '\b', '\x1f'})
    EXPECT_EQ(ErrorOf(std::string("<a>") + control + "</a>"), "f.xml:1:4: " + not_utf8);
  EXPECT_EQ(ErrorOf("<a>\xef\xbf\xbf</a>"), "f.xml:1:4: a character that XML does not allow; remove it");
  EXPECT_EQ(ReadXml("<a>\t\x7f\xf0\x9f\xa4\x96</a>", "f.xml")->text, "\x7f\xf0\x9f\xa4\x96");

  EXPECT_EQ(ErrorOf("\xff\xfe<\0a\0/\0>\0"), "f.xml:1:1: " + not_utf8);
  EXPECT_EQ(ErrorOf(std::string("<\0a\0/\0>\0", 8)), "f.xml:1:2: " + not_utf8);
  EXPECT_EQ(ErrorOf(std::string("\0<\0a\0/\0>", 8)), "f.xml:1:1: " + not_utf8);
}

TEST(XmlReader, HeedsTheEncodingThatTheFileNames)
{
  EXPECT_EQ(ErrorOf("<?xml version='1.0' encoding='ISO-8859-1'?><a>ä</a>"),
            "f.xml:1:1: the encoding 'ISO-8859-1' is not read; save the file as UTF-8, and write encoding=\"UTF-8\"");
  EXPECT_EQ(ErrorOf("<?xml version='1.0' encoding='utf-8'?><a>ä</a>"), "");
  EXPECT_EQ(ErrorOf("<?xml version='1.0' encoding='ISO-8859-1'?><a>a</a>"), "");
}

TEST(XmlReader, RefusesDocumentTypesAndEntities)
{
  const std::string bomb =
      "<?xml version='1.0'?>\n<!DOCTYPE lolz [<!ENTITY lol 'lol'><!ENTITY lol2 "
      "'&lol;&lol;&lol;'>]>\n<lolz>&lol2;</lolz>";
  EXPECT_EQ(ErrorOf(bomb),
            "f.xml:2:1: a document type (<!DOCTYPE …>) and entities of its own are not allowed; remove it");
  EXPECT_EQ(ErrorOf("<!DOCTYPE a SYSTEM 'a.dtd'><a/>"),
            "f.xml:1:1: a document type (<!DOCTYPE …>) and entities of its own are not allowed; remove it");
  EXPECT_EQ(ErrorOf("<a>\n<!ENTITY b 'c'></a>"),
            "f.xml:2:1: a document type (<!DOCTYPE …>) and entities of its own are not allowed; remove it");
  EXPECT_EQ(ErrorOf("<a>&lol;</a>"), "f.xml:1:4: unknown entity '&lol;'; allowed: &lt; &gt; &amp; &quot; &apos; &#n;");
}

TEST(XmlReader, RefusesWhatIsTooMuch)
{
  XmlLimits limits;
  limits.bytes = 100;
  EXPECT_EQ(ErrorOf(std::string(101, ' '), limits), "f.xml: the file has 101 bytes; at most 100 are read");
  limits = {};
  EXPECT_EQ(ErrorOf(Repeated("<a>", 100'000)), "f.xml:1:193: elements are nested deeper than 64 levels");
  EXPECT_EQ(ErrorOf(Repeated("<a>", 64) + Repeated("</a>", 64)), "");
  limits.elements = 10;
  EXPECT_EQ(ErrorOf("<r>" + Repeated("<a/>", 20) + "</r>", limits),
            "f.xml:1:40: more than 10 elements; use <distribute> for many entities");
  std::string attributes;
  for (int i = 0; i < 65; ++i) attributes += " a" + std::to_string(i) + "='1'";
  EXPECT_NE(ErrorOf("<r" + attributes + "/>").find("too many attributes: at most 64 in one element"),
            std::string::npos);
}

TEST(XmlReader, WrittenTextReadsAsTheSameTree)
{
  const std::string text =
      "<a x='1&#10;2 &quot;&amp;&lt;'>  some \n text &amp; &lt;b&gt; <c><d/></c><c y=\"'\">é</c></a>";
  const std::string once = WriteXml(*ReadXml(text, "f.xml"));
  const auto again = ReadXml(once, "g.xml");
  EXPECT_EQ(WriteXml(*again), once);
  EXPECT_EQ(again->attributes.at(0).value, "1\n2 \"&<");
  EXPECT_EQ(again->text, "some \n text & <b>");
  EXPECT_EQ(again->children.at(1)->text, "é");
}

}  // namespace
}  // namespace swarmanoid
