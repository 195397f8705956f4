#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace tessera::gpu {

/// Properties of the context's driver, read once at creation.
struct Capabilities {
    std::string vendor;
    std::string renderer;
    std::string version;     ///< GL_VERSION
    std::string glslVersion; ///< GL_SHADING_LANGUAGE_VERSION
    std::string contextWay;  ///< how the context was made, e.g. "EGL surfaceless", "EGL device 0", "GLFW window"
    bool isSoftware = false; ///< CPU rasteriser (llvmpipe, softpipe, swrast), where GPU timer queries are meaningless
    /// Largest distance in pixels by which the rasteriser snaps vertices before it interpolates depth; 0: depths are
    /// those of unsnapped vertices, up to rounding.
    float snapPixels = 0.0f;
    std::size_t maxTextureBufferTexels = 0;
    std::size_t maxUniformBlockBytes = 0;
    std::size_t maxStorageBlockBytes = 0;
    bool indexesUniformBlocks = true; ///< false where dynamic indexing overruns the driver's memory
    int maxTextureSize = 0;           ///< side of a 2D texture, texels
    int maxSamples = 0;               ///< of colour textures
    int texturesAStage = 16;          ///< texture units of a fragment shader, at least 16
    /// Sample positions in a pixel, as fractions from its lower left corner: a row for each sample count that RGBA32F,
    /// R32F and D32F textures all support, ascending from 1. Drivers replace an unsupported count by their next larger
    /// one.
    std::vector<std::vector<glm::vec2>> samplePlaces{{glm::vec2(0.5f)}};
    float maxAnisotropy = 1.0f;
    bool parallelShaderCompile = false; ///< KHR_parallel_shader_compile
};

} // namespace tessera::gpu
