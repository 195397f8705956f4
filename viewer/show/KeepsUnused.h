#pragma once
#include "renderer/gpu/GraphBackend.h"

namespace tessera::viewer {

/// While one lives, frames make nothing older that they do not use: light that is spread, and shadow maps, are for the
/// pictures that follow, however many were drawn for something else in between.
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
