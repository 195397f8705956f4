#pragma once
#include "renderer/gpu/GraphBackend.h"

namespace tessera::viewer {

/// While one exists, frames do not age resources that they do not use: diffused irradiance and shadow maps stay for
/// later images, however many extra frames are drawn in between.
class KeepsUnused {
public:
    explicit KeepsUnused(gpu::GraphBackend& backend) : backend_(backend) { backend_.setCountsIdleFrames(false); }
    ~KeepsUnused() { backend_.setCountsIdleFrames(true); }
    KeepsUnused(const KeepsUnused&) = delete;
    KeepsUnused& operator=(const KeepsUnused&) = delete;

private:
    gpu::GraphBackend& backend_;
};

} // namespace tessera::viewer
