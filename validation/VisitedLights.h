#pragma once
#include <cstdint>
#include <vector>

#include "passes/recipes/Renderer.h"

namespace tessera::validation {

/// Reads a frame's light lists as the shaders' light cursor does, in words of its own.
class VisitedLights {
public:
    /// `drawn` must outlive the object.
    explicit VisitedLights(const recipes::DrawnLists& drawn);

    /// Scene lights that a pixel visits, ascending, those that reach everywhere included. `row` counts from the bottom;
    /// `depth` is the depth buffer's value there.
    void at(int column, int row, float depth, std::vector<int>& sceneLights) const;

private:
    void ofList(const glm::uvec4& tile, float depth, std::vector<int>& sceneLights) const;
    void ofMasks(const glm::uvec4& tile, float depth, std::vector<int>& sceneLights) const;

    const recipes::DrawnLists& drawn_;
};

} // namespace tessera::validation
