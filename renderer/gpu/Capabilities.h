#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace tessera::gpu {

/// What the context's driver says of itself, read once when the context is made.
struct Capabilities {
    std::string vendor;
    std::string renderer;
    std::string version;     ///< GL_VERSION
    std::string glslVersion; ///< GL_SHADING_LANGUAGE_VERSION
    std::string contextWay;  ///< how the context was made, e.g. "EGL surfaceless", "EGL device 0", "GLFW window"
    bool isSoftware = false; ///< a CPU rasteriser (llvmpipe, softpipe, swrast): GPU timer queries mean nothing there
    /// By how much of a pixel the rasteriser moves vertices before it finds depths; 0: depths are those of the vertices
    /// as they are, to rounding.
    float snapPixels = 0.0f;
    std::size_t maxTextureBufferTexels = 0;
    std::size_t maxUniformBlockBytes = 0;
    std::size_t maxStorageBlockBytes = 0;
    bool indexesUniformBlocks = true; ///< false where an index that varies overruns the driver's memory
    int maxTextureSize = 0;           ///< texels, of a 2D texture's side
    int maxSamples = 0;               ///< of colour textures
    int texturesAStage = 16;          ///< that a fragment shader may sample, at least 16
    /// Where the samples of a pixel lie, in shares of it from its lower left corner: a row for each number of them that
    /// textures of RGBA32F, R32F and D32F can all have, ascending from 1. A driver gives the next larger of its own
    /// numbers for one that it lacks.
    std::vector<std::vector<glm::vec2>> samplePlaces{{glm::vec2(0.5f)}};
    float maxAnisotropy = 1.0f;
    bool parallelShaderCompile = false; ///< KHR_parallel_shader_compile
};

} // namespace tessera::gpu
