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

float toFloat(const std::byte* bytes, int type, bool normalized) {
    switch (type) {
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

std::uint32_t toUnsigned(const std::byte* bytes, int type) {
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return stored<std::uint8_t>(bytes);
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return stored<std::uint16_t>(bytes);
    return stored<std::uint32_t>(bytes);
}

} // namespace

/// Where elements lie: all of [first, last byte of the last element] is inside the buffer view.
struct Accessors::Source {
    const std::byte* first = nullptr;
    std::size_t byteStride = 0;
    std::size_t componentBytes = 0;
};

Accessors::Source Accessors::placed(int accessor, int bufferView, std::size_t byteOffset, std::size_t count, int type,
                                    std::size_t components, std::size_t byteStride) {
    const std::size_t bytesEach = bytesOf(type);
    const std::size_t elementBytes = bytesEach * components;
    const std::size_t stride = byteStride == 0 ? elementBytes : byteStride;
    const std::string place = fmt::format("/accessors/{}", accessor);
    if (stride < elementBytes)
        document_.fail(place, fmt::format("has elements of {} bytes, but buffer view {} steps only {} bytes",
                                          elementBytes, bufferView, stride));
    const std::span<const std::byte> bytes = buffers_.view(bufferView);
    // Offset and count are at most 2^53 and the stride at most 256 (GltfProperties.h), so nothing wraps in 64 bits.
    const std::size_t end = byteOffset + (count - 1) * stride + elementBytes;
    if (end > bytes.size())
        document_.fail(
            place, fmt::format("reads {} bytes past the end of buffer view {} (byteOffset {}, {} elements of {} "
                               "bytes, {} apart, in {} bytes)",
                               end - bytes.size(), bufferView, byteOffset, count, elementBytes, stride, bytes.size()));
    return {bytes.data() + byteOffset, stride, bytesEach};
}

template <typename Value, typename Convert>
std::vector<Value> Accessors::read(int index, std::span<const std::byte> packed, Convert convert) {
    const tiny::Accessor& accessor = accessorAt(index);
    const std::string place = fmt::format("/accessors/{}", index);
    const auto width = static_cast<std::size_t>(componentsOf(accessor));
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

    if (!packed.empty()) {
        const std::size_t componentBytes = bytesOf(accessor.componentType);
        assert(packed.size() == accessor.count * width * componentBytes);
        reserve();
        for (std::size_t i = 0; i < accessor.count; ++i)
            copyElement({packed.data(), componentBytes * width, componentBytes}, i, i);
    } else if (accessor.bufferView != kNone) {
        const std::size_t stride = elementAt(document_.model.bufferViews, accessor.bufferView).byteStride;
        const Source source = placed(index, accessor.bufferView, accessor.byteOffset, accessor.count,
                                     accessor.componentType, width, stride);
        reserve();
        for (std::size_t i = 0; i < accessor.count; ++i) copyElement(source, i, i);
    } else {
        if (accessor.count > kMaxCountWithoutView)
            document_.fail(place, fmt::format("has {} elements but no buffer view; at most {} are supported then",
                                              accessor.count, kMaxCountWithoutView));
        reserve();
    }
    if (!accessor.sparse.isSparse) return values;

    const auto& [sparseCount, isSparse, targetsAt, replacementsAt] = accessor.sparse;
    const auto count = static_cast<std::size_t>(sparseCount);
    if (count == 0) return values;
    if (count > accessor.count)
        document_.fail(place, fmt::format("replaces {} elements, but has only {}", count, accessor.count));
    const Source targets = placed(index, targetsAt.bufferView, static_cast<std::size_t>(targetsAt.byteOffset), count,
                                  targetsAt.componentType, 1, 0);
    const Source replacements =
        placed(index, replacementsAt.bufferView, static_cast<std::size_t>(replacementsAt.byteOffset), count,
               accessor.componentType, width, 0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t target = toUnsigned(targets.first + i * targets.byteStride, targetsAt.componentType);
        if (target >= accessor.count)
            document_.fail(
                place, fmt::format("sparse index {} is {}, but there are only {} elements", i, target, accessor.count));
        copyElement(replacements, i, target);
    }
    return values;
}

const tiny::Accessor& Accessors::accessorAt(int index) const {
    return elementAt(document_.model.accessors, index);
}

Elements Accessors::elements(int index, std::span<const std::byte> packed) {
    const tiny::Accessor& accessor = accessorAt(index);
    if (componentsOf(accessor) == 0)
        document_.fail(fmt::format("/accessors/{}", index), "is a matrix, which no vertex attribute is");
    return {accessor.count, componentsOf(accessor), accessor.normalized, accessor.componentType,
            read<float>(index, packed, [&accessor](const std::byte* bytes, int type) {
                return toFloat(bytes, type, accessor.normalized);
            })};
}

std::vector<std::uint32_t> Accessors::indices(int index) {
    const tiny::Accessor& accessor = accessorAt(index);
    const int type = accessor.componentType;
    const bool isUnsigned = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                            type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                            type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !isUnsigned)
        document_.fail(fmt::format("/accessors/{}", index),
                       "holds indices, so it must be SCALAR of UNSIGNED_BYTE, UNSIGNED_SHORT or UNSIGNED_INT");
    return read<std::uint32_t>(index, {}, toUnsigned);
}

} // namespace tessera::scenes::gltf
