#pragma once
#include <algorithm>
#include <regex>
#include <sstream>
#include <string>

#include "tests/cli/program/Cli.h"

/// Names in a text of --help.
namespace tessera::test {

inline Words linesOf(const std::string& text) {
    Words lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// The first capture group of the pattern in every line.
inline Words firstWords(const std::string& text, const std::regex& pattern) {
    Words words;
    for (const std::string& line : linesOf(text))
        if (std::smatch found; std::regex_search(line, found, pattern)) words.push_back(found[1]);
    return words;
}

/// The names of the options; "-o, --output FILE" gives both of its names.
inline Words optionsIn(const std::string& help) {
    Words names;
    for (const std::string& option : firstWords(help, std::regex("^  (-[-a-z]+(?:, -[-a-z]+)*)(?: |$)"))) {
        std::string text = option;
        std::ranges::replace(text, ',', '\n');
        for (std::string name : linesOf(text)) {
            name.erase(0, name.find('-'));
            names.push_back(name);
        }
    }
    return names;
}

/// The commands that the program's help lists.
inline Words commandsIn(const std::string& help) {
    const std::size_t begin = help.find("\nSubcommands:\n"), end = help.find("\n\n", begin);
    return begin == help.npos ? Words() : firstWords(help.substr(begin, end - begin), std::regex("^  ([a-z]+) "));
}

} // namespace tessera::test
