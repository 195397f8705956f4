#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <map>
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

/// Reads the properties of a glTF document's objects into structs and checks them on the way: their JSON types, ranges
/// and choices, and that each index names an element that exists. Errors are InputErrors "file: /json/pointer: what".
namespace tessera::scenes::gltf {

inline constexpr double kMaxInteger = 9007199254740992.0; ///< 2^53: JSON numbers are exact to here
inline constexpr double kMaxInt = std::numeric_limits<int>::max();

/// What a number must lie within.
struct Range {
    double least = -std::numeric_limits<double>::max();
    double most = std::numeric_limits<double>::max();
};
inline constexpr Range kFromZero{0.0};
inline constexpr Range kFromOne{1.0};
inline constexpr Range kFraction{0.0, 1.0};
inline constexpr Range kBytes{0.0, kMaxInteger}; ///< offsets
inline constexpr Range kCount{1.0, kMaxInteger};

/// The array of which an index counts the elements, by its path in the document.
struct IndexOf {
    std::string_view array;
};

/// A value that a property may have, and what it means.
template <typename Written, typename Meaning>
using Choice = std::pair<Written, Meaning>;

struct AnyValue {};  ///< nothing of it is checked or read
struct AnyObject {}; ///< nothing of it is read

/// Receives a value that is checked and not needed.
template <typename Receiver>
Receiver& unneeded(Receiver&& receiver = Receiver()) {
    return receiver;
}

/// A place in a document, whose text is made for messages only: nearly all places are good. It refers to the one above.
class Place {
public:
    Place() = default; ///< the document
    Place(const Place& above, std::string_view path) : above_(&above), path_(path) {}
    Place(const Place& above, std::size_t index) : above_(&above), index_(index) {}

    std::string text() const; ///< a JSON pointer, "/" for the document

private:
    std::string pointer() const;

    const Place* above_ = nullptr;
    std::string_view path_; ///< no data: an array's element
    std::size_t index_ = 0;
};

/// A document that is being read. Texts are moved out of it.
struct Source {
    nlohmann::json& document;
    const std::string& file;
    LoadLedger& ledger;

    [[noreturn]] void fail(const Place& place, std::string_view what) const;
    /// Of bytes that `count` elements of an array or an object at a place are about to take.
    void charge(std::uint64_t bytes, const Place& place, std::size_t count) const;
};

class Object;

/// Something that reads its members from the properties of an object.
template <typename Struct>
concept Readable = requires(Struct value, Object& object) {
    value.read(object);
};

/// A value of a document: each read() checks that it is what the receiver holds. Numbers end as floats in the scene, so
/// what overflows one is out of range.
class Value {
public:
    Value(const Source& source, nlohmann::json& json, Place place) : source_(source), json_(json), place_(place) {}

    void read(AnyValue&) const {}
    void read(AnyObject&) const { requireType(json_.is_object(), "an object"); }
    void read(std::string& text) const;
    void read(bool& flag) const;
    void read(double& number, Range range = {}) const;
    void read(float& number, Range range = {}) const;
    void read(int& integer, Range range) const { integer = static_cast<int>(this->integer(range)); }
    void read(std::size_t& integer, Range range) const { integer = static_cast<std::size_t>(this->integer(range)); }
    void read(int& index, IndexOf elements) const;
    void read(glm::dmat4& matrix) const; ///< column by column

    template <glm::length_t kLength, typename Number>
    void read(glm::vec<kLength, Number>& vector, Range range = {}) const {
        std::array<double, std::size_t(kLength)> numbers;
        readNumbers(numbers, range);
        for (glm::length_t i = 0; i < kLength; ++i) vector[i] = static_cast<Number>(numbers[std::size_t(i)]);
    }

    template <typename Written, typename Meaning, std::size_t kChoices>
    void read(Meaning& meaning, const Choice<Written, Meaning> (&choices)[kChoices]) const {
        std::vector<Written> valid;
        for (const auto& [written, choice] : choices) {
            if (isChosen(written)) {
                meaning = choice;
                return;
            }
            valid.push_back(written);
        }
        failChoice(fmt::format("{}", fmt::join(valid, ", ")));
    }

    template <typename Element, typename... Bounds>
    void read(std::optional<Element>& optional, const Bounds&... bounds) const {
        read(optional.emplace(), bounds...);
    }

    template <typename Element, typename... Bounds>
    void read(std::vector<Element>& elements, const Bounds&... bounds) const {
        requireType(json_.is_array(), "an array");
        source_.charge(json_.size() * sizeof(Element) + kBlockBytes, place_, json_.size());
        elements.resize(json_.size());
        for (std::size_t i = 0; i < elements.size(); ++i)
            Value(source_, json_[i], Place(place_, i)).read(elements[i], bounds...);
    }

    template <typename Element, typename... Bounds>
    void read(std::map<std::string, Element>& elements, const Bounds&... bounds) const {
        requireType(json_.is_object(), "an object");
        source_.charge(json_.size() * (sizeof(typename std::map<std::string, Element>::value_type) + kBlockBytes),
                       place_, json_.size());
        for (auto& [key, element] : json_.items())
            Value(source_, element, Place(place_, key)).read(elements[key], bounds...);
    }

    template <Readable Struct>
    void read(Struct& value) const;

private:
    /// What a block of the heap, or a node of a map, takes beside its content.
    static constexpr std::uint64_t kBlockBytes = 48;

    [[noreturn]] void fail(std::string_view what) const { source_.fail(place_, what); }
    void requireType(bool isGood, std::string_view type) const;
    double number(Range range) const;
    std::int64_t integer(Range range) const;
    void requireRange(double number, Range range) const;
    void readNumbers(std::span<double> numbers, Range range) const;
    bool isChosen(std::string_view text) const;
    bool isChosen(int integer) const;
    [[noreturn]] void failChoice(std::string_view valid) const;

    const Source& source_;
    nlohmann::json& json_;
    Place place_;
};

/// An object of a document. A property is named by the path of keys to it, "sparse/count".
class Object {
public:
    Object(const Source& source, nlohmann::json& json, Place place); ///< throws unless the value is an object

    bool has(std::string_view key) const { return json_.contains(key); }

    /// Reads a property where it is there.
    template <typename Member, typename... Bounds>
    void optional(std::string_view path, Member& member, const Bounds&... bounds) const {
        if (const std::optional<Value> value = find(path, false)) value->read(member, bounds...);
    }

    /// Reads a property, which must be there where the object above it is.
    template <typename Member, typename... Bounds>
    void required(std::string_view path, Member& member, const Bounds&... bounds) const {
        if (const std::optional<Value> value = find(path, true)) value->read(member, bounds...);
    }

    [[noreturn]] void failMissing(std::string_view key) const;
    [[noreturn]] void fail(std::string_view key, std::string_view what) const;

private:
    std::optional<Value> find(std::string_view path, bool isRequired) const;

    const Source& source_;
    nlohmann::json& json_;
    Place place_;
};

template <Readable Struct>
void Value::read(Struct& value) const {
    Object object(source_, json_, place_);
    value.read(object);
}

} // namespace tessera::scenes::gltf
