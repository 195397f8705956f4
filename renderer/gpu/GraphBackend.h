#pragma once
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/ConstantRing.h"
#include "renderer/gpu/Debug.h"
#include "renderer/gpu/Framebuffer.h"
#include "renderer/gpu/Texture.h"
#include "renderer/gpu/Timer.h"
#include "renderer/graph/Execute.h"

namespace tessera::gpu {

/// Cost of a pass in the latest measured frame.
struct PassTiming {
    std::string name;
    std::optional<double> gpuMs; ///< none: not measured (yet, or not measurable on this renderer without profiling)
    double cpuMs = 0.0;          ///< CPU time of its calls
};

/// Runs compiled graphs on the current context. Pools textures and buffers across frames by shape, and opens a debug
/// group and timers around every pass. Driver failures during a pass become exceptions that name the pass.
class GraphBackend : public graph::Backend {
public:
    GraphBackend();
    ~GraphBackend() override;

    /// On: measures gpuMs by glFinish and the CPU clock around every pass. This prevents passes from overlapping, so
    /// profiled frames are not comparable; on software rasterisers it is the only valid measurement.
    void setProfiling(bool on) { profiling_ = on; }
    bool profiling() const { return profiling_; }

    /// Frames after which an unused allocation or persistent resource is freed. Alternating frames keep theirs if this
    /// is at least their number.
    void setMostIdleFrames(int frames) { mostIdleFrames_ = frames; }
    int mostIdleFrames() const { return mostIdleFrames_; }
    /// Off: following frames do not count as idle for resources that they do not use.
    void setCountsIdleFrames(bool on) { countsIdleFrames_ = on; }

    /// On: clears every allocation at the start of a frame, so that unwritten parts do not show an earlier frame.
    void setClearsAllocations(bool on) { clearsAllocations_ = on; }

    /// Begins a frame: the contents of the previous frame's allocations may be overwritten from now on.
    void allocate(std::span<const graph::ResourceDesc> allocations) override;
    const Texture& texture(int physical) override;
    const Buffer& buffer(int physical) override;
    const Buffer& growingBuffer(const std::string& name, int number, std::size_t bytes) override;
    const Texture& persistentTexture(const std::string& name, const graph::TextureDesc& desc) override;
    const Buffer& persistentBuffer(const std::string& name, const graph::BufferDesc& desc) override;
    void setRevision(const std::string& name, std::optional<std::uint64_t> revision) override;
    /// Whether a successful frame has left this revision under the name, in that shape.
    bool holds(const std::string& name, const graph::ResourceDesc& desc, std::uint64_t revision) const;
    /// Keeps the persistent resource of a name, if there is one, as if this frame used it.
    void keep(const std::string& name);
    /// Frees the persistent resource of a name.
    void forget(const std::string& name);
    void bindTargets(std::span<const graph::Target> colors, const graph::Target& depth) override;
    void bindConstants(std::uint32_t slot, std::span<const std::byte> bytes,
                       std::span<const Program* const> programs) override;
    void beginPass(std::string_view name, graph::Barrier barrier) override;
    void endPass(std::string_view name) override;
    void endFrame(graph::Barrier barrier) override;

    /// Passes of the latest frame in order of execution. Without profiling gpuMs is some frames old.
    std::vector<PassTiming> passTimings();
    /// Bytes held: pooled, idle, growing and persistent resources.
    std::size_t poolBytes() const;

private:
    using Resource = std::variant<std::unique_ptr<Texture>, std::unique_ptr<Buffer>>;
    struct Pooled {
        graph::ResourceDesc desc;
        Resource resource;
        int idleFrames = 0;
        bool taken = false;
    };
    struct Persistent {
        graph::ResourceDesc desc;
        Resource resource;
        std::optional<std::uint64_t> revision; ///< none: no successful frame has written it
        int idleFrames = 0;
    };
    struct PassRecord {
        std::optional<GpuTimer> gpuTimer; ///< absent on software rasterisers
        std::optional<double> profiledMs;
        double cpuMs = 0.0;
    };
    using PassKey = std::pair<std::string, int>; ///< name and run: passes of a frame may share a name

    Pooled& take(const graph::ResourceDesc& desc);
    Resource& persistent(const std::string& name, const graph::ResourceDesc& desc);

    FramebufferCache framebuffers_;
    ConstantRing constants_;
    std::vector<std::unique_ptr<Pooled>> pool_;
    std::vector<Pooled*> physical_;
    std::map<std::string, Persistent> persistent_;          ///< by name
    std::map<std::pair<std::string, int>, Buffer> growing_; ///< by name and number
    std::map<PassKey, PassRecord> records_;
    std::vector<PassKey> frame_; ///< passes of the frame, in order
    std::map<std::string, int, std::less<>> runsOfName_;
    int mostIdleFrames_ = 3; ///< so that two or three alternating techniques keep theirs
    bool countsIdleFrames_ = true;
    bool clearsAllocations_ = false;
    bool profiling_ = false;
    bool isSoftware_ = false;
    std::unique_ptr<DebugGroup> group_; ///< of the open pass
    CpuTimer clock_;
};

} // namespace tessera::gpu
