#pragma once
#include <string>
#include <string_view>

#include "renderer/graph/Compile.h"
#include "renderer/graph/Graph.h"

namespace tessera::graph {

/// Properties of an Access for validation and GL's memory model; the table behind accessInfo() is the only list.
struct AccessInfo {
    Access access;
    std::string_view name;
    bool isWrite;
    bool ofTextures;
    bool ofBuffers;
    bool incoherent;    ///< a store by a shader, which GL does not order with later commands by itself
    bool readsInShader; ///< a load or fetch by a shader
    Barrier barrier;    ///< the bits that make earlier shader stores visible to this access
};
const AccessInfo& accessInfo(Access access);

bool isAttachment(Access access);
/// Whether the access uses a single level and layer of a texture.
bool isOfPart(Access access);

/// Why a resource of this shape does not allow the access, with the remedy; empty when it does.
std::string unfitReason(const ResourceDesc& desc, Access access);

/// "1280 x 720", "1280 x 720, 4 samples", "512 x 512, 4 layers, 3 levels", "64 x 64, a cube" or "4096 bytes".
std::string describeSize(const ResourceDesc& desc);

/// A set of barriers in words: "texture fetch, image".
std::string describeBarrier(Barrier barrier);

} // namespace tessera::graph
