#pragma once
#include <string>
#include <string_view>

#include "renderer/graph/Compile.h"
#include "renderer/graph/Graph.h"

namespace tessera::graph {

/// What an Access means to validation and to GL's memory model; one table behind accessInfo() holds them all.
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

/// Why a resource of this shape does not allow the access, with the remedy; empty when it does.
std::string unfitReason(const ResourceDesc& desc, Access access);

/// "1280 x 720" or "1280 x 720, 4 samples" or "4096 bytes".
std::string describeSize(const ResourceDesc& desc);

/// A set of barriers in words: "texture fetch, image".
std::string describeBarrier(Barrier barrier);

} // namespace tessera::graph
