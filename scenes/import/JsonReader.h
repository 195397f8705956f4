#pragma once
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "scenes/LoadLedger.h"

namespace tessera::scenes {

/// Parses a JSON document and charges the ledger for it. Throws InputError: "file:line:column: what" for broken syntax,
/// including NaN and comments, and for numbers too large for a double; "file:/json/pointer: what" for a duplicate key;
/// "file: what" for a document that nests too deep.
nlohmann::json parseJson(std::string_view text, const std::filesystem::path& file, LoadLedger& ledger);

/// Far deeper than any document here nests. Printing and converting JSON recurse, so files must not set the depth.
inline constexpr int kMaxJsonDepth = 64;

/// Throws InputError if the brackets of a text nest deeper than kMaxJsonDepth. Avoids the library's parser callback,
/// which searches the whole array for every element.
void requireJsonDepth(std::string_view text, const std::filesystem::path& file);

struct MendedJson {
    std::string text;
    int line = 0; ///< of the first flaw; 0: none was found
    std::string flaw;
};
/// Replaces text that programs write although it is not JSON: words and numbers that are not JSON values, such as NaN,
/// -inf and 1.#IND, by null; comments, and commas before a closing bracket, by blanks.
MendedJson mendedJson(std::string_view text);

/// Upper bound of the memory of a parsed document of this text.
std::uint64_t parsedJsonBytes(std::string_view text);

/// `pointer` with one more step. Source: RFC 6901, "JSON Pointer".
std::string jsonPointerTo(const std::string& pointer, std::string_view key);

class JsonObject;

/// A value of a JSON document with its position. Every function throws InputError "file:/json/pointer: what" unless the
/// value has the function's type. The document and its path must outlive it.
class JsonValue {
public:
    JsonValue(const nlohmann::json& value, const std::filesystem::path& file, std::string pointer = {})
        : value_(&value), file_(&file), pointer_(std::move(pointer)) {}

    const std::filesystem::path& file() const { return *file_; }
    bool isNull() const { return value_->is_null(); }
    bool isNumber() const { return value_->is_number(); }
    bool isBoolean() const { return value_->is_boolean(); }
    bool isText() const { return value_->is_string(); }
    bool isArray() const { return value_->is_array(); }
    bool isObject() const { return value_->is_object(); }
    std::size_t size() const { return value_->size(); } ///< elements of an array, members of an object

    /// Within the limits, both included.
    double number(double least = -std::numeric_limits<double>::infinity(),
                  double most = std::numeric_limits<double>::infinity()) const;
    /// The same, also finite in single precision.
    float single(double least = -std::numeric_limits<float>::max(),
                 double most = std::numeric_limits<float>::max()) const;
    double positive() const;
    int integer(int least, int most) const;
    bool boolean() const;
    std::string text() const; ///< not empty
    std::string textOrEmpty() const;
    std::vector<JsonValue> elements(std::size_t least = 0,
                                    std::size_t most = std::numeric_limits<std::size_t>::max()) const;
    glm::vec2 vector2() const;
    glm::dvec3 vector3() const;
    glm::dvec3 direction() const; ///< normalised; the length must not be 0
    /// Three numbers within the limits.
    glm::vec3 color(double least = 0.0, double most = std::numeric_limits<float>::max()) const;
    JsonObject object() const;

    /// The choice named by the text; `what` is the kind of choice in messages ("light", "wrap mode").
    template <typename Choice>
    Choice oneOf(std::string_view what, std::span<const std::pair<std::string_view, Choice>> choices) const {
        const std::string name = text();
        std::vector<std::string_view> names;
        for (const auto& [known, choice] : choices) {
            if (known == name) return choice;
            names.push_back(known);
        }
        failUnknown(what, name, names);
    }

    [[noreturn]] void fail(const std::string& what) const;
    template <typename First, typename... Values>
    [[noreturn]] void fail(fmt::format_string<First, Values...> what, First&& first, Values&&... values) const {
        fail(fmt::format(what, std::forward<First>(first), std::forward<Values>(values)...));
    }
    /// "there is no WHAT 'name'; did you mean ...".
    [[noreturn]] void failUnknown(std::string_view what, std::string_view name,
                                  std::span<const std::string_view> known) const;

private:
    friend class JsonObject;
    [[noreturn]] void failType(std::string_view needed) const;

    const nlohmann::json* value_;
    const std::filesystem::path* file_;
    std::string pointer_;
};

/// An object whose keys are read one by one; done() refuses keys that were not read.
class JsonObject {
public:
    explicit JsonObject(JsonValue value);

    std::optional<JsonValue> find(std::string_view key);
    JsonValue require(std::string_view key);
    std::vector<std::string> keys() const;
    bool has(std::string_view key) const { return value_.value_->contains(key); }
    const JsonValue& value() const { return value_; }

    /// Throws InputError for the first unknown key, with the nearest of the requested keys; `what` names the kind of
    /// object.
    void done(std::string_view what) const;

private:
    JsonValue value_;
    std::vector<std::string> known_;
};

} // namespace tessera::scenes
