#pragma once
#include <algorithm>
#include <limits>

#include <nlohmann/json.hpp>

#include "scenes/import/GltfModel.h"

/// Schema of the properties that the importer reads (GltfSchema.cpp), which documents are checked against.
namespace tessera::scenes::gltf {

using Json = nlohmann::json;

inline constexpr double kMaxInt = std::numeric_limits<int>::max(), kMaxFloat = std::numeric_limits<float>::max();
inline constexpr double kMaxInteger = 9007199254740992.0; ///< 2^53: JSON numbers are exact to here
inline constexpr std::uint64_t kHeapBlockBytes = 48;      ///< overhead of a heap block, such as a map node
inline constexpr std::uint64_t kGrowth = 3;               ///< copies while a doubling array grows
inline constexpr std::uint64_t kMemberBytes = 2 * kHeapBlockBytes + sizeof(tiny::Value); ///< a named value of tinygltf

enum class Kind { Text, Label, Flag, Object, Number, Int, Size, Index, Choice, Code, Struct };

struct Struct;

struct Type {
    Kind kind{};
    std::vector<std::string_view> arrays; ///< innermost first: "3", "", "~", "?" or "{}"
    double least = -kMaxFloat, most = kMaxFloat;
    bool isMoreThanLeast = false;
    std::int64_t divisor = 1;
    std::string_view array; ///< that an index refers to, by its path in the document
    std::vector<std::string_view> choices;
    const Struct* object = nullptr;
};

struct Property {
    std::string_view path;
    std::vector<std::string_view> keys;
    bool isRequired = false;
    bool isWhole = false; ///< a flaw in it invalidates the object
    bool isExtension = false;
    std::string_view conditionKey, condition; ///< required if this key has this text
    Type type;
};

struct Struct {
    std::uint64_t bytes = sizeof(tiny::Value); ///< memory of tinygltf per array element
    bool isValue = true;
    std::vector<Property> properties;
    Json standIn = Json::object(); ///< replaces an element that is flawed or not used

    bool canBeFlawed() const {
        return std::ranges::any_of(properties, [](const Property& property) { return property.isWhole; });
    }
};

/// Splits a text at separators.
std::vector<std::string_view> split(std::string_view text, std::string_view separator);

/// The schema: objects by name.
class Schema {
public:
    Schema();

    const Struct& document() const { return objects_.at("Document"); }
    const std::vector<std::string_view>& countedArrays() const { return countedArrays_; }

private:
    Property propertyOf(std::string_view text);
    Type typeOf(std::string_view text);

    std::map<std::string_view, Struct> objects_;
    std::vector<std::string_view> countedArrays_;
};

const Schema& schema();

} // namespace tessera::scenes::gltf
