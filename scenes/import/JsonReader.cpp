#include "scenes/import/JsonReader.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/Names.h"
#include "base/Utf8.h"
#include "scenes/Direction.h"

namespace tessera::scenes {
namespace {

using nlohmann::json;

/// Scans a document's text for faults that a parsed document no longer shows.
class KeyChecker : public nlohmann::json_sax<json> {
public:
    KeyChecker(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file) {}

    bool null() override { return value(); }
    bool boolean(bool) override { return value(); }
    bool number_integer(number_integer_t) override { return value(); }
    bool number_unsigned(number_unsigned_t) override { return value(); }
    bool number_float(number_float_t, const string_t&) override { return value(); }
    bool string(string_t&) override { return value(); }
    bool binary(binary_t&) override { return value(); }
    bool start_object(std::size_t) override { return open(); }
    bool end_object() override { return close(); }
    bool start_array(std::size_t) override { return open(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        if (!open_.back().keys.insert(name).second)
            throw InputError(
                fmt::format("{}:{}: the key '{}' is given twice; keep one", file_.string(), pointer(), name));
        open_.back().step = name;
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) override {
        // The position counts characters read; the last one is wrong.
        const std::size_t last = std::min(position > 0 ? position - 1 : 0, text_.size());
        const std::string_view before = text_.substr(0, last);
        const auto line = 1 + std::count(before.begin(), before.end(), '\n');
        const std::size_t lineStart = before.rfind('\n') + 1; // npos + 1 is 0
        std::string what = error.what();
        // Removes the library's redundant position and error number.
        for (const std::string_view prefixEnd : {"] ", "column "})
            if (const std::size_t at = what.find(prefixEnd); at != std::string::npos)
                what.erase(0, at + prefixEnd.size());
        if (const std::size_t colon = what.find(": "); colon != std::string::npos && colon < 8)
            what.erase(0, colon + 2);
        // The message quotes the whole last token, which may be as long as the file.
        constexpr std::size_t kMostBytes = 400;
        if (what.size() > kMostBytes) what = std::string(beginningOf(what, kMostBytes)) + "...";
        throw InputError(fmt::format("{}:{}:{}: {}", file_.string(), line, last - lineStart + 1, what));
    }

private:
    struct Level {
        std::set<std::string> keys;
        std::string step;      ///< key of the value being read; unused in an array
        std::size_t index = 0; ///< of the value being read, in an array
    };

    bool value() {
        if (!open_.empty()) ++open_.back().index;
        return true;
    }

    bool open() {
        open_.emplace_back();
        return true;
    }

    bool close() {
        open_.pop_back();
        return value();
    }

    std::string pointer() const {
        std::string text;
        for (std::size_t i = 0; i + 1 < open_.size(); ++i)
            text = jsonPointerTo(text, open_[i].keys.empty() ? std::to_string(open_[i].index) : open_[i].step);
        return text.empty() ? "/" : text;
    }

    std::string_view text_;
    const std::filesystem::path& file_;
    std::vector<Level> open_;
};

/// Calls `look` with every character outside strings, and with both quotes of each string.
template <typename Look>
void eachOutsideStrings(std::string_view text, Look&& look) {
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') inString = !inString;
        if (inString && c == '\\') ++i;
        if (!inString || c == '"') look(c);
    }
}

/// A JSON string with U+FFFD in place of bytes and escapes that are no characters, such as half a surrogate pair.
std::string mendedString(std::string_view text) {
    text = text.substr(1, text.size() - (text.size() > 1 && text.back() == '"' ? 2 : 1));
    std::string mended = "\"";
    while (!text.empty()) {
        const bool isControl = static_cast<unsigned char>(text.front()) < 0x20;
        std::size_t good = isControl ? 0 : letterBytes(text), length = std::max(good, std::size_t{1});
        if (text.front() == '\\') {
            constexpr std::size_t kLengths[] = {12, 6, 2}; // a surrogate pair, \u and four digits, others
            const auto isEscape = [&](std::size_t bytes) {
                return json::accept(fmt::format("\"{}\"", text.substr(0, bytes)));
            };
            const auto* const found = std::ranges::find_if(kLengths, isEscape);
            good = found != std::end(kLengths) ? *found : 0;
            length = good > 0 ? good : text.starts_with("\\u") ? 6 : 2;
        }
        mended += good > 0 ? text.substr(0, good) : "\\ufffd";
        text.remove_prefix(std::min(length, text.size()));
    }
    return mended + '"';
}

std::string_view typeOf(const nlohmann::json& value) {
    if (value.is_null()) return "null";
    if (value.is_boolean()) return "true or false";
    if (value.is_number()) return "a number";
    if (value.is_string()) return "text";
    return value.is_array() ? "an array" : "an object";
}

} // namespace

void requireJsonDepth(std::string_view text, const std::filesystem::path& file) {
    int depth = 0;
    eachOutsideStrings(text, [&](char c) {
        if ((c == '{' || c == '[') && ++depth > kMaxJsonDepth)
            throw InputError(
                fmt::format("{}: the JSON nests deeper than {}; make it flatter", file.string(), kMaxJsonDepth));
        if (c == '}' || c == ']') --depth;
    });
}

MendedJson mendedJson(std::string_view text) {
    MendedJson mended;
    mended.text.reserve(text.size());
    std::size_t comma = text.npos; // position in the mended text, followed only by blanks
    const auto replace = [&](std::size_t at, std::string_view flaw, std::string_view by) {
        if (mended.line == 0) {
            mended.line = 1 + int(std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n'));
            constexpr std::size_t kMostShown = 40;
            mended.flaw = fmt::format("'{}' is not JSON", flaw.substr(0, kMostShown));
        }
        mended.text += by;
    };
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at + 1;
        if (text[at] == '"') {
            while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
            end = std::min(end + 1, text.size());
        } else if (text.substr(at).starts_with("//") || text.substr(at).starts_with("/*")) {
            const bool isLine = text[at + 1] == '/';
            end = std::min(text.find(isLine ? "\n" : "*/", at + 2), text.size());
            if (!isLine) end = std::min(end + 2, text.size());
            replace(at, text.substr(at, end - at), " ");
            at = end;
            continue;
        } else if (constexpr std::string_view kSyntax = ",:[]{}\" \t\r\n/"; kSyntax.find(text[at]) == kSyntax.npos) {
            end = std::min(text.find_first_of(kSyntax, at), text.size());
        }
        const std::string_view part = text.substr(at, end - at);
        const bool isBlank = part.find_first_not_of(" \t\r\n") == part.npos;
        if ((part == "]" || part == "}") && comma != text.npos) {
            mended.text[comma] = ' ';
            replace(at, fmt::format(",{}", part), part);
        } else if (part.size() > 1 && !json::accept(part)) {
            replace(at, part, part.front() == '"' ? mendedString(part) : "null");
        } else {
            mended.text += part;
        }
        if (!isBlank) comma = part == "," ? mended.text.size() - 1 : text.npos;
        at = end;
    }
    return mended;
}

std::uint64_t parsedJsonBytes(std::string_view text) {
    // A value follows each of these characters, stored three times while a doubling array grows. Arrays, objects and
    // strings are heap blocks, strings have a second one for their characters, and members of objects are tree nodes.
    // The sizes are those of heap blocks.
    constexpr std::uint64_t kValueBytes = 3 * sizeof(json), kArrayBytes = 32, kObjectBytes = 64, kMemberBytes = 96;
    constexpr std::uint64_t kStringBytes = 48 + 24;
    std::uint64_t bytes = text.size() + kValueBytes;
    eachOutsideStrings(text, [&](char c) {
        if (c == ',') bytes += kValueBytes;
        if (c == '[') bytes += kValueBytes + kArrayBytes;
        if (c == '{') bytes += kValueBytes + kObjectBytes;
        if (c == ':') bytes += kMemberBytes;
        if (c == '"') bytes += kStringBytes / 2;
    });
    return bytes;
}

json parseJson(std::string_view text, const std::filesystem::path& file, LoadLedger& ledger) {
    ledger.charge(parsedJsonBytes(text), [&] { return file.string() + ": its JSON"; });
    requireJsonDepth(text, file);
    KeyChecker checker(text, file);
    json::sax_parse(text, &checker);
    return json::parse(text);
}

std::string jsonPointerTo(const std::string& pointer, std::string_view key) {
    std::string text = pointer + '/';
    for (const char c : key) {
        if (c == '~')
            text += "~0";
        else if (c == '/')
            text += "~1";
        else
            text += c;
    }
    return text;
}

void JsonValue::fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: {}", file_->string(), pointer_.empty() ? "/" : pointer_, what));
}

void JsonValue::failUnknown(std::string_view what, std::string_view name,
                            std::span<const std::string_view> known) const {
    fail("there is no {} '{}'; {}", what, name, suggestNames(name, known));
}

void JsonValue::failType(std::string_view needed) const {
    fail("is {}; {} is needed", typeOf(*value_), needed);
}

double JsonValue::number(double least, double most) const {
    if (!value_->is_number()) failType("a number");
    const double number = value_->get<double>();
    if (number < least) fail("is {}; at least {} is needed", number, least);
    if (number > most) fail("is {}; at most {} is allowed", number, most);
    return number;
}

float JsonValue::single(double least, double most) const {
    return float(number(least, most));
}

double JsonValue::positive() const {
    const double value = number();
    if (!(value > 0.0)) fail("is {}; more than 0 is needed", value);
    return value;
}

int JsonValue::integer(int least, int most) const {
    const double value = number(least, most);
    if (value != std::floor(value)) fail("is {}; a whole number is needed", value);
    return int(value);
}

bool JsonValue::boolean() const {
    if (!value_->is_boolean()) failType("true or false");
    return value_->get<bool>();
}

std::string JsonValue::textOrEmpty() const {
    if (!value_->is_string()) failType("text");
    return value_->get<std::string>();
}

std::string JsonValue::text() const {
    std::string text = textOrEmpty();
    if (text.empty()) fail("is empty; give a name");
    return text;
}

std::vector<JsonValue> JsonValue::elements(std::size_t least, std::size_t most) const {
    if (!value_->is_array()) failType(least == most ? fmt::format("an array of {}", least) : "an array");
    const std::size_t count = value_->size();
    if (least == most && count != least) fail("has {} elements; exactly {} are needed", count, least);
    if (count < least) fail("has {} elements; at least {} are needed", count, least);
    if (count > most) fail("has {} elements; at most {} are allowed", count, most);
    std::vector<JsonValue> elements;
    elements.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        elements.emplace_back((*value_)[i], *file_, jsonPointerTo(pointer_, std::to_string(i)));
    return elements;
}

glm::vec2 JsonValue::vector2() const {
    const std::vector<JsonValue> values = elements(2, 2);
    return {values[0].single(), values[1].single()};
}

glm::dvec3 JsonValue::vector3() const {
    const std::vector<JsonValue> values = elements(3, 3);
    return {values[0].number(), values[1].number(), values[2].number()};
}

glm::dvec3 JsonValue::direction() const {
    const std::optional<glm::dvec3> direction = directionOf(vector3());
    if (!direction) fail("has no length; give a direction");
    return *direction;
}

glm::vec3 JsonValue::color(double least, double most) const {
    const std::vector<JsonValue> values = elements(3, 3);
    return {values[0].single(least, most), values[1].single(least, most), values[2].single(least, most)};
}

JsonObject JsonValue::object() const {
    return JsonObject(*this);
}

JsonObject::JsonObject(JsonValue value) : value_(std::move(value)) {
    if (!value_.isObject()) value_.failType("an object");
}

std::optional<JsonValue> JsonObject::find(std::string_view key) {
    if (std::ranges::find(known_, key) == known_.end()) known_.emplace_back(key);
    const auto found = value_.value_->find(key);
    if (found == value_.value_->end()) return std::nullopt;
    return JsonValue(*found, *value_.file_, jsonPointerTo(value_.pointer_, key));
}

std::vector<std::string> JsonObject::keys() const {
    std::vector<std::string> keys;
    for (const auto& [key, ignored] : value_.value_->items()) keys.push_back(key);
    return keys;
}

JsonValue JsonObject::require(std::string_view key) {
    if (std::optional<JsonValue> found = find(key)) return *std::move(found);
    // The key may be present but misspelt.
    const std::vector<std::string> there = keys();
    std::vector<std::string_view> others;
    for (const std::string& other : there)
        if (std::ranges::find(known_, other) == known_.end()) others.push_back(other);
    if (const std::vector<std::string_view> nearest = nearestNames(key, others); !nearest.empty())
        value_.fail("has the unknown key '{}'; did you mean '{}'?", nearest.front(), key);
    value_.fail("lacks the key '{}'; add it", key);
}

void JsonObject::done(std::string_view what) const {
    const std::vector<std::string_view> known(known_.begin(), known_.end());
    for (const auto& [key, ignored] : value_.value_->items()) {
        if (std::ranges::find(known_, key) == known_.end())
            value_.fail("{} has no key '{}'; {}", what, key, suggestNames(key, known));
    }
}

} // namespace tessera::scenes
