#include "scenes/import/GltfSchema.h"

#include <charconv>

#include "scenes/import/GltfModel.h"
#include "scenes/import/GltfProperties.h"

namespace tessera::scenes::gltf {
namespace {

std::string_view cut(std::string_view& text, std::string_view separators) {
    const std::string_view first = text.substr(0, text.find_first_of(separators));
    text.remove_prefix(first.size());
    return first;
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

} // namespace

std::vector<std::string_view> split(std::string_view text, std::string_view separator) {
    std::vector<std::string_view> parts{cut(text, separator)};
    while (!text.empty()) {
        text.remove_prefix(1);
        parts.push_back(cut(text, separator));
    }
    return parts;
}

Schema::Schema() {
    for (const auto& [name, bytes] : elementBytes())
        objects_[name] = {bytes + kHeapBlockBytes, false, {}, Json::object()};
    objects_["Light"].bytes += kGrowth * sizeof(tiny::Light); // beside its value
    Struct* object = nullptr;
    for (std::string_view line : split(kProperties, "\n"))
        if (line.empty() || line.front() != ' ') {
            object = &objects_[cut(line, " ")];
            if (!line.empty()) object->standIn = Json::parse(line);
        } else
            for (const std::string_view property : split(line.substr(1), ";"))
                object->properties.push_back(propertyOf(property));
}

Property Schema::propertyOf(std::string_view text) {
    Property property;
    text.remove_prefix(text.find_first_not_of(' '));
    property.path = cut(text, "!?+ ");
    property.keys = split(property.path, "/");
    property.isRequired = text.front() == '!';
    property.isExtension = property.keys.front() == "extensions";
    property.isWhole = text.front() == '+' || (text.front() != ' ' && !property.isExtension);
    const std::string_view condition = cut(text, " ");
    if (condition.starts_with('?')) {
        const std::size_t equals = condition.find('=');
        property.conditionKey = condition.substr(1, equals - 1);
        property.condition = condition.substr(equals + 1);
    }
    property.type = typeOf(text.substr(1));
    return property;
}

Type Schema::typeOf(std::string_view text) {
    constexpr std::string_view kKinds[] = {"text", "label", "flag",  "object", "number",
                                           "int",  "size",  "index", "choice", "code"}; // as Kind
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
        if (const std::size_t dots = text.find(".."); dots != text.npos) readNumber(text.substr(dots + 2), type.most);
        if (const std::size_t by = text.find('%'); by != text.npos) readNumber(text.substr(by + 1), type.divisor);
    }
    return type;
}

const Schema& schema() {
    static const Schema made;
    return made;
}

} // namespace tessera::scenes::gltf
