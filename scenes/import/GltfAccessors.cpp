#include "scenes/import/GltfAccessors.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>

#include <fmt/format.h>

namespace tessera::scenes::gltf {
namespace {

/// An accessor without a buffer view is all zeros whatever the file's size, so its count needs a bound of its own.
constexpr std::size_t kMaxCountWithoutView = std::size_t{1} << 22;

std::size_t componentBytes(int componentType) {
    const int bytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(componentType));
    assert(bytes > 0);
    return static_cast<std::size_t>(bytes);
}

template <typename T>
T stored(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

/// glTF 2.0 section 3.11: f = c / max, and at least -1 for signed types.
template <typename T>
float converted(const std::byte* bytes, bool normalized) {
    const double value = static_cast<double>(stored<T>(bytes));
    if (!normalized) return static_cast<float>(value);
    return static_cast<float>(std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0));
}

float toFloat(const std::byte* bytes, int componentType, bool normalized) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return converted<std::int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return converted<std::uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return converted<std::int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return converted<std::uint16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return converted<std::uint32_t>(bytes, normalized);
    default:
        return stored<float>(bytes);
    }
}

std::uint32_t toUnsigned(const std::byte* bytes, int componentType) {
    switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return stored<std::uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return stored<std::uint16_t>(bytes);
    default:
        return stored<std::uint32_t>(bytes);
    }
}

} // namespace

/// Where elements lie: all of [first, last byte of the last element] is inside the buffer view.
struct Accessors::Source {
    const std::byte* first = nullptr;
    std::size_t byteStride = 0;
    std::size_t componentBytes = 0;
};

Accessors::Source Accessors::placed(int accessor, int bufferView, std::size_t byteOffset, std::size_t count,
                                    int componentType, int components, std::size_t byteStride) {
    const std::size_t bytesEach = componentBytes(componentType);
    const std::size_t elementBytes = bytesEach * static_cast<std::size_t>(components);
    const std::size_t stride = byteStride == 0 ? elementBytes : byteStride;
    const std::string place = fmt::format("/accessors/{}", accessor);
    if (stride < elementBytes)
        document_.fail(place, fmt::format("has elements of {} bytes, but buffer view {} steps only {} bytes",
                                          elementBytes, bufferView, stride));
    const std::span<const std::byte> bytes = buffers_.view(bufferView);
    // Offset and count are at most 2^53 and the stride at most 256 (GltfShape), so nothing wraps in 64 bits.
    const std::size_t end = byteOffset + (count - 1) * stride + elementBytes;
    if (end > bytes.size())
        document_.fail(
            place, fmt::format("reads {} bytes past the end of buffer view {} (byteOffset {}, {} elements of {} "
                               "bytes, {} apart, in {} bytes)",
                               end - bytes.size(), bufferView, byteOffset, count, elementBytes, stride, bytes.size()));
    return {bytes.data() + byteOffset, stride, bytesEach};
}

template <typename Value, typename Convert>
std::vector<Value> Accessors::read(int index, Convert convert) {
    const tinygltf::Accessor& accessor = document_.model.accessors[static_cast<std::size_t>(index)];
    const std::string place = fmt::format("/accessors/{}", index);
    const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    const auto width = static_cast<std::size_t>(components);
    std::vector<Value> values;

    // Once here, once for the caller's copy.
    const auto reserve = [&] {
        document_.charge(2 * accessor.count * width * sizeof(Value), "accessors", index);
        values.resize(accessor.count * width);
    };
    const auto copyElement = [&](const Source& source, std::size_t from, std::size_t to) {
        const std::byte* element = source.first + from * source.byteStride;
        for (std::size_t c = 0; c < width; ++c)
            values[to * width + c] = convert(element + c * source.componentBytes, accessor.componentType);
    };

    if (accessor.bufferView < document_.bufferViewCount) {
        const std::size_t stride =
            document_.model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
        const Source source = placed(index, accessor.bufferView, accessor.byteOffset, accessor.count,
                                     accessor.componentType, components, stride);
        reserve();
        for (std::size_t i = 0; i < accessor.count; ++i) copyElement(source, i, i);
    } else {
        if (accessor.count > kMaxCountWithoutView)
            document_.fail(place, fmt::format("has {} elements but no buffer view; at most {} are supported then",
                                              accessor.count, kMaxCountWithoutView));
        reserve();
    }
    if (!accessor.sparse.isSparse) return values;

    const auto sparseCount = static_cast<std::size_t>(accessor.sparse.count);
    if (sparseCount > accessor.count)
        document_.fail(place, fmt::format("replaces {} elements, but has only {}", sparseCount, accessor.count));
    const int targetType = accessor.sparse.indices.componentType;
    const Source targets =
        placed(index, accessor.sparse.indices.bufferView, static_cast<std::size_t>(accessor.sparse.indices.byteOffset),
               sparseCount, targetType, 1, 0);
    const Source replacements =
        placed(index, accessor.sparse.values.bufferView, static_cast<std::size_t>(accessor.sparse.values.byteOffset),
               sparseCount, accessor.componentType, components, 0);
    for (std::size_t i = 0; i < sparseCount; ++i) {
        const std::uint32_t target = toUnsigned(targets.first + i * targets.byteStride, targetType);
        if (target >= accessor.count)
            document_.fail(
                place, fmt::format("sparse index {} is {}, but there are only {} elements", i, target, accessor.count));
        copyElement(replacements, i, target);
    }
    return values;
}

Elements Accessors::elements(int index) {
    const tinygltf::Accessor& accessor = document_.model.accessors[static_cast<std::size_t>(index)];
    if (accessor.type != TINYGLTF_TYPE_SCALAR && accessor.type != TINYGLTF_TYPE_VEC2 &&
        accessor.type != TINYGLTF_TYPE_VEC3 && accessor.type != TINYGLTF_TYPE_VEC4)
        document_.fail(fmt::format("/accessors/{}", index), "is a matrix, which no vertex attribute is");
    Elements elements;
    elements.count = accessor.count;
    elements.components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    elements.normalized = accessor.normalized;
    elements.componentType = accessor.componentType;
    elements.values = read<float>(index, [&accessor](const std::byte* bytes, int componentType) {
        return toFloat(bytes, componentType, accessor.normalized);
    });
    return elements;
}

std::vector<std::uint32_t> Accessors::indices(int index) {
    const tinygltf::Accessor& accessor = document_.model.accessors[static_cast<std::size_t>(index)];
    const int type = accessor.componentType;
    const bool isUnsigned = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                            type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                            type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !isUnsigned)
        document_.fail(fmt::format("/accessors/{}", index),
                       "holds indices, so it must be SCALAR of UNSIGNED_BYTE, UNSIGNED_SHORT or UNSIGNED_INT");
    return read<std::uint32_t>(index, toUnsigned);
}

} // namespace tessera::scenes::gltf
