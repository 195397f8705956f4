#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scenes/import/GltfBuffers.h"

namespace tessera::scenes::gltf {

/// An accessor's elements as floats: normalised integers in 0..1 or -1..1, other integers as their value.
struct Elements {
    std::size_t count = 0;
    int components = 0; ///< 1..4 an element, 16 at most
    bool normalized = false;
    int componentType = 0; ///< as in the file, for callers that distinguish integers from floats
    std::vector<float> values;
};

/// Reads accessors of every form: interleaved, tightly packed, normalised, sparse, sparse without a buffer view. Every
/// range is checked before it is read or memory is reserved for it; throws InputError naming the accessor.
class Accessors {
public:
    Accessors(const Document& document, Buffers& buffers) : document_(document), buffers_(buffers) {}

    Elements elements(int accessor);
    std::vector<std::uint32_t> indices(int accessor);

private:
    struct Source;
    Source placed(int accessor, int bufferView, std::size_t byteOffset, std::size_t count, int componentType,
                  int components, std::size_t byteStride);
    template <typename Value, typename Convert>
    std::vector<Value> read(int accessor, Convert convert);

    const Document& document_;
    Buffers& buffers_;
};

} // namespace tessera::scenes::gltf
