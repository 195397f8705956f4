#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "engine/Renderer.h"
#include "renderer/gpu/Capabilities.h"
#include "renderer/gpu/Framebuffer.h"
#include "shaders/bench/lower_bound.h"
#include "shaders/shared/light.h"

namespace tessera::validation {

/// The kind of buffer that the bound's shader reads lights from.
struct LightStoreInfo {
    int store; ///< LIGHT_STORE_* of shaders/bench/lower_bound.h
    std::string_view name;
    std::string_view define;
};
std::span<const LightStoreInfo> lightStoreTable();
/// The stores that a driver supports: a uniform block only where it may be large enough for lights of every type.
std::span<const LightStoreInfo> lightStores(const gpu::Capabilities& gl);

/// Lights a synthetic surface at every pixel by the product's light evaluation alone, in its loop over all lights.
/// Reads   its lights, from any of three stores
/// Writes  radiance RGBA32F, linear, before exposure
/// Space   lighting space of an eye at the origin that looks along -z
class LowerBoundLighting {
public:
    /// `spec`: the models, light types and settings to light with, and the image size. The library must outlive the
    /// object.
    LowerBoundLighting(shader::ProgramLibrary& programs, const frame::FrameSpec& spec);

    /// At most LIGHT_UNIFORM_LIGHTS lights of types that the spec has; every pixel evaluates all of them.
    void setLights(const frame::PackedLights& lights);
    void draw(const LightStoreInfo& store) const;
    /// The latest image: RGBA, rows from the bottom.
    std::vector<float> download() const { return radiance_.downloadAs<float>(); }

    static shader::ProgramDesc program(const frame::FrameSpec& spec, const LightStoreInfo& store);

    /// The spec that it was made with, without shadows.
    const frame::FrameSpec& spec() const { return spec_; }
    void bindConstants() const;
    void bindLights(const LightStoreInfo& store) const;

private:
    shader::ProgramLibrary& programs_;
    frame::FrameSpec spec_;
    gpu::Buffer view_, constants_, environment_;
    /// The same lights for every store; the product's store holds lights and shapes in one buffer.
    gpu::Buffer lights_, shapes_, texels_;
    gpu::Texture radiance_;
    gpu::Framebuffer framebuffer_;
};

} // namespace tessera::validation
