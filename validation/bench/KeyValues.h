#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Values of settings that a matrix varies beside a choice, as the width of shadows beside their filter. The choice has
/// a table of them, with rows that have a `key` of engine::settingTable() and the `format` of a value in a point's
/// name.
namespace tessera::validation {

struct KeyValue {
    std::string_view key;
    std::string text; ///< as the setting reads it
    bool operator==(const KeyValue&) const = default;
};

/// Null: there is no such value.
const std::string* valueText(const std::vector<KeyValue>& values, std::string_view key);

/// ", 1024 texels"; nothing where there is no such value, or it is the default.
std::string changedText(const std::vector<KeyValue>& values, std::string_view key, std::string_view format);

/// ", 5x5, 1024 texels": the same of all rows.
template <typename Row>
std::string changedTexts(const std::vector<KeyValue>& values, std::span<const Row> table) {
    std::string text;
    for (const Row& row : table) text += changedText(values, row.key, row.format);
    return text;
}

} // namespace tessera::validation
