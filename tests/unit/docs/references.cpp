// References in the documents: links to files, and names of tests.
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "tests/unit/docs/Tables.h"

namespace tessera {
namespace {

namespace fs = std::filesystem;

/// First group of every match of `pattern` in `text`.
std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
    std::vector<std::string> found;
    for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) found.push_back(it->str(1));
    return found;
}

/// Anchors of a document's headings, as GitHub makes them: lower case, spaces to hyphens, punctuation dropped.
std::set<std::string> anchorsOf(const fs::path& document) {
    std::set<std::string> anchors;
    for (const std::string& heading : matches(test::textOf(document), std::regex("(?:^|\n)#+ ([^\n]+)"))) {
        std::string anchor;
        for (const char c : heading) {
            if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
                anchor += char(std::tolower(static_cast<unsigned char>(c)));
            else if (c == ' ')
                anchor += '-';
        }
        anchors.insert(anchor);
    }
    return anchors;
}

TEST(Documentation, everyLinkWithinTheRepositoryLeadsSomewhere) {
    int links = 0;
    for (const fs::path& document : test::documents()) {
        for (const std::string& link : matches(test::textOf(document), std::regex(R"(\]\(([^)\s]+)\))"))) {
            if (link.find("://") != std::string::npos) continue;
            const std::size_t hash = std::min(link.find('#'), link.size());
            const fs::path file = hash == 0 ? document : document.parent_path() / link.substr(0, hash);
            EXPECT_TRUE(fs::exists(file)) << document.filename() << ": " << link;
            if (hash < link.size()) {
                EXPECT_TRUE(anchorsOf(file).count(link.substr(hash + 1))) << document.filename() << ": " << link;
            }
            ++links;
        }
    }
    EXPECT_GT(links, 20);
}

/// Tests that the TEST_SWEEP macros declare in a source, in the form of other tests: "(Suite, name)".
std::string namesOfSweeps(const std::string& source) {
    std::string names;
    for (std::size_t at = 0; (at = source.find("TEST_SWEEP", at)) != std::string::npos;) {
        at = source.find('(', at) + 1;
        std::vector<std::string> words{""};
        for (; source[at] != ')'; ++at) {
            if (source[at] == ',')
                words.emplace_back();
            else if (!std::isspace(static_cast<unsigned char>(source[at])))
                words.back() += source[at];
        }
        if (words.size() == 2) words.insert(words.end(), {words[0] + "Slow", words[1]});
        for (std::size_t i = 0; i + 1 < words.size(); i += 2) names += "(" + words[i] + ", " + words[i + 1] + ")";
    }
    return names;
}

TEST(Documentation, everyNamedTestExists) {
    std::string sources;
    for (const auto& entry : fs::recursive_directory_iterator(test::kRepository / "tests")) {
        const fs::path& path = entry.path();
        if (path.extension() != ".cpp" && path.filename() != "CMakeLists.txt") continue;
        const std::string source = test::textOf(path);
        sources += source + namesOfSweeps(source);
    }
    int named = 0;
    for (const fs::path& document : test::documents()) {
        // `Suite.nameOfTheTest`; a name of one word would be a file or a member.
        const std::regex name(R"(`([A-Z]\w+\.[a-z]+[A-Z]\w+)`)");
        for (const std::string& test : matches(test::textOf(document), name)) {
            const std::size_t dot = test.find('.');
            const std::string suite = test.substr(0, dot), contract = test.substr(dot + 1);
            const bool isGoogleTest = sources.find("(" + suite + ", " + contract + ")") != std::string::npos;
            const bool isHouseTest = suite == "House" && sources.find("house_test(" + contract) != std::string::npos;
            const bool isOtherTest = sources.find("add_test(NAME " + test + "\n") != std::string::npos;
            EXPECT_TRUE(isGoogleTest || isHouseTest || isOtherTest) << document.filename() << ": " << test;
            ++named;
        }
    }
    EXPECT_GT(named, 20);
}

} // namespace
} // namespace tessera
