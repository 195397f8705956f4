#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::viewer {

/// One entry of a list to choose from.
struct Choice {
    std::string_view name;
    std::string_view meaning; ///< shown beside the pointer
    bool isPossible = true;   ///< others are shown, but cannot be chosen
};

/// A row of a panel: the label on the left, and what is drawn next takes the rest of its width.
void row(const char* label);

/// A list that drops down, in a row of its own. Returns what was chosen now.
std::optional<std::size_t> choose(const char* label, std::string_view shown, std::span<const Choice> choices,
                                  std::size_t chosen);

/// The rows of one of the library's tables to choose from.
template <typename Table>
std::vector<Choice> choicesOf(const Table& table, const auto& meaning, const auto& isPossible) {
    std::vector<Choice> choices;
    for (const auto& entry : table) choices.push_back({entry.name, meaning(entry), isPossible(entry)});
    return choices;
}
template <typename Table>
std::vector<Choice> choicesOf(const Table& table) {
    return choicesOf(
        table, [](const auto& entry) { return entry.summary; }, [](const auto&) { return true; });
}

/// Lets Esc close the list that is being drawn.
void closeOnEscape();

/// Text over the whole width, broken where it must be.
void paragraph(std::string_view text);
/// The same in the colour of errors.
void errorParagraph(std::string_view text);
/// A box beside the pointer while it rests on the latest item.
void tip(std::string_view text);
/// A name and a value in one row.
void fact(const char* label, const std::string& value);

} // namespace tessera::viewer
