#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/Error.h"
#include "scenes/import/GltfModel.h"
#include "scenes/import/GltfProperties.h"

namespace tessera::scenes::gltf {
namespace {

using Json = nlohmann::json;

constexpr double kMaxInt = std::numeric_limits<int>::max(), kMaxFloat = std::numeric_limits<float>::max();
constexpr double kMaxInteger = 9007199254740992.0; ///< 2^53: JSON numbers are exact to here
constexpr std::uint64_t kHeapBlockBytes = 48;      ///< beside the content: a block of the heap, a map's node
constexpr std::uint64_t kGrowth = 3;               ///< copies while an array that doubles is copied
constexpr std::uint64_t kMemberBytes = 2 * kHeapBlockBytes + sizeof(tiny::Value); ///< a named value of tinygltf

// ---- Schema --------------------------------------------------------------------------------------------------------

enum class Kind { Text, Flag, Object, Number, Int, Size, Index, Choice, Code, Struct };

struct Struct;

struct Type {
    Kind kind{};
    std::vector<std::string_view> arrays; ///< innermost first: "3", "" or "{}"
    double least = -kMaxFloat, most = kMaxFloat;
    bool isMoreThanLeast = false;
    std::int64_t divisor = 1;
    std::string_view array; ///< of an index, by its path in the document
    std::vector<std::string_view> choices;
    const Struct* object = nullptr;
};

struct Property {
    std::string_view path;
    std::vector<std::string_view> keys;
    bool isRequired = false;
    std::string_view conditionKey, condition; ///< where it is required, too
    Type type;
};

struct Struct {
    std::uint64_t bytes = sizeof(tiny::Value); ///< of what tinygltf makes of an element of an array
    bool isValue = true;
    std::vector<Property> properties;
};

std::string_view cut(std::string_view& text, std::string_view separators) {
    const std::string_view first = text.substr(0, text.find_first_of(separators));
    text.remove_prefix(first.size());
    return first;
}

std::vector<std::string_view> split(std::string_view text, std::string_view separator) {
    std::vector<std::string_view> parts{cut(text, separator)};
    while (!text.empty()) {
        text.remove_prefix(1);
        parts.push_back(cut(text, separator));
    }
    return parts;
}

void readNumber(std::string_view text, auto& number) {
    std::from_chars(text.data(), text.data() + text.size(), number);
}

/// What tinygltf makes of an element of an array, at most: all but `nodes` (GltfParser.cpp) grow. Others become values.
const std::map<std::string_view, std::uint64_t>& elementBytes() {
    static const std::map<std::string_view, std::uint64_t> kBytes{
        {"Document", 0},
        {"Scene", kGrowth * sizeof(tiny::Scene)},
        {"Node", sizeof(tiny::Node)},
        {"Mesh", kGrowth * sizeof(tiny::Mesh)},
        {"Primitive", kGrowth * sizeof(tiny::Primitive)},
        {"Accessor", kGrowth * sizeof(tiny::Accessor)},
        {"BufferView", kGrowth * sizeof(tiny::BufferView)},
        {"Buffer", kGrowth * sizeof(tiny::Buffer)},
        {"Image", sizeof(tiny::Image)},
        {"Texture", kGrowth * sizeof(tiny::Texture)},
        {"Sampler", kGrowth * sizeof(tiny::Sampler)},
        {"Material", kGrowth * sizeof(tiny::Material) + sizeof(StoredMaterial)},
        {"Camera", kGrowth * sizeof(tiny::Camera)},
        {"Skin", kGrowth * sizeof(tiny::Skin)},
        {"Animation", kGrowth * sizeof(tiny::Animation)},
        {"AnimationSampler", kGrowth * sizeof(tiny::AnimationSampler)},
        {"AnimationChannel", kGrowth * sizeof(tiny::AnimationChannel)},
    };
    return kBytes;
}

/// Objects by name.
class Schema {
public:
    Schema() {
        for (const auto& [name, bytes] : elementBytes()) objects_[name] = {bytes + kHeapBlockBytes, false, {}};
        objects_["Light"].bytes += kGrowth * sizeof(tiny::Light); // beside its value
        Struct* object = nullptr;
        for (const std::string_view line : split(kProperties, "\n"))
            if (line.empty() || line.front() != ' ')
                object = &objects_[line];
            else
                for (const std::string_view property : split(line.substr(1), ";"))
                    object->properties.push_back(propertyOf(property));
    }

    const Struct& document() const { return objects_.at("Document"); }
    const std::vector<std::string_view>& countedArrays() const { return countedArrays_; }

private:
    Property propertyOf(std::string_view text) {
        Property property;
        text.remove_prefix(text.find_first_not_of(' '));
        property.path = cut(text, "!? ");
        property.keys = split(property.path, "/");
        property.isRequired = text.front() == '!';
        const std::string_view condition = cut(text, " ");
        if (condition.starts_with('?')) {
            const std::size_t equals = condition.find('=');
            property.conditionKey = condition.substr(1, equals - 1);
            property.condition = condition.substr(equals + 1);
        }
        property.type = typeOf(text.substr(1));
        return property;
    }

    Type typeOf(std::string_view text) {
        constexpr std::string_view kKinds[] = {"text", "flag",  "object", "number", "int",
                                               "size", "index", "choice", "code"}; // as Kind
        Type type;
        const std::string_view name = cut(text, "[{:");
        type.kind = Kind(std::ranges::find(kKinds, name) - std::begin(kKinds));
        if (type.kind == Kind::Struct) type.object = &objects_[name];
        while (!text.empty() && text.front() != ':') {
            const std::size_t end = text.find_first_of("]}") + 1;
            type.arrays.push_back(text.front() == '{' ? "{}" : text.substr(1, end - 2));
            text.remove_prefix(end);
        }
        if (type.kind == Kind::Int || type.kind == Kind::Index) type.most = kMaxInt;
        if (type.kind == Kind::Size) type.most = kMaxInteger;
        if (text.empty()) return type;
        text.remove_prefix(1);
        if (type.kind == Kind::Index) {
            type.least = 0.0;
            type.array = text;
            countedArrays_.push_back(text);
        } else if (type.kind == Kind::Choice || type.kind == Kind::Code) {
            type.choices = split(text, "|");
        } else {
            type.isMoreThanLeast = text.front() == '>';
            if (type.isMoreThanLeast) text.remove_prefix(1);
            readNumber(text, type.least);
            if (const std::size_t dots = text.find(".."); dots != text.npos)
                readNumber(text.substr(dots + 2), type.most);
            if (const std::size_t by = text.find('%'); by != text.npos) readNumber(text.substr(by + 1), type.divisor);
        }
        return type;
    }

    std::map<std::string_view, Struct> objects_;
    std::vector<std::string_view> countedArrays_;
};

const Schema& schema() {
    static const Schema made;
    return made;
}

// ---- Check ---------------------------------------------------------------------------------------------------------

/// A place in a document, whose text is made for messages only: nearly all places are good. It refers to the one above.
class Place {
public:
    Place() = default; ///< the document
    Place(const Place& above, std::string_view path) : above_(&above), path_(path) {}
    Place(const Place& above, std::size_t index) : above_(&above), index_(index) {}

    std::string text() const { return above_ == nullptr ? "/" : pointer(); } ///< a JSON pointer, "/" for the document

private:
    std::string pointer() const {
        if (above_ == nullptr) return {};
        return above_->pointer() + (path_.data() != nullptr ? fmt::format("/{}", path_) : fmt::format("/{}", index_));
    }

    const Place* above_ = nullptr;
    std::string_view path_; ///< no data: an array's element
    std::size_t index_ = 0;
};

class Checker {
public:
    Checker(const Json& document, const std::string& file, LoadLedger& ledger) : file_(file), ledger_(ledger) {
        for (const std::string_view array : schema().countedArrays())
            counts_.try_emplace(array, counted(document, array));
    }

    Json object(Json& value, const Struct& object, const Place& place) {
        require(value.is_object(), "an object", value, place);
        Json checked = Json::object();
        for (const Property& property : object.properties) {
            Json* const found = find(value, property, checked, place);
            if (found == nullptr) continue;
            Json* to = &checked;
            for (const std::string_view key : property.keys) to = &(*to)[key];
            const bool isValue = object.isValue || property.keys.front() == "extensions";
            if (isValue) charge(kMemberBytes * property.keys.size(), place, 1);
            *to = arrays(*found, property.type, property.type.arrays.size(), isValue, Place(place, property.path));
        }
        return checked;
    }

private:
    /// Where an index cannot name an element, one of the texts is set.
    struct Counted {
        std::size_t size = 0;
        std::string_view missing; ///< the key
        std::string type;         ///< of what is no array
    };

    static Counted counted(const Json& document, std::string_view array) {
        const Json* value = &document;
        for (const std::string_view key : split(array, "/")) {
            const auto member = value->is_object() ? value->find(key) : value->end();
            if (!value->is_object() || member == value->end()) return {0, key, {}};
            value = &*member;
        }
        return {value->size(), {}, value->is_array() ? "" : value->type_name()};
    }

    /// `checked` has the properties before it.
    Json* find(Json& object, const Property& property, const Json& checked, const Place& place) const {
        Json* value = &object;
        for (std::size_t i = 0; i < property.keys.size(); ++i) {
            const std::string_view key = property.keys[i];
            const auto above = [&] {
                return std::string_view(property.path.data(),
                                        i == 0 ? 0 : std::size_t(key.data() - property.path.data()) - 1);
            };
            if (i > 0) require(value->is_object(), "an object", *value, Place(place, above()));
            const auto found = value->find(key);
            if (found != value->end()) {
                value = &*found;
                continue;
            }
            if (i + 1 == property.keys.size() && isRequired(checked, property))
                fail(i == 0 ? place : Place(place, above()), fmt::format("the required property '{}' is missing", key));
            return nullptr;
        }
        return value;
    }

    static bool isRequired(const Json& checked, const Property& property) {
        if (property.conditionKey.empty()) return property.isRequired;
        const auto found = checked.find(property.conditionKey);
        return found != checked.end() && found->get_ref<const std::string&>() == property.condition;
    }

    Json arrays(Json& value, const Type& type, std::size_t depth, bool isValue, const Place& place) {
        if (depth == 0) return single(value, type, isValue, place);
        const std::string_view size = type.arrays[depth - 1];
        const std::uint64_t numberBytes = isValue ? sizeof(tiny::Value) : kGrowth * sizeof(double);
        const std::uint64_t blockBytes = isValue ? sizeof(tiny::Value) : kGrowth * kHeapBlockBytes;
        const std::uint64_t bytes = type.object != nullptr                 ? type.object->bytes
                                    : depth > 1 || type.kind == Kind::Text ? blockBytes
                                                                           : numberBytes;
        if (size == "{}") {
            require(value.is_object(), "an object", value, place);
            charge(value.size() * (isValue ? kMemberBytes : 3 * kHeapBlockBytes), place, value.size());
            for (auto& [key, element] : value.items())
                element = arrays(element, type, depth - 1, isValue, Place(place, key));
            return std::move(value);
        }
        const bool isVector = !size.empty();
        require(value.is_array(), isVector ? "an array of numbers" : "an array", value, place);
        if (isVector && std::to_string(value.size()) != size)
            fail(place, fmt::format("must hold {} numbers, but holds {}", size, value.size()));
        charge(value.size() * bytes + kHeapBlockBytes, place, value.size());
        for (std::size_t i = 0; i < value.size(); ++i)
            value[i] = arrays(value[i], type, depth - 1, isValue, Place(place, i));
        return std::move(value);
    }

    Json single(Json& value, const Type& type, bool isValue, const Place& place) {
        switch (type.kind) {
        case Kind::Struct:
            return object(value, *type.object, place);
        case Kind::Object:
            require(value.is_object(), "an object", value, place);
            return Json::object();
        case Kind::Flag:
            require(value.is_boolean(), "true or false", value, place);
            return value;
        case Kind::Text:
        case Kind::Choice:
            require(value.is_string(), "a string", value, place);
            if (type.kind == Kind::Choice &&
                std::ranges::find(type.choices, value.get_ref<const std::string&>()) == type.choices.end())
                fail(place, fmt::format("is '{}'; valid are {}", value.get_ref<const std::string&>(),
                                        fmt::join(type.choices, ", ")));
            return std::move(value);
        case Kind::Number:
            requireNumber(value, type, place);
            return value.get<double>();
        default:
            break;
        }
        const std::int64_t number = integer(value, type, place);
        if (type.kind == Kind::Code && std::ranges::find(type.choices, std::to_string(number)) == type.choices.end())
            fail(place, fmt::format("is {}; valid are {}", number, fmt::join(type.choices, ", ")));
        if (type.kind == Kind::Index) requireElement(static_cast<std::size_t>(number), type.array, place);
        // tinygltf keeps the low 32 bits of integers in extensions.
        if (isValue && number > std::int64_t(kMaxInt)) return static_cast<double>(number);
        return number < 0 ? Json(number) : Json(static_cast<std::uint64_t>(number));
    }

    void requireElement(std::size_t index, std::string_view array, const Place& place) const {
        const Counted& counted = counts_.at(array);
        if (!counted.missing.empty())
            fail(place, fmt::format("points at /{}/{}, but the document has no {}", array, index, counted.missing));
        if (!counted.type.empty())
            fail(Place(Place(), array), fmt::format("must be an array, but is {}", counted.type));
        if (index >= counted.size)
            fail(place, counted.size == 0
                            ? fmt::format("points at /{}/{}, but /{} is empty", array, index, array)
                            : fmt::format("points at /{}/{}, but there are only {}", array, index, counted.size));
    }

    /// Numbers end as floats in the scene, so what overflows one is out of range.
    void requireNumber(const Json& value, const Type& type, const Place& place) const {
        require(value.is_number(), "a number", value, place);
        const double number = value.get<double>();
        if (!(std::abs(number) <= kMaxFloat))
            fail(place, fmt::format("is {}, which no 32-bit number can hold", value.dump()));
        requireBounds(number, type, place);
    }

    std::int64_t integer(const Json& value, const Type& type, const Place& place) const {
        require(value.is_number(), "an integer", value, place);
        const double number = value.get<double>();
        if (!std::isfinite(number) || number != std::floor(number))
            fail(place, fmt::format("must be an integer, but is {}", value.dump()));
        if (std::abs(number) > kMaxInteger)
            fail(place, fmt::format("is {}, farther from 0 than {}", value.dump(), std::int64_t(kMaxInteger)));
        requireBounds(number, type, place);
        const auto whole = static_cast<std::int64_t>(number);
        if (whole % type.divisor != 0)
            fail(place, fmt::format("is {}; it must be a multiple of {}", whole, type.divisor));
        return whole;
    }

    void requireBounds(double number, const Type& type, const Place& place) const {
        if (type.isMoreThanLeast && !(number > type.least))
            fail(place, fmt::format("is {}; more than {} is needed", number, type.least));
        if (number < type.least) fail(place, fmt::format("is {}; it must be at least {}", number, type.least));
        if (number > type.most) fail(place, fmt::format("is {}; it must be at most {}", number, type.most));
    }

    void require(bool isGood, std::string_view type, const Json& value, const Place& place) const {
        if (!isGood) fail(place, fmt::format("must be {}, but is {}", type, value.type_name()));
    }

    [[noreturn]] void fail(const Place& place, std::string_view what) const {
        throw InputError(fmt::format("{}: {}: {}", file_, place.text(), what));
    }

    void charge(std::uint64_t bytes, const Place& place, std::size_t count) const {
        ledger_.charge(bytes, [&] { return fmt::format("{}: {}, {} elements", file_, place.text(), count); });
    }

    const std::string& file_;
    LoadLedger& ledger_;
    std::map<std::string_view, Counted> counts_;
};

} // namespace

Json checkedProperties(Json& document, const std::string& file, LoadLedger& ledger) {
    return Checker(document, file, ledger).object(document, schema().document(), Place());
}

} // namespace tessera::scenes::gltf
