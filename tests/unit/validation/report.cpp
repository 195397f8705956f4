#include "validation/report/Report.h"

#include <cctype>
#include <regex>

#include <gmock/gmock.h>

#include "tests/unit/validation/Benches.h"
#include "tests/unit/validation/Samples.h"
#include "validation/bench/BenchHtml.h"
#include "validation/bench/BenchTables.h"
#include "validation/pictures/HeatMap.h"
#include "validation/report/FigureHtml.h"
#include "validation/report/Html.h"

namespace tessera::validation {
namespace {

using testing::HasSubstr;
using testing::Not;

DisplayImage plainImage(std::uint8_t value) {
    return {4, 2, std::vector<std::uint8_t>(24, value)};
}

Report sampleReport() {
    const Picture b = greyPicture(4, 2, 1.f);
    Picture a = b;
    setPixel(a, 2, {1.5f, 1.f, 1.f});
    Report report;
    report.title = "hall & <friends>";
    report.record = {"hall", 4, 2, "llvmpipe \"quoted\"", {}};
    report.record.pairs.push_back(
        comparePair("deferred", b, "forward", b, {.bitEqual = 1.0, .reason = "same < maths"}));
    report.record.pairs.push_back(comparePair("packed", a, "forward", b, {.maxRel = 1e-5}));
    report.choice = "Take deferred: it costs a third of forward here.";
    report.facts = {{"Triangles", "212,480"}};
    report.pictures = {{"forward", "the truth", encodePng(plainImage(10))}, {"packed", "", encodePng(plainImage(12))}};
    report.heatMaps.push_back({"packed", "forward", encodePng(errorHeatMap(a, b, "packed"))});
    report.plans = {{"deferred", "gbuffer -> deferred_lighting\n  left out: <shadows>"}};
    report.commands = {"./run compare hall --json 'x&y.json'"};
    return report;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

/// Returns a fault in the nesting of tags or the quoting of attributes, or an empty string. Covers the HTML of
/// reportHtml(): every element is closed, elements without content close themselves, style and script hold raw text.
std::string faultOf(const std::string& html) {
    std::vector<std::string> open;
    std::size_t at = html.find("<html");
    while ((at = html.find('<', at)) != std::string::npos) {
        std::size_t end = at + 1;
        for (char quote = 0; end < html.size() && (quote || html[end] != '>'); ++end) {
            if (html[end] == '<') return "< inside a tag: " + html.substr(at, 80);
            if (html[end] == '"') quote = quote ? 0 : '"';
        }
        const std::string tag = html.substr(at + 1, end - at - 1);
        const bool isEnd = tag[0] == '/';
        std::string name;
        for (std::size_t i = isEnd; i < tag.size() && std::isalnum(static_cast<unsigned char>(tag[i])); ++i)
            name += tag[i];
        if (isEnd) {
            if (open.empty() || open.back() != name) return "unexpected </" + name + ">";
            open.pop_back();
        } else if (tag.back() != '/') {
            if (!std::regex_match(tag, std::regex("[a-z][a-z0-9]*( [a-z-]+=\"[^\"]*\")*")))
                return "attributes of <" + tag + ">";
            open.push_back(name);
            if (name == "style" || name == "script") end = html.find("</" + name, end) - 1;
        }
        at = end + 1;
    }
    return open.empty() ? "" : "<" + open.back() + "> is never closed";
}

TEST(Report, theCheckerOfThisTestFindsBrokenNesting) {
    EXPECT_EQ(faultOf("<html><p>x</p></html>"), "");
    EXPECT_NE(faultOf("<html><p>x</html>"), "");
    EXPECT_NE(faultOf("<html><p a=x>x</p></html>"), "");
    EXPECT_NE(faultOf("<html><p>a < b</p></html>"), "");
}

TEST(Report, theHtmlIsWellFormedAndFullyEscaped) {
    const std::string html = reportHtml(sampleReport());
    EXPECT_EQ(faultOf(html), "");
    EXPECT_THAT(html, HasSubstr("<h1>hall &amp; &lt;friends&gt;</h1>"));
    EXPECT_THAT(html, HasSubstr("llvmpipe &quot;quoted&quot;"));
    EXPECT_THAT(html, HasSubstr("same &lt; maths"));
    EXPECT_THAT(html, HasSubstr("left out: &lt;shadows&gt;"));
    EXPECT_THAT(html, HasSubstr("./run compare hall <span class=\"whole\">--json</span> &#39;x&amp;y.json&#39;"));
}

TEST(Report, aBenchmarksPageIsWellFormedAndFullyEscaped) {
    BenchRecord record;
    record.groups = {madeUpGroup(100, {madeUpResult("forward", 40.0, 1e-9), madeUpResult("deferred", 10.0, 1e-9),
                                       madeUpResult("deferred", 8.0, 1e-6, "packed")}),
                     madeUpGroup(400, {madeUpResult("forward", 160.0, {})})};
    record.groups[0].scene = record.groups[1].scene = "</script><b>.json";
    record.groups[0].pictures = {{"reference", {}, "a.png", "", 0}, {"<x>", {"<x>", "y"}, "b.png", "c.png", 1}};
    record.skipped = {{"forward, packed", "no <G-buffer>"}};
    Report report = sampleReport();
    std::vector<std::string> requested;
    report.bench = benchHtml(record, record.groups[0], [&requested](const std::string& file) {
        requested.push_back(file);
        return std::vector<std::uint8_t>{1, 2, 3};
    });
    EXPECT_THAT(requested, testing::ElementsAre("a.png", "b.png", "c.png"));
    const std::string html = reportHtml(report);
    EXPECT_EQ(faultOf(html), "");
    EXPECT_THAT(html, HasSubstr("Error against run time"));
    EXPECT_THAT(html, HasSubstr("5.0&times;<small>faster than forward"));
    EXPECT_THAT(html, HasSubstr("no &lt;G-buffer&gt;"));
    EXPECT_THAT(html, Not(HasSubstr("</script><b>")));
    report.record.pairs.clear();
    report.bench = benchHtml(record, record.groups[1], {});
    EXPECT_EQ(faultOf(reportHtml(report)), "");
}

TEST(Report, theFirstPictureStandsAboveTheFirstSection) {
    const std::string html = reportHtml(sampleReport());
    EXPECT_LT(html.find("id=\"picture-0\""), html.find("<section"));
    EXPECT_GT(html.find("id=\"picture-1\""), html.find("<section"));
}

TEST(Html, wordsWithAHyphenAreNeverBroken) {
    EXPECT_EQ(escapedWhole("relMSE 3.1e-11, a&b"), "relMSE <span class=\"whole\">3.1e-11,</span> a&amp;b");
    EXPECT_EQ(escapedWhole(" x --against \n"), " x <span class=\"whole\">--against</span> \n");
    EXPECT_EQ(escapedWhole(""), "");
    const std::string path = "a-path/that/fills/more/than/a/line";
    EXPECT_EQ(escapedWhole(path), path) << "it would make a narrow page wider than its window";
}

TEST(Html, countsHaveTheirThousandsApart) {
    EXPECT_EQ(countText(0), "0");
    EXPECT_EQ(countText(999), "999");
    EXPECT_EQ(countText(1000), "1,000");
    EXPECT_EQ(countText(389128), "389,128");
    EXPECT_EQ(countText(1234567), "1,234,567");
}

TEST(Report, thePageNeverReachesOutsideItself) {
    const std::string html = reportHtml(sampleReport());
    EXPECT_THAT(html, Not(HasSubstr("http:")));
    EXPECT_THAT(html, Not(HasSubstr("https:")));
    EXPECT_THAT(html, Not(HasSubstr("@import")));
    EXPECT_THAT(html, Not(HasSubstr("url(")));
    const std::regex reference("(src|href)=\"([^\"]{0,12})");
    for (auto found = std::sregex_iterator(html.begin(), html.end(), reference); found != std::sregex_iterator();
         ++found)
        EXPECT_TRUE((*found)[2].str().starts_with("data:") || (*found)[2].str().starts_with("#")) << found->str();
}

TEST(Report, theChoiceOfAFilterIsExplainedAndNeverAmongTheErrors) {
    BenchGroup group = madeUpGroup(10, {madeUpResult("forward", 2.0, 1e-9)});
    const std::string without = attributionHtml(group);
    group.attribution.push_back({kFilterCause, "smaller levels", "level 0 alone", 0.73, 4.0, 0.1});
    const std::string with = attributionHtml(group);
    EXPECT_EQ(with.substr(0, without.size()), without) << "the table of the errors stays";
    EXPECT_THAT(without, testing::HasSubstr("packed: albedo"));
    EXPECT_THAT(with.substr(without.size()), testing::HasSubstr("Not an error: timed frames use mipmaps"));
    EXPECT_THAT(with.substr(without.size()), testing::HasSubstr(figureHtml(0.73)));
}

TEST(Report, theErrorOfARangeToleranceIsOnThePage) {
    Report report = sampleReport();
    EXPECT_THAT(reportHtml(report), Not(HasSubstr("range tolerance")));
    const Picture whole = greyPicture(4, 2, 2.f);
    report.record.rangeTruncation = {0.25, "<forward>", errorFigures(greyPicture(4, 2, 1.f), whole)};
    const std::string html = reportHtml(report);
    EXPECT_THAT(html, HasSubstr("range tolerance 0.25 drops, &lt;forward&gt; against itself"));
    EXPECT_THAT(html,
                HasSubstr("bias <span class=\"whole\">&minus;5.0&#8239;&times;&#8239;10<sup>&minus;1</sup></span>"));
    EXPECT_EQ(faultOf(html), "");
}

TEST(Report, everyPictureIsEmbeddedExactlyOnce) {
    const Report report = sampleReport();
    const std::string html = reportHtml(report);
    EXPECT_EQ(occurrences(html, "src=\"data:image/png;base64,"), report.pictures.size() + report.heatMaps.size());
    EXPECT_THAT(html, HasSubstr(pngDataUri(report.pictures[1].image.bytes)));
    EXPECT_THAT(html, HasSubstr("data-left=\"picture-0\" data-right=\"picture-1\""));
    EXPECT_EQ(occurrences(html, " id=\"picture-1\""), 1u);
    EXPECT_EQ(occurrences(html, "<p>Both pictures have the same bits in every pixel.</p>"), 1u);
}

TEST(Report, theVerdictSaysHowManyPairsMissed) {
    Report report = sampleReport();
    EXPECT_THAT(
        reportHtml(report),
        HasSubstr("1 of 2 comparisons missed a tolerance or lost geometry; each one below lists what it missed."));
    EXPECT_THAT(reportHtml(report),
                HasSubstr("<li>maxRel is 0.5, at most <span class=\"whole\">1e-05</span> is required</li>"));
    report.record.pairs.pop_back();
    EXPECT_THAT(reportHtml(report), HasSubstr("The comparison holds."));
    report.record.pairs.clear();
    EXPECT_THAT(reportHtml(report), HasSubstr("Nothing was compared."));
    EXPECT_EQ(faultOf(reportHtml(report)), "");
}

TEST(Report, aPairWithoutPicturesNeverHasASlider) {
    Report report = sampleReport();
    report.pictures.clear();
    report.heatMaps.clear();
    EXPECT_THAT(reportHtml(report), Not(HasSubstr("data-left=")));
    EXPECT_EQ(faultOf(reportHtml(report)), "");
    EXPECT_EQ(faultOf(reportHtml(Report{})), "");
}

TEST(Report, figuresAreSetWithPowersOfTen) {
    EXPECT_THAT(
        reportHtml(sampleReport()),
        HasSubstr("max&nbsp;rel &le;&nbsp;<span class=\"whole\">1.0&#8239;&times;&#8239;10<sup>&minus;5</sup>"));
}

TEST(Html, bytesThatAreNotUtf8AndControlCharactersAreReplaced) {
    EXPECT_EQ(escapedHtml("\xc3\xa4 \xe2\x82\xac \xf0\x9f\x8e\xa8"), "\xc3\xa4 \xe2\x82\xac \xf0\x9f\x8e\xa8");
    const std::string replacement = "\xef\xbf\xbd";
    EXPECT_EQ(escapedHtml("a\xff"
                          "b"),
              "a" + replacement + "b");
    EXPECT_EQ(escapedHtml("\xc3"), replacement);                                     // cut short
    EXPECT_EQ(escapedHtml("\xc0\xaf"), replacement + replacement);                   // overlong
    EXPECT_EQ(escapedHtml("\xed\xa0\x80"), replacement + replacement + replacement); // a surrogate
    EXPECT_EQ(escapedHtml(std::string_view("\0\x1b\n\t", 4)), replacement + replacement + "\n\t");
}

TEST(Base64, everyLengthIsPaddedAsRfc4648Says) {
    const std::string text = "foobar"; // the test vectors of RFC 4648 section 10
    const char* encoded[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
    for (std::size_t length = 0; length <= 6; ++length)
        EXPECT_EQ(base64({reinterpret_cast<const std::uint8_t*>(text.data()), length}), encoded[length]);
    const std::vector<std::uint8_t> high = {0xfb, 0xff, 0xbf};
    EXPECT_EQ(base64(high), "+/+/");
}

} // namespace
} // namespace tessera::validation
