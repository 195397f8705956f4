#include "scenes/import/GltfBuffers.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>
#include <type_traits>

#include <meshoptimizer.h>

#include "scenes/import/Files.h"

namespace tessera::scenes::gltf {
namespace {

struct Meshopt {
    std::size_t count = 0;
    std::size_t byteStride = 0;
    std::string mode;   ///< ATTRIBUTES, TRIANGLES or INDICES
    std::string filter; ///< NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

/// The vertex codec's best case is 2 bits for each group of 16 bytes, the index codecs' one byte for a triangle of 12:
/// no data decodes to more than 64 times its size, plus one block's tail (at most 8 KiB). Larger claims are refused
/// before memory is reserved for them. Source: EXT_meshopt_compression, appendix A.
constexpr std::size_t kMaxRatio = 64;
constexpr std::size_t kBlockBytes = 8192;

/// Throws InputError with the reason if the layout breaks a rule of the extension.
void checkLayout(const Meshopt& layout, std::size_t encodedBytes) {
    const std::size_t stride = layout.byteStride;
    const bool isOfAttributes = layout.mode == "ATTRIBUTES";
    if (isOfAttributes ? stride % 4 != 0 : stride != 2 && stride != 4)
        throw InputError(fmt::format("mode {} needs a byteStride {}, not {}", layout.mode,
                                     isOfAttributes ? "divisible by 4" : "of 2 or 4", stride));
    if (layout.mode == "TRIANGLES" && layout.count % 3 != 0)
        throw InputError(fmt::format("mode TRIANGLES needs a count divisible by 3, not {}", layout.count));
    if (layout.filter != "NONE" && !isOfAttributes)
        throw InputError(fmt::format("filter {} works with mode ATTRIBUTES only", layout.filter));
    const bool isOctahedral = layout.filter == "OCTAHEDRAL", isQuaternion = layout.filter == "QUATERNION";
    if ((isOctahedral || isQuaternion) && stride != 8 && !(isOctahedral && stride == 4))
        throw InputError(fmt::format("filter {} needs a byteStride of {}8, not {}", layout.filter,
                                     isOctahedral ? "4 or " : "", stride));
    if (layout.count > (encodedBytes * kMaxRatio + kBlockBytes) / stride)
        throw InputError(
            fmt::format("{} bytes cannot hold {} elements of {} bytes", encodedBytes, layout.count, stride));
}

/// The decoded size that the layout states, limited to what `encodedBytes` can encode.
std::uint64_t decodedBytes(const Meshopt& layout, std::size_t encodedBytes) {
    return std::min<std::uint64_t>(layout.count * layout.byteStride, encodedBytes * kMaxRatio + kBlockBytes);
}

/// Decodes `layout.count` elements of `layout.byteStride` bytes. Throws InputError with the reason if that fails.
std::vector<std::byte> decodeMeshopt(std::span<const std::byte> encoded, const Meshopt& layout) {
    checkLayout(layout, encoded.size());
    std::vector<std::byte> decoded(layout.count * layout.byteStride);
    const auto* data = reinterpret_cast<const unsigned char*>(encoded.data());
    int result = 0;
    if (layout.mode == "ATTRIBUTES")
        result = meshopt_decodeVertexBuffer(decoded.data(), layout.count, layout.byteStride, data, encoded.size());
    else if (layout.mode == "TRIANGLES")
        result = meshopt_decodeIndexBuffer(decoded.data(), layout.count, layout.byteStride, data, encoded.size());
    else
        result = meshopt_decodeIndexSequence(decoded.data(), layout.count, layout.byteStride, data, encoded.size());
    if (result != 0)
        throw InputError(
            fmt::format("its {} data is broken or of a later version (decoder error {})", layout.mode, result));

    if (layout.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(decoded.data(), layout.count, layout.byteStride);
    if (layout.filter == "QUATERNION") meshopt_decodeFilterQuat(decoded.data(), layout.count, layout.byteStride);
    if (layout.filter == "EXPONENTIAL") meshopt_decodeFilterExp(decoded.data(), layout.count, layout.byteStride);
    return decoded;
}

/// An accessor without a buffer view is all zeros whatever the file's size, so its count needs a separate bound.
constexpr std::size_t kMaxCountWithoutView = std::size_t{1} << 22;

template <typename T>
T stored(const std::byte* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

/// glTF 2.0 section 3.11: f = c / max, and at least -1 for signed types.
float toFloat(const std::byte* bytes, int type, bool normalized) {
    return withComponent(type, [&]<typename Component>(Component) {
        const double value = double(stored<Component>(bytes));
        if (!std::is_integral_v<Component> || !normalized) return float(value);
        return float(std::max(value / double(std::numeric_limits<Component>::max()), -1.0));
    });
}

std::uint32_t toUnsigned(const std::byte* bytes, int type) {
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return stored<std::uint8_t>(bytes);
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return stored<std::uint16_t>(bytes);
    return stored<std::uint32_t>(bytes);
}

} // namespace

std::span<const std::byte> Buffers::buffer(int index) {
    const std::string place = fmt::format("/buffers/{}", index);
    const BufferSource& stored = document_.buffers[std::size_t(index)];
    std::span<const std::byte> bytes;
    if (stored.uri) {
        auto found = buffers_.find(index);
        if (found == buffers_.end()) {
            const std::uint64_t mark = document_.ledger.usedBytes();
            const std::string& uri = *stored.uri;
            const bool isData = isDataUri(uri);
            if (const auto broken = broken_.find(index); broken != broken_.end()) throw InputError(broken->second);
            if (isData) document_.charge(2 * uri.size(), "buffers", index);
            const std::filesystem::path file = isData ? std::filesystem::path() : document_.fileAt(place, uri);
            try {
                std::vector<std::byte> read = isData ? decodeDataUri(uri) : readFileBytes(file, document_.ledger);
                found = buffers_.emplace(index, std::move(read)).first;
            } catch (const MemoryRefused& error) {
                document_.fail(place, error);
            } catch (const InputError& error) {
                document_.charge(std::string_view(error.what()).size(), "buffers", index);
                broken_[index] = fmt::format("{}: {}: {}", document_.file, place, error.what());
                throw InputError(broken_[index]);
            }
            document_.ledger.settle(mark, found->second.size());
            heldBytes_ += found->second.size();
        }
        bytes = found->second;
    } else if (index == 0 && document_.binary) {
        bytes = *document_.binary;
    } else {
        document_.fail(place, "has neither a uri nor a binary chunk to be read from");
    }
    if (!stored.byteLength) {
        document_.repair(place, "all of its data is read", "the required property 'byteLength' is missing");
        return bytes;
    }
    // The binary chunk and exporters' files may be padded at the end (glTF 2.0 section 4.4.3.3).
    if (bytes.size() < *stored.byteLength)
        document_.repair(place, "what lies beyond is left out", "says {} bytes, but its data has only {}",
                         *stored.byteLength, bytes.size());
    return bytes.first(std::min(*stored.byteLength, bytes.size()));
}

std::span<const std::byte> Buffers::slice(int index, std::size_t byteOffset, std::size_t byteLength,
                                          const std::string& place) {
    const std::span<const std::byte> bytes = buffer(index);
    // Both are at most 2^53 (GltfSchema.cpp), so their sum does not wrap.
    const std::size_t end = byteOffset + byteLength;
    if (end > bytes.size())
        document_.fail(place, "reads {} bytes past the end of buffer {} (byteOffset {} + byteLength {} > {})",
                       end - bytes.size(), index, byteOffset, byteLength, bytes.size());
    return bytes.subspan(byteOffset, byteLength);
}

std::vector<std::byte> Buffers::decompress(int bufferView, const tiny::Value& stored) {
    const auto size = [&](const char* key) { return std::size_t(numberOf(valueAt(&stored, key), 0.0)); };
    const tiny::Value* const filter = valueAt(&stored, "filter");
    const Meshopt meshopt{size("count"), size("byteStride"), stringOf(valueAt(&stored, "mode")),
                          filter != nullptr ? stringOf(filter) : "NONE"};
    const std::string place = fmt::format("/bufferViews/{}/extensions/EXT_meshopt_compression", bufferView);
    const std::span<const std::byte> encoded =
        slice(integerOf(valueAt(&stored, "buffer")), size("byteOffset"), size("byteLength"), place);
    document_.charge(decodedBytes(meshopt, encoded.size()), "bufferViews", bufferView);
    try {
        std::vector<std::byte> decoded = decodeMeshopt(encoded, meshopt);
        heldBytes_ += decodedBytes(meshopt, encoded.size());
        return decoded;
    } catch (const InputError& error) {
        document_.fail(place, error);
    }
}

std::span<const std::byte> Buffers::view(int bufferView) {
    const tiny::BufferView& stored = elementAt(document_.model.bufferViews, bufferView);
    const tiny::Value* const meshopt = valueAt(stored.extensions, "EXT_meshopt_compression");
    if (meshopt == nullptr)
        return slice(stored.buffer, stored.byteOffset, stored.byteLength, fmt::format("/bufferViews/{}", bufferView));
    auto found = decompressed_.find(bufferView);
    if (found == decompressed_.end()) found = decompressed_.emplace(bufferView, decompress(bufferView, *meshopt)).first;
    return found->second;
}

/// Location of elements: all of [first, last byte of the last element] is inside the buffer view.
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
        document_.fail(place, "has elements of {} bytes, but buffer view {} steps only {} bytes", elementBytes,
                       bufferView, stride);
    const std::span<const std::byte> bytes = buffers_.view(bufferView);
    // Offset and count are at most 2^53 and the stride at most 256 (GltfSchema.cpp), so nothing wraps in 64 bits.
    const std::size_t end = byteOffset + (count - 1) * stride + elementBytes;
    if (end > bytes.size())
        document_.fail(place,
                       "reads {} bytes past the end of buffer view {} (byteOffset {}, {} elements of {} "
                       "bytes, {} apart, in {} bytes)",
                       end - bytes.size(), bufferView, byteOffset, count, elementBytes, stride, bytes.size());
    return {bytes.data() + byteOffset, stride, bytesEach};
}

template <typename Value, typename Convert>
std::vector<Value> Accessors::read(int index, std::span<const std::byte> packed, Convert convert) {
    const tiny::Accessor& accessor = accessorAt(index);
    const std::string place = fmt::format("/accessors/{}", index);
    const auto width = std::size_t(componentsOf(accessor));
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
            document_.fail(place, "has {} elements but no buffer view; at most {} are supported then", accessor.count,
                           kMaxCountWithoutView);
        reserve();
    }
    if (!accessor.sparse.isSparse) return values;

    const auto& [sparseCount, isSparse, targetsAt, replacementsAt] = accessor.sparse;
    const auto count = std::size_t(sparseCount);
    if (count == 0) return values;
    if (count > accessor.count) document_.fail(place, "replaces {} elements, but has only {}", count, accessor.count);
    const Source targets =
        placed(index, targetsAt.bufferView, std::size_t(targetsAt.byteOffset), count, targetsAt.componentType, 1, 0);
    const Source replacements = placed(index, replacementsAt.bufferView, std::size_t(replacementsAt.byteOffset), count,
                                       accessor.componentType, width, 0);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t target = toUnsigned(targets.first + i * targets.byteStride, targetsAt.componentType);
        if (target >= accessor.count)
            document_.fail(place, "sparse index {} is {}, but there are only {} elements", i, target, accessor.count);
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
